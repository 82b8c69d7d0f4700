// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/row.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/files/replace_file.hpp"
#include "specimens/loading/expected_run.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/observers/curve.hpp"
#include "specimens/results/summary.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

double processor_seconds() {
    struct rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Keys of a summary that tell of the run, or of files.
constexpr std::array<std::string_view, 18> no_figures{
    "title",       "note",       "version",      "compiler",     "command",
    "threads",     "profile",    "wall_seconds", "step_seconds", "particle_steps_per_second",
    "frame_start", "frame_peak", "columns",      "frame_end",    "units",
    "files",       "seed",       "notices"};
// Lists of which each element has a column for each figure. Not of traces: there may be thousands.
constexpr std::array<std::string_view, 2> lists_of_figures{"cycles", "joints"};

void add_figures(Figures& figures, const std::string& prefix, const Json& table) {
    for (const auto& [key, value] : table.items()) {
        if (prefix.empty() && std::find(no_figures.begin(), no_figures.end(), key) != no_figures.end()) continue;
        const std::string name = prefix + key;
        if (value.is_object())
            add_figures(figures, name + ".", value);
        else if (prefix.empty() && std::ranges::find(lists_of_figures, key) != lists_of_figures.end())
            for (std::size_t k = 0; k < value.size(); ++k)
                add_figures(figures, fmt::format("{}[{}].", name, k + 1), value[k]);
        else if (value.is_boolean())
            figures.emplace_back(name, value.get<bool>() ? 1.0 : 0.0);
        else if (value.is_number())
            figures.emplace_back(name, value.get<double>());
        else if (value.is_string())
            figures.emplace_back(name, value.get<std::string>());
    }
}

std::string curve_text(const VirtualTest& test) {
    std::string text = curve_header(test.setup.pressed());
    for (const CurveRow& row : written_rows(test)) text += curve_line(row, test.setup.pressed());
    return text;
}

TestSummary loaded_in_memory(const TestCase& description, const RowPlace& place, const TestHooks& hooks,
                             std::string* curve) {
    VirtualTest test = prepare_test(description, hooks);
    const RunEstimate run = expected_run(test, description.loading.max_axial_strain, roughly_steps_per_second(test));
    if (!place.endless) refuse_endless(test, run);
    load_specimen(test, hooks);
    if (test.state.ended_by.empty()) throw TestInterrupted();
    if (curve != nullptr) *curve = curve_text(test);
    return make_summary(test.description, test.setup, test.state, test.world, {});
}

TestSummary loaded_with_files(const TestCase& description, const std::filesystem::path& folder, const RowPlace& place,
                              const TestHooks& hooks) {
    TestOptions options;
    options.folder = folder;
    options.force = true;  // what a stopped one has left
    options.most_threads = 1;
    options.endless = place.endless;
    options.command = "crackle campaign";
    const TestOutcome outcome = run_test(description, options, hooks);
    if (outcome.interrupted) throw TestInterrupted();
    return outcome.summary;
}

}  // namespace

Figures figures_of(const TestSummary& summary) {
    Figures figures;
    add_figures(figures, "", summary.json());
    return figures;
}

RowResult run_row(const TestCase& test, const RowNames& names, Keep keep, const RowPlace& place, PackingStore& packings,
                  const std::function<bool()>& interrupted) {
    const auto begun = std::chrono::steady_clock::now();
    const double before = processor_seconds();
    RowResult result;
    result.identity = names.identity;
    TestHooks hooks;
    hooks.interrupted = interrupted;
    hooks.keep_packing = [&](const TestCase& of, const PackingRequest& request, const auto& make) {
        return packings.get(of, request, make);
    };
    TestCase description = test;
    description.numerics.threads = 1;
    const auto went_wrong = [&](const char* state, int exit, const std::string& message) {
        result.state = state;
        result.exit = exit;
        result.message = message;
    };
    try {
        std::string curve;
        const TestSummary summary =
            keep == Keep::all ? loaded_with_files(description, place.folder / "tests" / names.kept, place, hooks)
                              : loaded_in_memory(description, place, hooks, keep == Keep::curves ? &curve : nullptr);
        if (keep == Keep::curves) {
            make_folder(place.folder / "curves");
            replace_file(place.folder / "curves" / (names.kept + ".csv"), curve);
        }
        result.figures = figures_of(summary);
        result.notices = summary.json().at("notices").get<std::vector<std::string>>();
        result.state = row_done;
    } catch (const OutputError&) {
        throw;
    } catch (const TestInterrupted&) {
        throw;
    } catch (const InputError& error) {
        went_wrong(row_refused, 2, error.what());
    } catch (const UnstableRun& error) {
        went_wrong(row_unstable, 3, error.what());
    } catch (const std::bad_alloc&) {
        went_wrong(row_failed, 2, "found less memory than the specimen needs");
    } catch (const std::exception& error) {
        went_wrong(row_failed, 4, error.what());
    }
    result.processor_seconds = processor_seconds() - before;
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return result;
}

}  // namespace crackle
