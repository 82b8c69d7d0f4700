// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle calibrate ROCK.toml -o DIR`: finds values of a rock's keys that reproduce its laboratory results.
// Tested by tests/tools/calibrate/calibrate_test.cpp.

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/files/new_file.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/files/text_table.hpp"
#include "specimens/calibration/calibrate.hpp"
#include "specimens/calibration/outcome_files.hpp"
#include "specimens/calibration/starting_guess.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/calibrate/calibration_page.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

/// Refuses an output folder unless it is new, empty, or belongs to a calibration.
void check_folder(const fs::path& folder, const Rock& rock) {
    std::vector<fs::path> inputs{rock.file};
    for (const PlannedTest& test : rock.tests) inputs.push_back(test.file);
    refuse_folder_of_inputs(folder, inputs);
    if (!is_there(folder) || is_there(folder / "search" / "campaign.sqlite") ||
        is_there(folder / "search" / "packings"))
        return;
    // A calibration that failed while it wrote its first file leaves an empty folder `search`.
    if (names_in(folder) == std::set<std::string>{"search"} && names_in(folder / "search").empty()) return;
    remove_leftovers(folder, Leftovers::old);
    refuse_foreign_files(folder, "a new or empty folder, or the folder of a calibration; choose another with -o");
}

void print_plan(const Rock& rock) {
    print_out("{}: {}, {}, {}\n", rock.title, counted(rock.targets.size(), "target"),
              counted(rock.free.size(), "free key"), counted(rock.tests.size(), "test"));
    TextTable table("<<");
    for (const Target& target : rock.targets)
        table.add(
            {target.name(rock.tests), fmt::format("{:.6g} within {:.3g} %", target.value, 100.0 * target.tolerance)});
    const std::vector<double> starts = starting_values(rock);
    for (std::size_t k = 0; k < rock.free.size(); ++k) {
        const FreeKey& free = rock.free[k];
        table.add({free.name(), fmt::format("{:.4g} to {:.4g}, from {:.4g}", free.from, free.to, starts[k])});
    }
    print_out("{}", table.text());
    const auto tests = static_cast<std::int64_t>(rock.tests.size());
    print_out("  two to ten rounds of up to {} each; then {} up to three times, and {} on fresh packings\n",
              counted(static_cast<std::int64_t>(2 * rock.free.size() + 3) * tests * rock.fit, "test"),
              counted(rock.polish * tests, "test"), rock.fresh * tests);
}

}  // namespace

CommandLine describe_calibrate() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"), "folder of the calibration")  //
        ("workers", po::value<int>()->value_name("N"),
         "number of processes that run tests (default: one per available processor)")                               //
        ("retry", "repeat tests that ended without a result because of their case (refused, unstable, timed out)")  //
        ("dry-run", "check the rock file, with all combinations of its bounds; run and write nothing")              //
        ("long", "run the tests even if they take more than a day, or 1e10 steps")                                  //
        ("keys", "list all keys of a rock file");
    return {
        .synopses = {"crackle calibrate ROCK.toml -o DIR [OPTIONS]"},
        .description =
            "Finds values for the free keys of a rock's cases such that the mean results of its tests over several "
            "packings match targets measured in a laboratory. Moduli are computed by sparse linear solves, and "
            "strengths by fitting a response surface to tests on the same packings. Writes the cases "
            "(DIR/cases/TEST.toml), the keys with their intervals (DIR/rock.toml), and a table of the results on fresh "
            "packings. Reports which targets cannot be reached, with the best compromises, and which keys the targets "
            "do not determine. A calibration can be stopped at any moment; run the same command again to resume it. "
            "Exit code 1: a target was not reached. Exit code 4: a test ended with a system error (out of memory, too "
            "many open files, a killed worker), so the calibration stopped; run the same command again to resume it.",
        .options = {{"options", options}},
        .operand = "ROCK.toml",
        .examples = {{"crackle calibrate specimens/targets/granite.toml --dry-run"},
                     {"crackle calibrate specimens/targets/granite.toml -o out/granite"},
                     {"crackle campaign show out/granite/search"}}};
}

int calibrate_rock(const Invocation& given) {
    const po::variables_map& values = given.values;
    Messages& messages = given.messages;
    if (values.contains("keys")) {
        expect_alone("crackle calibrate", given, "keys");
        print_text(describe_rock_keys());
        return exit_done;
    }
    if (given.operands.empty())
        throw InputError("crackle calibrate: found no ROCK.toml, expected one (see crackle calibrate --help)");
    const bool dry = values.contains("dry-run");
    if (!dry && !values.contains("output"))
        throw InputError("crackle calibrate: found no -o, expected -o DIR, the folder for the calibration");
    const auto asked = values.contains("workers") ? std::optional(values["workers"].as<int>()) : std::nullopt;
    const int workers = workers_of_machine(asked, "crackle calibrate");
    const Rock rock = read_rock(given_or_shipped(given.operands.front()));
    if (dry) {
        print_plan(rock);
        return exit_done;
    }
    watch_interrupts();
    end_unheard(words_of_resumable);
    CalibrationOptions options;
    options.folder = output_folder(values["output"].as<std::string>());
    options.workers = workers;
    options.retry = values.contains("retry");
    options.endless = values.contains("long");
    check_folder(options.folder, rock);
    CalibrationHooks hooks;
    hooks.interrupted = interrupted;
    hooks.told = [&](const std::string& text) { messages.notice(text); };
    hooks.stage = [&](const std::string& text) { messages.stage(text); };
    if (messages.progress().shown()) {
        hooks.progress = [&](const std::string& stage, const CampaignProgress& p) {
            messages.progress().draw({.share = static_cast<double>(p.tests - p.left) /
                                               static_cast<double>(std::max<std::int64_t>(1, p.tests)),
                                      .rate = p.tests_per_second,
                                      .unit = "tests",
                                      .seconds_left = p.seconds_left,
                                      .detail = stage});
        };
    }
    try {
        const CalibrationOutcome outcome = calibrate(rock, options, hooks);
        write_calibration(rock, outcome, options.folder);
        messages.make_room();
        if (!messages.quiet()) print_out("{}", calibration_text(rock, outcome));
        replace_file(options.folder / "calibration.html", calibration_page(rock, outcome, options.folder));
        if (!messages.quiet())
            print_out("  cases, rock.toml, calibration.json and .html in {}\n", options.folder.string());
        return outcome.all_reached() ? exit_done : exit_claim_fails;
    } catch (const TestInterrupted&) {
        messages.make_room();
    }
    if (!messages.hosted()) report_error(words_of_resumable);
    return exit_interrupted;
}

}  // namespace crackle::tools
