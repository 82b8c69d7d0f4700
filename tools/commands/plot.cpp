// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle plot OUT... -o FILE`: draws figures for publications from the results of tests.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/recordings/distinct_names.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/campaign/page/figures.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/page/report_page.hpp"
#include "tools/plot/deck_panels.hpp"
#include "tools/plot/face_bands.hpp"
#include "tools/plot/figure_options.hpp"
#include "tools/plot/moments.hpp"
#include "tools/plot/panels.hpp"
#include "tools/terminal/printable.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;
using namespace plot;
using Words = std::vector<std::string>;

/// Appearance of a figure, for all kinds of input.
struct Look : FigureLook {
    Format format = Format::svg;
    DrawingStyle drawing;
};

Look look_of(const po::variables_map& given) {
    const Format format = given.contains("guide") ? format_named("plot", "--format", given["format"].as<std::string>())
                                                  : format_of_output("plot", given["output"].as<std::string>());
    Look look{figure_look("plot", given, format), format, {}};
    look.drawing.magnify = number_between("plot", given, "magnify", 0.0, 1e6, "");
    return look;
}

/// Refuses options that have no effect on figures of `input`. @param used options that have an effect, in addition to
/// --output, --force and those for the appearance
void expect_options(const po::variables_map& given, const std::string& input, Words used) {
    used.insert(used.end(), {"output", "force"});
    used.insert(used.end(), figure_options().begin(), figure_options().end());
    refuse_unused("crackle plot", given, input, used);
}

std::string capitalised(std::string word) {
    if (!word.empty() && word.front() >= 'a' && word.front() <= 'z')
        word.front() = static_cast<char>(word.front() - 'a' + 'A');
    return word;
}

/// Labels such as «Circles, tension» if they are different for all tests; otherwise the names from distinct_names().
Words default_labels(const std::vector<Recording>& tests) {
    Words labels;
    for (const Recording& test : tests)
        labels.push_back(fmt::format("{}, {}", capitalised(test.results.summary.about.specimen.name()),
                                     test.results.summary.about.kind.name()));
    Words sorted = labels;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return labels;
    return distinct_names(tests);
}

Recording read_whole(const fs::path& folder) {
    return read_test_recording(folder, std::numeric_limits<std::size_t>::max());
}

Words words_of(const po::variables_map& given, const char* option, const Words& otherwise = {}) {
    return given.contains(option) ? given[option].as<Words>() : otherwise;
}

bool has_word(const Words& words, const std::string& word) { return std::ranges::find(words, word) != words.end(); }

/// Checks that there is one label per result. @param one "test" or "run"
void expect_labels(const Words& labels, std::size_t results, const char* one) {
    if (labels.size() != results)
        throw InputError(fmt::format("plot: --labels: found {}, expected {}, one per {}",
                                     counted(labels.size(), "name"), results, one));
}

void write_figure(const fs::path& file, const std::vector<Panel>& panels, const Look& look, const Messages& messages) {
    replace_file(file, figure(panels, look.title, look.width, look.format, look.sheet));
    if (!messages.quiet()) print_text(file.string() + '\n');
}

std::string strain_text(double strain) { return strain == 0.0 ? "ε = 0" : fmt::format("ε = {:.3g} ‰", 1e3 * strain); }

/// @param asked the requested moments; if empty, start, peak and end, each frame drawn only once
/// @param forces whether the forces of faces are drawn
Panel drawings_of(const Recording& test, const fs::path& folder, const std::optional<Words>& asked,
                  const DrawingStyle& style, bool forces) {
    std::vector<DrawnMoment> drawn;
    for (const std::string& at : asked.value_or(Words{"start", "peak", "end"})) {
        const std::size_t frame = frame_at(test, at);
        if (!asked && std::ranges::find(drawn, frame, &DrawnMoment::frame) != drawn.end()) continue;
        const FrameHead& head = test.frames[frame];
        Words names = head.roles;
        if (!test.results.summary.about.failed.value_or(false))
            std::replace(names.begin(), names.end(), std::string("peak"), std::string("peak so far"));
        Words caption{strain_text(head.axial_strain.value_or(0.0))};
        if (!names.empty()) caption.insert(caption.begin(), fmt::format("{}", fmt::join(names, ", ")));
        drawn.push_back({&test, frame, std::move(caption)});
        drawn.back().forces = forces;
    }
    return drawings(drawn, std::vector<fs::path>(drawn.size(), folder), style);
}

/// All parts that can be drawn. A test without frames has no drawing, and the area strain is drawn only for a single
/// compression test.
Words everything_of(const std::vector<Recording>& tests) {
    Words what{"curve"};
    const TestResults& first = tests.front().results;
    if (tests.size() == 1 && !pulled(first) && has_area_strain(first)) what.emplace_back("strain");
    what.emplace_back("ae");
    if (std::ranges::all_of(tests, [](const Recording& test) { return has_emission(test.results); }))
        what.emplace_back("emission");
    if (std::ranges::none_of(tests, [](const Recording& test) { return test.frames.empty(); }))
        what.emplace_back("specimen");
    if (std::ranges::all_of(tests, has_faces)) what.emplace_back("forces");
    return what;
}

/// Adds one panel with the magnitudes of emissions in all tests, and rows of emission maps for tests that have frames.
void add_emission_panels(std::vector<Panel>& panels, const std::vector<Recording>& tests, const Words& folders,
                         const std::vector<PlottedTest>& plotted) {
    panels.push_back(magnitude_frequency(plotted));
    constexpr std::size_t most_in_a_row = 4;
    std::vector<DrawnMoment> row;
    std::vector<fs::path> of_row;
    for (std::size_t k = 0; k < tests.size(); ++k) {
        if (!tests[k].frames.empty()) {
            row.push_back({&tests[k], 0, tests.size() > 1 ? Words{escaped(plotted[k].label)} : Words{}});
            of_row.emplace_back(folders[k]);
        }
        if (row.empty() || (row.size() < most_in_a_row && k + 1 < tests.size())) continue;
        panels.push_back(emission_map(std::move(row), of_row));
        row.clear();
        of_row.clear();
    }
}

/// Checks the values of --what. @param of  end of the error message, which names the kind of input, for example " of a
/// campaign"; may be empty
void expect_words(const Words& what, const Words& known, const char* of) {
    for (const std::string& word : what) {
        if (has_word(known, word)) continue;
        throw InputError(fmt::format("plot: --what: found '{}', expected {} or {}{}", word,
                                     fmt::join(std::span(known).first(known.size() - 1), ", "), known.back(), of));
    }
}

/// Refuses options that refer to parts that are not drawn.
void expect_parts_of(const po::variables_map& given, const Words& what) {
    const auto expect = [&](const char* option, bool used, const char* input) {
        if (!used && given.contains(option) && !given[option].defaulted())
            throw without_effect("crackle plot", fmt::format("--{}", option), input);
    };
    expect("measured", has_word(what, "curve"), "a figure without curves");
    const bool specimens = has_word(what, "specimen") || has_word(what, "forces");
    expect("at", specimens, "a figure without specimens");
    expect("magnify", specimens, "a figure without specimens");
}

void plot_tests(const po::variables_map& given, const Words& folders, const Look& look, Messages& messages) {
    expect_options(given, "folders of tests", {"what", "at", "magnify", "labels", "measured"});
    const fs::path output = output_file(given["output"].as<std::string>(), given.contains("force"));
    Words what = words_of(given, "what", {"all"});
    expect_words(what, {"curve", "ae", "emission", "strain", "specimen", "forces", "all"}, "");
    std::vector<Recording> tests;
    for (const std::string& folder : folders) {
        tests.push_back(read_whole(folder));
        report_recording(messages, tests.back());
    }
    if (has_word(what, "all")) what = everything_of(tests);
    const auto expect_results = [&](const char* part, const auto& has, const char* found) {
        if (!has_word(what, part)) return;
        for (const Recording& test : tests)
            if (!has(test.results))
                throw InputError(fmt::format("plot: {}: found no {}; leave {} out of --what", test.name, found, part));
    };
    expect_results("strain", has_area_strain, "lateral strain, expected a specimen with particles along its sides");
    expect_results("emission", has_emission,
                   "ae.csv, expected one; it requires output.emission in the case, and a linear solution (see notices "
                   "of summary.json)");
    if (has_word(what, "forces"))
        for (const Recording& test : tests)
            if (!has_faces(test))
                throw InputError(
                    fmt::format("plot: {}: found no frames with forces of faces, expected a test with "
                                "bond.law = \"face\"; leave forces out of --what",
                                test.name));
    expect_parts_of(given, what);
    Words labels = given.contains("labels") ? given["labels"].as<Words>() : default_labels(tests);
    expect_labels(labels, tests.size(), "test");
    std::vector<PlottedTest> plotted;
    for (std::size_t k = 0; k < tests.size(); ++k) plotted.push_back({&tests[k].results, labels[k], k, false});

    std::vector<LabelledCurve> measured;
    if (given.contains("measured")) measured.push_back(measured_beside(tests, given["measured"].as<std::string>()));
    const std::optional<Words> moments = given.contains("at") ? std::optional(given["at"].as<Words>()) : std::nullopt;
    std::vector<Panel> panels;
    for (const std::string& word : what) {
        if (word == "curve") panels.push_back(stress_strain(plotted, measured));
        if (word == "ae") panels.push_back(breaks(plotted));
        if (word == "strain") panels.push_back(area_strain(plotted));
        if (word == "emission") add_emission_panels(panels, tests, folders, plotted);
        if (word != "specimen" && word != "forces") continue;
        for (std::size_t k = 0; k < tests.size(); ++k) {
            panels.push_back(drawings_of(tests[k], folders[k], moments, look.drawing, word == "forces"));
            if (tests.size() > 1) panels.back().title = labels[k];
        }
    }
    // A figure of a single test has no legend, so the first panel has the test's label or title as its title.
    if (tests.size() == 1)
        panels.front().title =
            given.contains("labels") ? labels.front() : tests.front().results.summary.about.title.value_or("");
    write_figure(output, panels, look, messages);
}

bool is_run_of_deck(const fs::path& path) {
    const fs::path folder = folder_of_run(path);
    return fs::exists(folder / "output.dat") && !fs::exists(folder / "summary.json");
}

/// Whether all paths are deck runs. @throws InputError if only some are, since their diagrams have no axes in common
bool are_runs_of_decks(const Words& paths) {
    const bool of_deck = is_run_of_deck(paths.front());
    const auto other =
        std::ranges::find_if(paths, [&](const std::string& path) { return is_run_of_deck(path) != of_deck; });
    if (other == paths.end()) return of_deck;
    throw InputError(fmt::format("plot: {}: found the run of a deck and {}, expected only runs of decks, or only tests",
                                 of_deck ? paths.front() : *other, of_deck ? *other : paths.front()));
}

/// Bodies selected by --bodies; if not given, the first few.
std::vector<int> drawn_bodies(const po::variables_map& given, const Recording& deck, Messages& messages) {
    constexpr std::size_t most = 8;  // largest number of curves that a reader can distinguish
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

/// Draws curves of deck runs; several runs share panels.
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
    expect_labels(labels, runs.size(), "run");
    std::vector<PlottedDeck> decks;
    for (std::size_t k = 0; k < runs.size(); ++k)
        decks.push_back({&runs[k], labels[k], drawn_bodies(given, runs[k], messages)});
    const Words what = words_of(given, "what", {"all"});
    const std::vector<DeckWord> words = words_of_decks(what, decks);
    if (given.contains("bodies") && std::ranges::all_of(words, [](DeckWord word) { return word == DeckWord::energy; }))
        throw without_effect("plot", "--bodies", "--what energy");
    std::vector<Panel> panels;
    for (const DeckWord word : words) {
        const std::vector<Panel> added = deck_panels(word, decks, units, !has_word(what, "all"));
        panels.insert(panels.end(), added.begin(), added.end());
    }
    write_figure(output, panels, look, messages);
}

/// Draws all diagrams of a campaign, one below the other. @return exit code
int plot_campaign(const po::variables_map& given, const fs::path& folder, const Look& look, Messages& messages) {
    expect_options(given, "a campaign's folder", {"what", "figure", "test", "measured"});
    const Words what = words_of(given, "what", {"all"});
    expect_words(what, {"curve", "axes", "scatter", "all"}, " of a campaign");
    const auto is_drawn = [&](const std::string& part) { return has_word(what, part) || has_word(what, "all"); };
    if (given.contains("measured") && !is_drawn("curve"))
        throw without_effect("crackle plot", "--measured", "a figure without curves");
    if (given.contains("figure") && !is_drawn("axes") && !is_drawn("scatter"))
        throw without_effect("crackle plot", "--figure", "curves alone");
    const fs::path output = output_file(given["output"].as<std::string>(), given.contains("force"));
    CampaignRecord record = read_campaign(folder, words_of(given, "figure"), words_of(given, "test"));
    if (given.contains("measured")) add_measured_curve(record, given["measured"].as<std::string>());
    std::vector<Panel> panels;
    for (CampaignFigure& figure : campaign_figures(record))
        if (is_drawn(figure.part)) panels.insert(panels.end(), figure.panels.begin(), figure.panels.end());
    if (panels.empty())
        throw InputError(fmt::format("plot: {}: found nothing to draw, expected figures or curves", folder.string()));
    write_figure(output, panels, look, messages);
    const std::string failures = notice_on_failures(record);
    if (failures.empty()) return exit_done;
    messages.notice(failures);
    return exit_system_fails;
}

constexpr int first_guide_figure = 26, last_guide_figure = 29;

/// Draws figures 26 to 29 of DEMseg's guide: the circle packing, the meshes made from it, and their curves and cracks.
void plot_guide(const po::variables_map& given, const Look& look, Messages& messages) {
    expect_options(given, "--guide", {"guide", "format", "magnify"});
    const fs::path folder = given["guide"].as<std::string>(), output = given["output"].as<std::string>();
    const std::string extension = given["format"].as<std::string>();
    if (fs::exists(output) && !fs::is_directory(output))
        throw InputError(fmt::format("plot: --output: found {}, a file, expected a folder for the guide's figures",
                                     output.string()));
    const auto file_of = [&](int number) { return output / fmt::format("figure{}.{}", number, extension); };
    for (int number = first_guide_figure; number <= last_guide_figure; ++number)
        output_file(file_of(number), given.contains("force"));
    std::map<std::string, Recording> tests;
    for (const char* specimen : {"circles", "delaunay", "voronoi"}) {
        for (const char* kind : {"tension", "compression"}) {
            const std::string name = fmt::format("{}_{}", specimen, kind);
            tests.emplace(name, read_whole(folder / name));
            report_recording(messages, tests.at(name));
        }
    }
    const auto at = [&](const std::string& name, const char* role, const char* caption) {
        return std::pair(DrawnMoment{&tests.at(name), frame_at(tests.at(name), role), {caption}}, folder / name);
    };
    const auto row = [&](std::initializer_list<std::pair<DrawnMoment, fs::path>> moments) {
        std::vector<DrawnMoment> drawn;
        std::vector<fs::path> folders;
        for (const auto& [moment, path] : moments) {
            drawn.push_back(moment);
            folders.push_back(path);
        }
        return drawings(drawn, folders, look.drawing);
    };
    const auto both_curves = [&](const std::string& specimen) {
        return stress_strain({{&tests.at(specimen + "_tension").results, "tension", 0, true},
                              {&tests.at(specimen + "_compression").results, "compression", 0, false}});
    };
    const auto loaded = [&](const std::string& specimen) {
        return row({at(specimen + "_tension", "end", "end of tension"),
                    at(specimen + "_compression", "end", "end of compression")});
    };
    // Parts of figure 26 in DEMseg's guide: (a) the packing, (b) the broken specimen, (c) the curves, (d) the breaks.
    auto broken = at("circles_tension", "end", "end of tension");
    broken.first.lettered = true;
    const std::map<int, std::vector<Panel>> figures{
        {26,
         {row({at("circles_tension", "start", "packing"), broken,
               at("circles_compression", "end", "end of compression")}),
          both_curves("circles"), breaks({{&tests.at("circles_tension").results, "tension", 0, false}})}},
        {27,
         {row({at("circles_tension", "start", "circles"), at("delaunay_tension", "start", "Delaunay"),
               at("voronoi_tension", "start", "Voronoi")})}},
        {28, {loaded("delaunay"), both_curves("delaunay")}},
        {29, {loaded("voronoi"), both_curves("voronoi")}}};
    make_folder(output);
    for (const auto& [number, panels] : figures) write_figure(file_of(number), panels, look, messages);
}

po::options_description plot_options() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("FIGURE"),
                          "figure to write: .svg, .pdf or .png; with --guide a folder")  //
        ("what", po::value<Words>()->multitoken()->value_name("WORD"),
         "diagrams, one below the other (default: all). For tests: curve, ae (bond breaks), emission (acoustic events: "
         "magnitudes of all tests together, and maps), strain (area strain and the part due to cracks), specimen, "
         "forces (of faces). For "
         "a campaign: curve (bands), axes (results against the axes of the plan), scatter (of the packings). For the "
         "run of a deck: energy, displacement, height, velocity, force (against time), curve (force against "
         "displacement)")  //
        ("at", po::value<Words>()->multitoken()->value_name("STRAIN"),
         "strains at which to draw specimens, or start, peak, end (default: start peak end); the nearest frame is "
         "drawn");
    add_figure_options(options, 1);
    options.add_options()("magnify", po::value<double>()->value_name("FACTOR")->default_value(1.0),
                          "magnification of displacements")  //
        ("labels", po::value<Words>()->multitoken()->value_name("NAME"),
         "names of the tests in legends and above specimens, one per test (default: what distinguishes them, or the "
         "title of a single test)")  //
        ("units", po::value<std::string>()->value_name("UNITS"),
         "when plotting a deck run, names of the units in labels, because decks do not contain units: si, cgs (cm, "
         "dyn, erg) or mm-g-s (mm, uN, nJ)")  //
        ("bodies", po::value<std::vector<int>>()->multitoken()->value_name("NUMBER"),
         "when plotting a deck run, ids of the bodies to draw; in_bc.dat must list them (default: the first eight)")  //
        ("guide", po::value<std::string>()->value_name("FOLDER"),
         "folder with the six tests of tools/quickstart, from which figures 26 to 29 of DEMseg's guide are drawn")  //
        ("format", po::value<std::string>()->value_name("FORMAT")->default_value("pdf"),
         "file format of the guide's figures: svg, pdf or png")  //
        ("figure", po::value<Words>()->multitoken()->value_name("NAME"),
         "when plotting a campaign, keys of summary.json to draw (default: moduli and strength)")  //
        ("test", po::value<Words>()->multitoken()->value_name("NAME"),
         "when plotting a campaign, tests to draw (default: all)")  //
        ("measured", po::value<std::string>()->value_name("FILE"),
         "table with the columns axial_strain and axial_stress, with their units as in \"axial_stress (MPa)\", drawn "
         "over the curves")  //
        ("force", "replace existing figures");
    return options;
}

}  // namespace

CommandLine describe_plot() {
    return {
        .synopses = {"crackle plot OUT... -o FIGURE [OPTIONS]", "crackle plot --guide FOLDER -o FOLDER [OPTIONS]"},
        .description =
            "Draws figures for a paper from the folders that `crackle test` wrote. They show axial stress against "
            "axial strain with bond breaks below it, area strain, and broken bonds. They also show magnitudes and "
            "positions of acoustic events, and specimens at given strains with their cracks. For a campaign's folder, "
            "figures show bands of curves, distributions, and results against the axes of the plan. For the run of a "
            "deck, they show energies, and displacements, heights, velocities and forces of the bodies listed in "
            "in_bc.dat, as in figures 6, 10, 12 and 14 of DEMseg's guide.",
        .options = {{"options", plot_options()}},
        .operand = "OUT",
        .several_operands = true,
        .choices = {{"what",
                     {"curve", "ae", "emission", "strain", "specimen", "axes", "scatter", "all", "energy",
                      "displacement", "height", "velocity", "force"}},
                    {"units", unit_sets()},
                    {"at", {"start", "peak", "end"}},
                    {"format", crackle::names_of<Format>()}},
        .verbose = "numbers of cells, bonds and frames read",
        .examples = {
            {"crackle plot out/pulled out/squeezed -o curves.pdf --what curve"},
            {"crackle plot out/seed-1 out/seed-2 -o emission.pdf --what emission"},
            {"crackle plot out/squeezed -o squeezed.svg --at start 0.001 peak end"},
            {"crackle plot out/squeezed -o specimen.png --what specimen --at peak end --dpi 600 --width 120"},
            {"crackle plot out/granite -o granite.pdf --test tension", "a campaign"},
            {"crackle plot out/slope -o energy.pdf --units cgs", "the run of a deck"},
            {"crackle plot out/wave_chain -o wave.pdf --what displacement --units cgs --bodies 11 13 15",
             "figure 10 of DEMseg's guide"},
            {"crackle plot out/soft out/stiff -o rolling.pdf --what velocity --labels soft stiff",
             "figure 12 of DEMseg's guide"},
            {"crackle plot --guide out/guide_rock -o out/figures", "figures of DEMseg's guide (tools/quickstart)"}}};
}

int plot(const Invocation& given) {
    const po::variables_map& values = given.values;
    if (given.operands.empty() != values.contains("guide")) {
        throw InputError(
            values.contains("guide")
                ? "plot: found folders of tests and --guide, expected only one of the two"
                : "plot: found no folder of results, expected at least one: crackle plot OUT... (see --help)");
    }
    if (!values.contains("output"))
        throw InputError("plot: found no -o, expected the figure's name: -o figure.pdf, .svg or .png");
    const Look look = look_of(values);
    const bool of_campaign = given.operands.size() == 1 && is_campaign(given.operands.front());
    if (values.contains("guide"))
        plot_guide(values, look, given.messages);
    else if (of_campaign)
        return plot_campaign(values, given.operands.front(), look, given.messages);
    else if (are_runs_of_decks(given.operands))
        plot_decks(values, given.operands, look, given.messages);
    else
        plot_tests(values, given.operands, look, given.messages);
    return exit_done;
}

}  // namespace crackle::tools
