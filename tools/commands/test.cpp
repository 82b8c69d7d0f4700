// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle test CASE.toml -o OUT`: one virtual test.

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "solver/base/errors.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/results/describe_files.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/summary.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"

namespace crackle::tools {
namespace {

std::string shown(const nlohmann::ordered_json& summary, const std::string& key) {
    const auto value = summary.find(key);
    if (value == summary.end() || value->is_null()) return "-";
    return value->is_number() ? fmt::format("{:.4g}", value->get<double>()) : value->dump();
}

/// A stress or modulus, and the same in three dimensions where the case gives a thickness.
std::string stress(const nlohmann::ordered_json& summary, const std::string& key) {
    const std::string in_plane = shown(summary, key) + " N/m";
    const auto converted = summary.find(key + converted_suffix);
    const bool thick = summary.contains("out_of_plane_thickness") && summary["out_of_plane_thickness"].is_number();
    if (!thick || converted == summary.end() || !converted->is_number()) return in_plane;
    return fmt::format("{} ({:.4g} MPa)", in_plane, 1e-6 * converted->get<double>());
}

void print_figures(const TestOutcome& outcome) {
    const auto& s = outcome.summary;
    const bool failed = s.value("failed", false);
    const std::string so_far = failed ? "" : "_so_far";
    std::cout << fmt::format("{}, {}: {}\n", s.value("specimen", ""), s.value("kind", ""),
                             failed ? "failed" : "has not failed (ended by " + s.value("ended_by", "nothing") + ")");
    std::cout << fmt::format("  {} {} at strain {}\n", failed ? "strength" : "largest stress so far",
                             stress(s, "peak_stress" + so_far), shown(s, "peak_strain" + so_far));
    if (failed && s.value("largest_stress", 0.0) > s.value("peak_stress", 0.0)) {
        std::cout << fmt::format("  largest stress {} at strain {}: after the peak, no strength\n",
                                 stress(s, "largest_stress"), shown(s, "strain_at_largest_stress"));
    }
    std::cout << fmt::format("  modulus: small strain {}, initial tangent {}, at half the peak {}\n",
                             stress(s, "youngs_modulus"), stress(s, "initial_tangent_modulus"),
                             stress(s, "tangent_modulus_50"));
    std::cout << fmt::format("  bonds broken: {} of {} ({} interfaces of {})\n", shown(s, "bonds_broken"),
                             shown(s, "bonds_initial"), shown(s, "interfaces_lost"), shown(s, "interfaces_initial"));
    std::cout << fmt::format("  errors: energy balance {} of the work, platens out of balance by {} of the peak\n",
                             shown(s, "energy_closing_error"), shown(s, "platen_out_of_balance"));
    if (s.contains("peak_converged") && s["peak_converged"].is_boolean()) {
        const auto& e = s["numerical_errors"];
        std::cout << fmt::format(
            "  stated errors: strength {}, its strain {} of their values; {}\n", shown(e["peak_stress"], "stated"),
            shown(e["peak_strain"], "stated"),
            s["peak_converged"].get<bool>() ? "the peak is converged" : "the peak jumps between branches");
    }
    std::cout << fmt::format("  {} steps in {} s: {} particle-steps/s\n", shown(s, "steps"), shown(s, "step_seconds"),
                             shown(s, "particle_steps_per_second"));
    if (s.contains("profile")) std::cout << profile_table(s["profile"]);
    for (const auto& notice : s.value("notices", nlohmann::ordered_json::array())) {
        std::cout << "  notice: " << notice.get<std::string>() << '\n';
    }
    std::cout << "  results in " << outcome.folder.string() << '\n';
}

TestHooks hooks_for(Messages& messages) {
    TestHooks hooks;
    hooks.interrupted = interrupted;
    if (!messages.quiet()) hooks.stage = [&messages](const std::string& text) { messages.stage(text); };
    if (messages.verbose()) hooks.detail = [&messages](const std::string& text) { messages.detail(text); };
    if (!messages.progress().shown()) return hooks;
    hooks.working = [&messages](const std::string& what) { messages.progress().draw({.detail = what}); };
    hooks.progress = [&messages](const TestProgress& p) {
        messages.progress().draw(
            {.share = p.share_done,
             .rate = p.steps_per_second,
             .unit = "steps",
             .seconds_left = p.seconds_left,
             .detail = fmt::format("strain {:.3e}, {:.3e} N/m (peak {:.3e}), {} bonds broken", p.axial_strain,
                                   p.axial_stress, p.peak_stress, p.bonds_broken)});
    };
    return hooks;
}

/// What -v reports of a test that has ended.
void report_details(Messages& messages, const TestOutcome& outcome) {
    if (!messages.verbose()) return;
    const auto& s = outcome.summary;
    messages.detail(fmt::format("{} steps in {} s on {} threads; mean time step {} s", shown(s, "steps"),
                                shown(s, "step_seconds"), shown(s, "threads"), shown(s, "time_step_mean")));
    std::uintmax_t files = 0, bytes = 0;
    std::error_code vanished;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(outcome.folder, vanished)) {
        if (!entry.is_regular_file(vanished)) continue;
        ++files;
        bytes += entry.file_size(vanished);
    }
    messages.detail(fmt::format("{} files, {} bytes in {}", files, bytes, outcome.folder.string()));
}

int finish(const TestOutcome& outcome, const std::string& wanted, Messages& messages) {
    const bool quiet = messages.quiet();
    messages.make_room();
    report_details(messages, outcome);
    if (outcome.was_finished) {
        if (!quiet) std::cout << outcome.folder.string() << ": the test is finished, nothing is left to do\n";
        const std::string newer = outcome.folder.string() + ".new";
        if (holds_test_results(newer))
            messages.notice(
                fmt::format("{0} holds one that was to replace it; go on with `crackle test --resume {0}`", newer));
        return exit_done;
    }
    if (!quiet) print_figures(outcome);
    if (outcome.unverified) {
        report_error(fmt::format(
            "the test is complete, its companions were interrupted and no error is stated; `crackle test --resume {} "
            "--verify` runs them again",
            outcome.folder.string()));
        return exit_interrupted;
    }
    if (!outcome.interrupted) return exit_done;
    if (outcome.folder != std::filesystem::path(wanted)) {
        messages.notice(fmt::format("earlier results in {} are as they were", wanted));
    }
    report_error(fmt::format("interrupted; go on with `crackle test --resume {}`", outcome.folder.string()));
    return exit_interrupted;
}

}  // namespace

CommandLine describe_test() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("OUT"), "folder for the results")  //
        ("force", "replace the results in OUT once the new ones are complete")                                //
        ("resume", po::value<std::string>()->value_name("OUT"),
         "go on with the test in this folder from its last checkpoint")                                          //
        ("verify", "run the test's companions too (half step, half rate, half and double damping): error bars")  //
        ("profile", "time the phases of a step: a table, and `profile` in summary.json")                         //
        ("threads", po::value<int>()->value_name("N"),
         "threads (default: the case's); results do not depend on them")                     //
        ("allow-unstable", "accept a time step above the stable bound, and runaway energy")  //
        ("keys", "list all keys of a case")                                                  //
        ("files", "list the files of a test: every column, key and array, with its unit");
    return {.synopses = {"crackle test CASE.toml -o OUT [OPTIONS]", "crackle test --resume OUT [OPTIONS]"},
            .description =
                "Makes the specimen that CASE.toml describes, bonds it with its platens, loads it until it fails, and "
                "writes into OUT: curve.csv, events.csv, summary.json, frames/ (ParaView), checkpoint, and case.toml "
                "with every value in the open.",
            .options = {{"options", options}},
            .operand = "CASE.toml",
            .verbose = "seconds of each stage, bodies and contacts, the time step and why, bytes written",
            .examples = {{"crackle test specimens/guide_rock/circles_tension.toml -o out/circles-tension"},
                         {"crackle test case.toml -o out/case --threads 2 -q"},
                         {"crackle test case.toml -o out/case --verify"},
                         {"crackle test case.toml -o out/case --profile"},
                         {"crackle test --resume out/case",
                          "goes on after an interrupt, to the bytes of an "
                          "uninterrupted test"},
                         {"crackle test --keys", "all keys of a case, with units, defaults and ranges"},
                         {"crackle test --files", "all columns, keys and arrays of the files in OUT"}}};
}

int test(const Invocation& given) {
    TestOptions options;  // takes the time
    const po::variables_map& values = given.values;
    if (values.contains("keys")) {
        describe_case_keys(std::cout);
        return exit_done;
    }
    if (values.contains("files")) {
        describe_test_files(std::cout);
        return exit_done;
    }
    const bool resume = values.contains("resume");
    if (resume != given.operands.empty()) {
        throw InputError(
            resume
                ? "crackle test: found CASE.toml and --resume, expected one of them; a resumed test has its case in OUT"
                : "crackle test: found no CASE.toml, expected one, or --resume OUT (see crackle test --help)");
    }
    if (!resume && !values.contains("output"))
        throw InputError("crackle test: found no -o OUT, expected a folder for the results");
    if (resume && values.contains("output"))
        throw InputError("crackle test: found -o with --resume, expected OUT behind --resume alone");
    if (resume && values.contains("profile"))
        throw InputError("crackle test: found --profile with --resume, expected it with a whole test");
    if (values.contains("threads") && values["threads"].as<int>() < 1) {
        throw InputError(fmt::format("crackle test: --threads: found {}, expected a whole number >= 1",
                                     values["threads"].as<int>()));
    }

    options.folder = values[resume ? "resume" : "output"].as<std::string>();
    options.force = values.contains("force");
    options.verify = values.contains("verify");
    options.profile = values.contains("profile");
    options.threads = values.contains("threads") ? values["threads"].as<int>() : 0;
    options.command = "crackle test";
    for (const std::string& word : given.words) options.command += ' ' + word;
    watch_interrupts();
    const TestHooks hooks = hooks_for(given.messages);
    TestOutcome outcome;
    if (resume) {
        outcome = resume_test(options, hooks);
    } else {
        TestCase description = read_case(given.operands.front());
        if (values.contains("allow-unstable")) description.numerics.allow_unstable = true;
        try {
            outcome = run_test(description, options, hooks);
        } catch (const TestInterrupted& stop) {
            given.messages.make_room();
            report_error(stop.what());
            return exit_interrupted;
        }
    }
    return finish(outcome, options.folder.string(), given.messages);
}

}  // namespace crackle::tools
