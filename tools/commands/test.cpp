// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle test CASE.toml -o OUT`: one virtual test; `--check`: what it will give and cost.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/loading/check.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/measures/verdicts.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/results/describe_files.hpp"
#include "specimens/results/json_number.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/summary_keys.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

std::string shown_value(const nlohmann::ordered_json& summary, const std::string& key) {
    const auto value = summary.find(key);
    if (value == summary.end() || value->is_null()) return "-";
    return value->is_number() ? fmt::format("{:.4g}", value->get<double>()) : value->dump();
}

/// A stress or modulus, and the same in three dimensions where the case gives a thickness.
std::string stress(const nlohmann::ordered_json& summary, const std::string& key) {
    const bool area = summary.value("material_units", "point") == "area";
    const auto value = summary.find(key), converted = summary.find(key + converted_suffix);
    if (value == summary.end() || !value->is_number()) return "-";
    std::string in_plane = spoken_stress(value->get<double>(), area ? "Pa" : "N/m");
    const bool thick = summary.contains("out_of_plane_thickness") && summary["out_of_plane_thickness"].is_number();
    if (area || !thick || converted == summary.end() || !converted->is_number()) return in_plane;
    return fmt::format("{} ({})", in_plane, spoken_stress(converted->get<double>(), "Pa"));
}

void print_figures(const TestOutcome& outcome) {
    const auto& s = outcome.summary.json();
    const bool failed = s.value("failed", false);
    const std::string so_far = failed ? "" : "_so_far";
    std::cout << fmt::format("{}, {}: {}\n", s.value("specimen", ""), s.value("kind", ""),
                             failed ? "the specimen failed"
                                    : "the specimen has not failed (ended by " + s.value("ended_by", "nothing") + ")");
    std::cout << fmt::format("  {} {} at strain {}\n", failed ? "strength" : "largest stress so far",
                             stress(s, "peak_stress" + so_far), shown_value(s, "peak_strain" + so_far));
    if (failed && s.value("largest_stress", 0.0) > s.value("peak_stress", 0.0)) {
        std::cout << fmt::format("  largest stress {} at strain {}: after the peak, no strength\n",
                                 stress(s, "largest_stress"), shown_value(s, "strain_at_largest_stress"));
    }
    if (s.contains("initial_tangent_modulus")) {
        std::cout << fmt::format("  modulus: small strain {}, initial tangent {}, at half the peak {}\n",
                                 stress(s, "youngs_modulus"), stress(s, "initial_tangent_modulus"),
                                 stress(s, "tangent_modulus_50"));
    }
    for (const auto& verdict : s["validity"]) {
        if (verdict["holds"] == false)
            std::cout << fmt::format("  not valid: {}\n", broken_claim(verdict["claim"].get<std::string>(),
                                                                       verdict["found"].get<std::string>()));
    }
    std::cout << fmt::format("  bonds broken: {} of {} ({} interfaces of {})\n", shown_value(s, "bonds_broken"),
                             shown_value(s, "bonds_initial"), shown_value(s, "interfaces_lost"),
                             shown_value(s, "interfaces_initial"));
    std::cout << fmt::format("  errors: energy balance {} of the work, platens out of balance by {} of the peak\n",
                             shown_value(s, "energy_closing_error"), shown_value(s, "platen_out_of_balance"));
    if (s.contains("peak_converged") && s["peak_converged"].is_boolean()) {
        const auto& e = s["numerical_errors"];
        std::cout << fmt::format(
            "  stated errors: strength {}, its strain {}{} of their values; {}\n",
            shown_value(e["peak_stress"], "stated"), shown_value(e["peak_strain"], "stated"),
            e.contains("crack_initiation_stress")
                ? fmt::format(", crack initiation {}, damage {}", shown_value(e["crack_initiation_stress"], "stated"),
                              shown_value(e["crack_damage_stress"], "stated"))
                : "",
            s["peak_converged"].get<bool>() ? "the peak is converged" : "the peak jumps between branches");
    }
    std::cout << fmt::format("  {} steps in {} s: {} particle-steps/s\n", shown_value(s, "steps"),
                             shown_value(s, "step_seconds"), shown_value(s, "particle_steps_per_second"));
    if (s.contains("profile")) std::cout << profile_table(s["profile"]);
    for (const auto& notice : s.value("notices", nlohmann::ordered_json::array())) {
        std::cout << "  notice: " << notice.get<std::string>() << '\n';
    }
    std::cout << "  results in " << outcome.folder.string() << '\n';
}

// Measured with two threads on two processors: 1,240 circles take twice as long, frames being drawn on a third thread;
// 5,022 take 0.57 of the time.
constexpr std::int64_t bodies_worth_a_thread = 2000;

TestHooks hooks_for(Messages& messages) {
    TestHooks hooks;
    hooks.interrupted = interrupted;
    if (!messages.quiet()) hooks.stage = [&messages](const std::string& text) { messages.stage(text); };
    if (messages.verbose()) hooks.detail = [&messages](const std::string& text) { messages.detail(text); };
    if (!messages.progress().shown()) return hooks;
    hooks.working = [&messages](const std::string& what) { messages.progress().draw({.detail = what}); };
    hooks.progress = [&messages](const TestProgress& p) { messages.progress().draw(shown_progress(p)); };
    return hooks;
}

/// What -v reports of a test that has ended.
void report_details(Messages& messages, const TestOutcome& outcome) {
    if (!messages.verbose()) return;
    const auto& s = outcome.summary.json();
    messages.detail(fmt::format("{} steps in {} s on {} threads; mean time step {} s", shown_value(s, "steps"),
                                shown_value(s, "step_seconds"), shown_value(s, "threads"),
                                shown_value(s, "time_step_mean")));
    std::uintmax_t count = 0, bytes = 0;
    std::error_code vanished;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(outcome.folder, vanished)) {
        if (!entry.is_regular_file(vanished)) continue;
        ++count;
        bytes += entry.file_size(vanished);
    }
    messages.detail(fmt::format("{} files, {} bytes in {}", count, bytes, outcome.folder.string()));
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

using Json = nlohmann::ordered_json;

Json loss_as_json(const std::optional<FirstLoss>& loss) {
    if (!loss) return nullptr;
    return {{"strain", loss->strain}, {"stress", loss->stress}, {"body_i", loss->body_i}, {"body_j", loss->body_j}};
}

Json run_as_json(const RunEstimate& run) {
    return {{"strain", run.strain}, {"steps", run.steps}, {"seconds", run.seconds}};
}

std::string loss_text(const std::optional<FirstLoss>& loss, const char* unit) {
    if (!loss) return "none by the linear solution";
    return fmt::format("{} at strain {:.3e}, bodies {} and {}", spoken_stress(loss->stress, unit), loss->strain,
                       loss->body_i, loss->body_j);
}

std::string time_text(double seconds) {
    if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
    return seconds < 7200.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string run_text(const RunEstimate& run) {
    return fmt::format("{:.3g} steps, {}", run.steps, time_text(run.seconds));
}

void print_check(const TestCheck& check) {
    const VirtualTest& test = check.test;
    const char* unit = test.description.stress_unit();
    const double slower = check.rate / check.slowest_rate;
    fmt::print("{}, {}: {} particles, {:.3g} grains wide, {} bonds\n", test.setup.specimen,
               test.description.loading.kind, test.setup.particles, check.grains_across, test.world.bonds.initial);
    if (std::isfinite(check.youngs_modulus) && !test.setup.uniaxial) {
        fmt::print("  small strain   nominal stress over nominal strain {}\n",
                   spoken_stress(check.youngs_modulus, unit));
    } else if (std::isfinite(check.youngs_modulus)) {
        fmt::print("  small strain   E {}, nu {:.3g}, over the gauge length {}\n",
                   spoken_stress(check.youngs_modulus, unit), check.poissons_ratio,
                   spoken_stress(check.gauge_modulus, unit));
    } else {
        fmt::print("  small strain   no linear solution, see the warnings\n");
    }
    fmt::print("  first slip     {}\n", loss_text(check.first_slip, unit));
    fmt::print("  first break    {}\n", loss_text(check.first_break, unit));
    if (const auto& strength = check.strength) {
        fmt::print(
            "  strength       about {} at strain {:.2g}, within a factor of {:.2g}: where {:.3g} % of the bonds "
            "have broken by the linear solution\n",
            spoken_stress(strength->stress, unit, 2), strength->strain, strength->factor, 100.0 * strength->share);
    } else {
        fmt::print("  strength       no estimate: {}\n",
                   test.description.confined() ? "the rule is of specimens without confining pressure"
                   : !test.setup.uniaxial      ? "the rule is of specimens between platens"
                                               : "too few bonds ever break by the linear solution");
    }
    if (check.disc)
        fmt::print(
            "  valid disc     strength over tensile strength about {:.2g}, within a factor of {:.2g}; 3 + N = {:.3g} "
            "is needed\n",
            check.disc->strength_ratio, check.disc->factor, check.disc->needed);
    fmt::print("  run            {}{} to strain {:.3g}; time step {:.3g} s, rate {:.3g} 1/s{}, {:.3g} steps/s\n",
               check.to_strength ? run_text(*check.to_strength) + " to that strength, " : "", run_text(check.to_end),
               check.to_end.strain, test.world.stepping.time_step, check.rate,
               slower > 1.0 ? fmt::format(" (up to {:.2g} times slower while bonds break)", slower) : "",
               check.steps_per_second);
    fmt::print("  memory         {:.0f} MB; making the specimen took {}\n", check.memory / 1e6,
               time_text(test.specimen_seconds));
    for (const std::string& warning : check.warnings) fmt::print("  warning: {}\n", warning);
}

/// `--check`: nothing is loaded, and nothing written.
int check(const Invocation& given) {
    const po::variables_map& values = given.values;
    refuse_unused("crackle test", values, "--check", {"check", "json", "threads", "allow-unstable"});
    if (given.operands.empty()) throw InputError("crackle test: found no CASE.toml, expected one with --check");
    TestCase description = read_case(given_or_shipped(given.operands.front()));
    if (values.contains("allow-unstable")) description.numerics.allow_unstable = true;
    if (values.contains("threads")) description.numerics.threads = values["threads"].as<int>();
    description.numerics.threads = threads_of_machine(static_cast<int>(description.numerics.threads), given.messages);
    watch_interrupts();
    TestHooks hooks = hooks_for(given.messages);
    const bool json = values.contains("json");
    if (json && !given.messages.verbose()) hooks.stage = {};
    // Notices stand among the warnings.
    else if (hooks.stage)
        hooks.stage = [say = hooks.stage](const std::string& text) {
            if (!text.starts_with("notice: ")) say(text);
        };
    try {
        const TestCheck checked = check_test(description, hooks);
        given.messages.make_room();
        if (json)
            std::cout << check_as_json(checked, 2) << '\n';
        else
            print_check(checked);
    } catch (const TestInterrupted& stop) {
        given.messages.make_room();
        report_error(stop.what());
        return exit_interrupted;
    }
    return exit_done;
}

}  // namespace

Progress shown_progress(const TestProgress& test) {
    return {.share = test.share_done,
            .rate = test.steps_per_second,
            .unit = "steps",
            .seconds_left = test.seconds_left,
            .detail = fmt::format("strain {:.3e}, {:.3e} {} (peak {:.3e}), {} bonds broken", test.axial_strain,
                                  test.axial_stress, test.stress_unit, test.peak_stress, test.bonds_broken)};
}

void limit_threads(TestOptions& options, std::int64_t asked) {
    options.fewest_bodies_a_thread = bodies_worth_a_thread;
    // No more are tried than are asked for: many tests may run side by side.
    const ThreadRoom room =
        room_for_threads(static_cast<int>(std::clamp<std::int64_t>(asked, 1, options.most_threads)));
    options.most_threads = room.threads;
    options.most_threads_why = room.why;
}

std::int64_t threads_to_resume(const TestOptions& options) {
    if (options.threads > 0) return options.threads;
    const std::filesystem::path own_case = options.folder / "case.toml";  // elsewhere while results are being moved
    return is_file(own_case) ? read_case(own_case).numerics.threads : options.most_threads;
}

std::string check_as_json(const TestCheck& check, int indent) {
    const VirtualTest& test = check.test;
    const std::string stress = test.description.stress_unit();
    Json json{{"title", test.description.title},
              {"kind", test.description.loading.kind},
              {"platens", test.description.loading.platens},
              {"specimen", test.setup.specimen},
              {"particles", test.setup.particles},
              {"grains_across", check.grains_across},
              {"bonds", test.world.bonds.initial},
              {test.setup.uniaxial ? "youngs_modulus" : "nominal_modulus", finite_or_null(check.youngs_modulus)},
              {"poissons_ratio", finite_or_null(check.poissons_ratio)},
              {"gauge_modulus", finite_or_null(check.gauge_modulus)},
              {"first_slip", loss_as_json(check.first_slip)},
              {"first_break", loss_as_json(check.first_break)},
              {"strength_estimate", nullptr},
              {"time_step", test.world.stepping.time_step},
              {"axial_strain_rate", check.rate},
              {"slowest_axial_strain_rate", check.slowest_rate},
              {"steps_per_second", check.steps_per_second},
              {"run_to_strength", check.to_strength ? run_as_json(*check.to_strength) : Json(nullptr)},
              {"run_to_max_axial_strain", run_as_json(check.to_end)},
              {"specimen_seconds", test.specimen_seconds},
              {"memory", check.memory},
              {"warnings", check.warnings}};
    if (const auto& strength = check.strength)
        json["strength_estimate"] = {{"stress", strength->stress},
                                     {"strain", strength->strain},
                                     {"share_broken", strength->share},
                                     {"within_factor", strength->factor}};
    if (const auto& disc = check.disc) {
        const std::optional<bool> valid = disc->can_be_valid();
        json["valid_disc"] = {{"strength_ratio", disc->strength_ratio},
                              {"within_factor", disc->factor},
                              {"friction_angle", disc->friction_angle},
                              {"needed", disc->needed},
                              {"can_be_valid", valid ? Json(*valid) : Json(nullptr)}};
    }
    json["units"] = {
        {"grains_across", "width over sqrt(width height / particles)"},
        {"youngs_modulus", stress +
                               ", small strain, all bonds intact and sticking; nominal_modulus in its place where the "
                               "test is not between platens"},
        {"gauge_modulus", stress + ", over the strain of the axial gauge length"},
        {"first_slip", "strain; stress in " + stress + "; null: none by the linear solution"},
        {"first_break", "likewise"},
        {"strength_estimate",
         "rough: modulus times the strain at which share_broken of the points that can break has broken by the linear "
         "solution; within_factor: the most it was off by in the cases it is calibrated with"},
        {"time_step", "s"},
        {"axial_strain_rate", "1/s, to begin with"},
        {"slowest_axial_strain_rate", "1/s, while many bonds break"},
        {"steps_per_second", "1/s, measured on this machine now"},
        {"run_to_strength", "steps and seconds at the first rate; null without an estimate below max_axial_strain"},
        {"run_to_max_axial_strain", "likewise, should the specimen not fail before"},
        {"specimen_seconds", "s, making the specimen"},
        {"memory", "bytes, largest of this check"}};
    if (check.disc)
        json["units"]["valid_disc"] =
            "strength_ratio: of the rock, over its tensile strength, both estimated by the linear solution of the "
            "whole packing; needed: 3 + (1 + sin φ)/(1 - sin φ), φ friction_angle in degrees, mean of the bonds; "
            "can_be_valid null: too rough to tell";
    return json.dump(indent);
}

CommandLine describe_test() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("OUT"), "folder for the results")  //
        ("force", "replace the results in OUT once the new ones are complete")                                //
        ("resume", po::value<std::string>()->value_name("OUT"),
         "go on with the test in this folder from its last checkpoint")                                          //
        ("verify", "run the test's companions too (half step, half rate, half and double damping): error bars")  //
        ("profile", "time the phases of a step: a table, and `profile` in summary.json")                         //
        ("threads", po::value<int>()->value_name("N"),
         "threads (default: the case's); results do not depend on them")     //
        ("long", "run it although it takes more than a day, or 1e10 steps")  //
        ("check",
         "make and bond the specimen, and print what to expect: moduli, first slip and break, a rough strength, steps, "
         "seconds, memory, warnings; loads and writes nothing")                              //
        ("json", "with --check: print one JSON object")                                      //
        ("allow-unstable", "accept a time step above the stable bound, and runaway energy")  //
        ("keys", "list all keys of a case")                                                  //
        ("files", "list the files of a test: every column, key and array, with its unit");
    return {.synopses = {"crackle test CASE.toml -o OUT [OPTIONS]", "crackle test --resume OUT [OPTIONS]",
                         "crackle test --check CASE.toml [--json]"},
            .description =
                "Makes the specimen that CASE.toml describes, bonds it with its platens, loads it until it fails, and "
                "writes into OUT: curve.csv, events.csv, summary.json, frames/ (ParaView), checkpoint, and case.toml "
                "with every value in the open.",
            .options = {{"options", options}},
            .operand = "CASE.toml",
            .companions = {{"json", {"check"}}},
            .verbose = "seconds of each stage, bodies and contacts, the time step and why, bytes written",
            .examples = {{"crackle test specimens/guide_rock/circles_tension.toml -o out/circles-tension"},
                         {"crackle test case.toml -o out/case --threads 2 -q"},
                         {"crackle test --check case.toml"},
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
        expect_alone("crackle test", given, "keys");
        describe_case_keys(std::cout);
        return exit_done;
    }
    if (values.contains("files")) {
        expect_alone("crackle test", given, "files");
        describe_test_files(std::cout);
        return exit_done;
    }
    if (values.contains("threads") && values["threads"].as<int>() < 1) {
        throw InputError(fmt::format("crackle test: --threads: found {}, expected a whole number >= 1",
                                     values["threads"].as<int>()));
    }
    if (values.contains("check")) return check(given);
    const bool resume = values.contains("resume");
    if (resume != given.operands.empty()) {
        throw InputError(
            resume
                ? "crackle test: found CASE.toml and --resume, expected one of them; a resumed test has its case in OUT"
                : "crackle test: found no CASE.toml, expected one, or --resume OUT (see crackle test --help)");
    }
    if (!resume && !values.contains("output"))
        throw InputError("crackle test: found no -o OUT, expected a folder for the results");
    if (resume) refuse_unused("crackle test", values, "--resume", {"resume", "verify", "threads"});

    options.folder = values[resume ? "resume" : "output"].as<std::string>();
    options.force = values.contains("force");
    options.verify = values.contains("verify");
    options.profile = values.contains("profile");
    options.threads = values.contains("threads") ? values["threads"].as<int>() : 0;
    options.endless = values.contains("long");
    options.command = "crackle test";
    for (const std::string& word : given.words) options.command += ' ' + word;
    watch_interrupts();
    const TestHooks hooks = hooks_for(given.messages);
    TestOutcome outcome;
    if (resume) {
        limit_threads(options, threads_to_resume(options));
        outcome = resume_test(options, hooks);
    } else {
        TestCase description = read_case(given_or_shipped(given.operands.front()));
        limit_threads(options, options.threads > 0 ? options.threads : description.numerics.threads);
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
