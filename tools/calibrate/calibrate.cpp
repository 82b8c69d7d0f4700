// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle calibrate ROCK.toml -o DIR`: the keys of a rock from its laboratory values.
// Tested by tests/tools/calibrate/calibrate_test.cpp.

#include <fmt/format.h>

#include <iostream>
#include <optional>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "solver/files/text_table.hpp"
#include "specimens/calibration/calibrate.hpp"
#include "specimens/calibration/outcome_files.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/calibrate/calibration_page.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

namespace fs = std::filesystem;

/// A folder is taken that is new, empty, or a calibration's.
void check_folder(const fs::path& folder) {
    if (!is_there(folder)) return;
    if (is_folder(folder) && (fs::is_empty(folder) || is_there(folder / "search" / "campaign.sqlite") ||
                              is_there(folder / "search" / "packings")))
        return;
    throw InputError(
        fmt::format("{}: found files that no calibration made, expected a new folder or a calibration's; "
                    "choose another -o",
                    folder.string()));
}

void print_plan(const Rock& rock) {
    fmt::print("{}: {}, {}, {}\n", rock.title, counted(rock.targets.size(), "target"),
               counted(rock.free.size(), "free key"), counted(rock.tests.size(), "test"));
    TextTable table("<<");
    for (const Target& target : rock.targets)
        table.add(
            {target.name(rock.tests), fmt::format("{:.6g} within {:.3g} %", target.value, 100.0 * target.tolerance)});
    for (const FreeKey& free : rock.free)
        table.add({free.name(), fmt::format("{:.4g} to {:.4g}, from {:.4g}", free.from, free.to, free.start)});
    fmt::print("{}", table.text());
    const auto tests = static_cast<std::int64_t>(rock.tests.size());
    fmt::print("  a round is up to {}, two to ten of them; then {} up to three times, and {}\n",
               counted(static_cast<std::int64_t>(2 * rock.free.size() + 3) * tests * rock.fit, "test"),
               counted(rock.polish * tests, "test"), rock.fresh * tests);
}

}  // namespace

CommandLine describe_calibrate() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"), "folder of the calibration")     //
        ("workers", po::value<int>()->value_name("N"), "processes that run tests (default: one a processor lent)")  //
        ("dry-run", "judge the file and all corners of its bounds; run nothing, write nothing")                     //
        ("long", "run tests although they take more than a day, or 1e10 steps")                                     //
        ("keys", "list all keys of a rock's file");
    return {
        .synopses = {"crackle calibrate ROCK.toml -o DIR [OPTIONS]"},
        .description =
            "Finds the free keys of a rock's cases so that the means of its tests over packings are the targets "
            "that a laboratory has measured: moduli by sparse linear solves, strengths by a response surface over "
            "wide designs on the same packings. Ends with cases (DIR/cases/TEST.toml), the keys with their intervals "
            "(DIR/rock.toml), and a table of what fresh packings reach; says which targets are out of reach, with "
            "their frontier, and which keys the targets do not determine. Stopped at any moment, the same command "
            "goes on. Exit code 1: a target was not reached.",
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
        std::cout << describe_rock_keys();
        return exit_done;
    }
    if (given.operands.empty())
        throw InputError("crackle calibrate: found no ROCK.toml, expected one (see crackle calibrate --help)");
    const bool dry = values.contains("dry-run");
    if (!dry && !values.contains("output"))
        throw InputError("crackle calibrate: found no -o, expected -o DIR, a folder for the calibration");
    const auto asked = values.contains("workers") ? std::optional(values["workers"].as<int>()) : std::nullopt;
    const int workers = workers_of_machine(asked, "crackle calibrate");
    const Rock rock = read_rock(given_or_shipped(given.operands.front()));
    if (dry) {
        print_plan(rock);
        return exit_done;
    }
    watch_interrupts();
    CalibrationOptions options;
    options.folder = values["output"].as<std::string>();
    options.workers = workers;
    options.endless = values.contains("long");
    check_folder(options.folder);
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
        if (!messages.quiet()) fmt::print("{}", calibration_text(rock, outcome));
        replace_file(options.folder / "calibration.html", calibration_page(rock, outcome, options.folder));
        if (!messages.quiet())
            fmt::print("  cases, rock.toml, calibration.json and .html in {}\n", options.folder.string());
        return outcome.all_reached() ? exit_done : exit_claim_fails;
    } catch (const TestInterrupted&) {
        messages.make_room();
    }
    if (!messages.hosted()) report_error("interrupted; the same command goes on");
    return exit_interrupted;
}

}  // namespace crackle::tools
