// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/plot_decks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <ranges>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/recordings/distinct_names.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/page/report_page.hpp"
#include "tools/plot/deck_panels.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using namespace plot;

const std::map<std::string, DeckWord>& deck_words() {
    static const std::map<std::string, DeckWord> words{
        {"energy", DeckWord::energy}, {"displacement", DeckWord::displacement},
        {"height", DeckWord::height}, {"velocity", DeckWord::velocity},
        {"force", DeckWord::force},   {"curve", DeckWord::curve}};
    return words;
}

bool is_run_of_deck(const fs::path& path) {
    const fs::path folder = folder_of_run(path);
    return fs::exists(folder / "output.dat") && !fs::exists(folder / "summary.json");
}

/// Ids of the bodies for which a run has curves.
std::vector<int> watched_bodies(const Recording& deck) {
    std::vector<int> all;
    const auto id = [](const auto& curve) { return curve.id; };
    std::ranges::transform(deck.curves.bodies, std::back_inserter(all), id);
    if (all.empty()) std::ranges::transform(deck.curves.velocities, std::back_inserter(all), id);
    return all;
}

/// Bodies selected by --bodies; if not given, the first few.
std::vector<int> drawn_bodies(const po::variables_map& given, const Recording& deck, Messages& messages) {
    constexpr std::size_t most = 8;  // number of curves that can be distinguished
    std::vector<int> watched = watched_bodies(deck);
    if (given.contains("bodies")) {
        std::vector<int> bodies = given["bodies"].as<std::vector<int>>();
        for (const int id : bodies) {
            if (std::ranges::find(watched, id) != watched.end()) continue;
            throw InputError(
                fmt::format("plot: --bodies: found {}, expected a body for which the run of {} wrote rows: {}", id,
                            deck.name, watched.empty() ? "none" : fmt::format("{}", fmt::join(watched, ", "))));
        }
        return bodies;
    }
    if (watched.size() > most) {
        messages.notice(fmt::format("{}: the first {} of {} bodies are drawn; choose others with --bodies", deck.name,
                                    most, watched.size()));
        watched.resize(most);
    }
    return watched;
}

/// The parts selected by --what; `all` means everything that is worth drawing.
std::vector<DeckWord> words_of_decks(const Words& what, const std::vector<PlottedDeck>& decks) {
    std::vector<DeckWord> words;
    for (const std::string& word : what) {
        const auto found = deck_words().find(word);
        if (word == "all") {
            words = words_worth_drawing(decks);
            break;
        }
        if (found == deck_words().end()) {
            const auto names = deck_words() | std::views::keys;
            throw InputError(fmt::format("plot: --what: found '{}', expected {} or all for the run of a deck", word,
                                         fmt::join(names, ", ")));
        }
        words.push_back(found->second);
    }
    for (const DeckWord word : words) {
        for (const PlottedDeck& deck : decks) {
            if (has_rows(*deck.recording, word)) continue;
            const char* file = word == DeckWord::energy     ? "energy.dat"
                               : word == DeckWord::velocity ? "velocity_y.dat"
                                                            : "f-d_curve.dat";
            throw InputError(fmt::format("plot: {}: found no rows in {}, expected {}", deck.recording->name, file,
                                         word == DeckWord::energy || word == DeckWord::velocity
                                             ? "those of a run of at least one step"
                                             : "those of bodies that in_bc.dat lists (npfd)"));
        }
    }
    if (words.empty())
        throw InputError(
            fmt::format("plot: {}: found no changing values, expected rows in energy.dat, f-d_curve.dat "
                        "or velocity_y.dat",
                        decks.front().recording->name));
    return words;
}

}  // namespace

bool are_runs_of_decks(const Words& paths) {
    const auto other = std::ranges::find_if(
        paths, [&](const std::string& path) { return is_run_of_deck(path) != is_run_of_deck(paths.front()); });
    if (other == paths.end()) return is_run_of_deck(paths.front());
    const bool first = is_run_of_deck(paths.front());
    throw InputError(fmt::format("plot: {}: found the run of a deck and {}, expected either runs of decks or tests",
                                 first ? paths.front() : *other, first ? *other : paths.front()));
}

void plot_decks(const po::variables_map& given, const Words& folders, const Look& look, Messages& messages) {
    expect_options(given, "runs of decks", {"what", "labels", "units", "bodies"});
    const fs::path output = output_file(given["output"].as<std::string>(), given.contains("force"));
    std::optional<UnitNames> units;
    if (given.contains("units")) units = units_named("plot: --units", given["units"].as<std::string>());
    std::vector<Recording> runs;
    for (const std::string& folder : folders) {
        runs.push_back(read_recording(folder, std::numeric_limits<std::size_t>::max(), 1));
        report_recording(messages, runs.back());
    }
    Words labels = given.contains("labels") ? given["labels"].as<Words>()
                   : runs.size() > 1        ? distinct_names(runs)
                                            : Words{""};
    if (labels.size() != runs.size())
        throw InputError(fmt::format("plot: --labels: found {}, expected {}, one per run",
                                     counted(labels.size(), "name"), runs.size()));
    std::vector<PlottedDeck> decks;
    for (std::size_t k = 0; k < runs.size(); ++k)
        decks.push_back({&runs[k], labels[k], drawn_bodies(given, runs[k], messages)});
    const Words what = given.contains("what") ? given["what"].as<Words>() : Words{"all"};
    const std::vector<DeckWord> words = words_of_decks(what, decks);
    if (given.contains("bodies") && std::ranges::all_of(words, [](DeckWord word) { return word == DeckWord::energy; }))
        throw without_effect("plot", "--bodies", "--what energy");
    std::vector<Panel> panels;
    for (const DeckWord word : words) {
        const std::vector<Panel> added = deck_panels(word, decks, units, std::ranges::find(what, "all") == what.end());
        panels.insert(panels.end(), added.begin(), added.end());
    }
    replace_file(output, figure(panels, look.title, look.width, look.format, look.sheet));
    if (!messages.quiet()) print_text(output.string() + '\n');
}

}  // namespace crackle::tools
