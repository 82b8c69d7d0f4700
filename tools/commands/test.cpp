// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle test CASE.toml -o OUT`: runs one virtual test; `--check` estimates its results and cost.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/files/output_path.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/check.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/measures/verdicts.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/results/describe_files.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/statistics/spoken.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

constexpr const char* nothing_written = "interrupted before loading began; nothing was written";

template <class T>
std::string shown(const Stated<T>& value) {
    return value ? fmt::format("{:.4g}", value.or_nan()) : "-";
}

/// A stress or modulus as text, with the three-dimensional value if the case gives a thickness.
std::string shown(const Stress& value, const Summary& s) {
    const bool area = s.about.material_units == StiffnessUnits::area;
    if (!value) return "-";
    std::string in_plane = spoken_stress(*value, area ? "Pa" : "N/m");
    if (area || !s.out_of_plane_thickness || !value.converted) return in_plane;
    return fmt::format("{} ({})", in_plane, spoken_stress(*value.converted, "Pa"));
}

void print_stated_errors(const ErrorsByFigure& errors, bool converged) {
    const auto of = [](const Stated<ErrorFigures>& one) { return shown(one.value_or(ErrorFigures{}).stated); };
    print_out("  stated errors: strength {}, its strain {}{} of their values; {}\n", of(errors.peak_stress),
              of(errors.peak_strain),
              errors.crack_initiation_stress
                  ? fmt::format(", crack initiation {}, damage {}", of(errors.crack_initiation_stress),
                                of(errors.crack_damage_stress))
                  : "",
              converged ? "the peak is converged" : "the peak differs between runs (branches)");
}

void print_figures(const TestOutcome& outcome) {
    const Summary& s = outcome.summary;
    const Strength& known = s.strength;
    const bool failed = s.about.failed.value_or(false);
    print_out("{}, {}: {}\n", s.about.specimen.name(), s.about.kind.name(),
              failed ? "the specimen failed"
                     : "the specimen has not failed (reason for the end of the test: " +
                           s.about.ended_by.value_or("nothing") + ")");
    print_out("  {} {} at strain {}\n", failed ? "strength" : "largest stress so far",
              shown(failed ? known.peak_stress : known.peak_stress_so_far, s),
              shown(failed ? known.peak_strain : known.peak_strain_so_far));
    if (failed && known.largest_stress.or_nan() > known.peak_stress.or_nan()) {
        print_out("  largest stress {} at strain {}: after the peak, no strength\n", shown(known.largest_stress, s),
                  shown(known.strain_at_largest_stress));
    }
    if (known.initial_tangent_modulus.stated()) {
        print_out("  modulus: small strain {}, initial tangent {}, at half the peak {}\n",
                  shown(known.youngs_modulus, s), shown(known.initial_tangent_modulus, s),
                  shown(known.tangent_modulus_50, s));
    }
    for (const JudgedClaim& verdict : *s.validity.validity)
        if (!verdict.holds.value_or(true)) print_out("  not valid: {}\n", broken_claim(*verdict.claim, *verdict.found));
    print_out("  bonds broken: {} of {} ({} interfaces of {})\n", shown(s.damage.bonds_broken),
              shown(s.specimen.bonds_initial), shown(s.damage.interfaces_lost), shown(s.specimen.interfaces_initial));
    print_out("  errors: energy balance {} of the work, platens out of balance by {} of the peak\n",
              shown(s.numerics.energy_closing_error), shown(s.numerics.platen_out_of_balance));
    if (s.peak_converged) print_stated_errors(*s.numerical_errors, *s.peak_converged);
    print_out("  {} steps in {} s: {} particle-steps/s\n", shown(s.numerics.steps), shown(s.run.step_seconds),
              shown(s.run.particle_steps_per_second));
    if (s.run.profile) print_text(profile_table(*s.run.profile));
    for (const std::string& notice : *s.notices) print_out("  notice: {}\n", notice);
    print_out("  results in {}\n", outcome.folder.string());
}

// Smallest number of bodies per thread. With fewer, a test takes longer than on one thread, because a further thread
// already draws its frames.
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

/// Prints the details of a finished test that -v shows.
void report_details(Messages& messages, const TestOutcome& outcome) {
    if (!messages.verbose()) return;
    const Summary& s = outcome.summary;
    messages.detail(fmt::format("{} steps in {} s on {} threads; mean time step {} s", shown(s.numerics.steps),
                                shown(s.run.step_seconds), shown(s.run.threads), shown(s.numerics.time_step_mean)));
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
        if (!quiet) print_out("{}: the test is finished; nothing is left to do\n", outcome.folder.string());
        const std::string newer = outcome.folder.string() + ".new";
        if (holds_test_results(newer))
            messages.notice(fmt::format(
                "{0} contains an unfinished test that was to replace it; resume that with `crackle test --resume {0}`",
                newer));
        return exit_done;
    }
    if (!quiet) print_figures(outcome);
    if (outcome.unverified) {
        report_error(
            fmt::format("the test is complete, but its companion tests were interrupted, so no errors are stated; run "
                        "them again with `crackle test --resume {} --verify`",
                        outcome.folder.string()));
        return exit_interrupted;
    }
    if (!outcome.interrupted) return exit_done;
    if (outcome.folder != output_folder(wanted)) {
        messages.notice(fmt::format("earlier results in {} are unchanged", wanted));
    }
    report_error(fmt::format("interrupted; resume with `crackle test --resume {}`", outcome.folder.string()));
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

Json strength_as_json(const StrengthEstimate& strength) {
    return {{"stress", strength.stress},
            {"strain", strength.strain},
            {"share_broken", strength.share},
            {"within_factor", strength.factor}};
}

Json disc_as_json(const DiscOutlook& disc) {
    const std::optional<bool> valid = disc.can_be_valid();
    return {{"strength_ratio", disc.strength_ratio},
            {"within_factor", disc.factor},
            {"friction_angle", disc.friction_angle},
            {"needed", disc.needed},
            {"can_be_valid", valid ? Json(*valid) : Json(nullptr)}};
}

/// Units and meanings of the keys that `--check --json` prints. @param stress unit of stress
Json units_of_check(const std::string& stress, bool of_disc) {
    Json units{
        {"grains_across", "width of the specimen divided by the mean grain size sqrt(width height / particles)"},
        {"youngs_modulus", stress + ", at small strain, with all bonds intact and no slip; replaced by nominal_modulus "
                                    "for tests without platens"},
        {"gauge_modulus", stress + ", stress divided by the strain of the axial gauge length"},
        {"first_slip", "strain; stress in " + stress + "; null if it does not occur in the linear solution"},
        {"first_break", "as first_slip"},
        {"strength_estimate",
         "rough estimate: modulus times the strain at which a fraction share_broken of the breakable points has broken "
         "in the linear solution. within_factor: its largest error, as a factor, in the cases used to calibrate it"},
        {"time_step", "s"},
        {"axial_strain_rate", "1/s, at the start of loading"},
        {"slowest_axial_strain_rate", "1/s, lowest axial strain rate, used while many bonds break"},
        {"steps_per_second", "1/s, measured on this machine during the check"},
        {"run_to_strength",
         "steps and seconds at the initial rate; null if the estimated strength is not reached below max_axial_strain"},
        {"run_to_max_axial_strain", "steps and seconds if the specimen does not fail earlier"},
        {"specimen_seconds", "s, time to make the specimen"},
        {"memory", "bytes, peak memory of this check"}};
    if (of_disc)
        units["valid_disc"] =
            "strength_ratio: ratio of the rock's strength to its tensile strength, both estimated by the linear "
            "solution of the whole packing. needed: 3 + (1 + sin φ)/(1 - sin φ) with φ = friction_angle in degrees, "
            "the mean over the bonds. can_be_valid: null if the estimate is too rough to decide";
    return units;
}

std::string loss_text(const std::optional<FirstLoss>& loss, const char* unit) {
    if (!loss) return "does not occur in the linear solution";
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
    print_out("{}, {}: {} particles, {:.3g} grains wide, {} bonds\n", name_of(test.setup.specimen.kind),
              name_of(test.description.loading.kind), test.setup.specimen.particles, check.grains_across,
              test.world.bonds.initial);
    if (std::isfinite(check.youngs_modulus) && !test.setup.apparatus.uniaxial) {
        print_out("  small strain   nominal modulus {}\n", spoken_stress(check.youngs_modulus, unit));
    } else if (std::isfinite(check.youngs_modulus)) {
        print_out("  small strain   E {}, nu {:.3g}; E over the gauge length {}\n",
                  spoken_stress(check.youngs_modulus, unit), check.poissons_ratio,
                  spoken_stress(check.gauge_modulus, unit));
    } else {
        print_out("  small strain   no linear solution (see the warnings)\n");
    }
    print_out("  first slip     {}\n", loss_text(check.first_slip, unit));
    print_out("  first break    {}\n", loss_text(check.first_break, unit));
    if (const auto& strength = check.strength) {
        print_out(
            "  strength       about {} at strain {:.2g}, within a factor of {:.2g}; {:.3g} % of the bonds have then "
            "broken in the linear solution\n",
            spoken_stress(strength->stress, unit, 2), strength->strain, strength->factor, 100.0 * strength->share);
    } else {
        print_out("  strength       no estimate: {}\n",
                  test.description.confined()      ? "the estimate applies only to tests without confining pressure"
                  : !test.setup.apparatus.uniaxial ? "the estimate applies only to specimens between platens"
                                                   : "too few bonds break in the linear solution");
    }
    if (check.disc)
        print_out(
            "  valid disc     ratio of strength to tensile strength about {:.2g}, within a factor of {:.2g}; at least "
            "3 + N = {:.3g} is needed\n",
            check.disc->strength_ratio, check.disc->factor, check.disc->needed);
    print_out("  run            {}{} to strain {:.3g}; time step {:.3g} s, rate {:.3g} 1/s{}, {:.3g} steps/s\n",
              check.to_strength ? run_text(*check.to_strength) + " to that strength, " : "", run_text(check.to_end),
              check.to_end.strain, test.world.stepping.time_step, check.rate,
              slower > 1.0 ? fmt::format(" (up to {:.2g} times slower while bonds break)", slower) : "",
              check.steps_per_second);
    print_out("  memory         {:.0f} MB; making the specimen took {}\n", check.memory / 1e6,
              time_text(test.specimen_seconds));
    for (const std::string& warning : check.warnings) print_out("  warning: {}\n", warning);
}

/// Runs `--check`, which neither loads the specimen nor writes files.
int check(const Invocation& given) {
    const po::variables_map& values = given.values;
    refuse_unused("crackle test", values, "--check", {"check", "json", "threads", "allow-unstable"});
    if (given.operands.empty())
        throw InputError("crackle test: --check: found no CASE.toml, expected one (see crackle test --help)");
    ResolvedCase description = read_case(given_or_shipped(given.operands.front()));
    if (values.contains("allow-unstable")) description.numerics.allow_unstable = true;
    if (values.contains("threads")) description.numerics.threads = values["threads"].as<int>();
    description.numerics.threads = threads_of_machine(description.numerics.threads, given.messages);
    watch_interrupts();
    end_unheard(nothing_written);
    TestHooks hooks = hooks_for(given.messages);
    const bool json = values.contains("json");
    if (json && !given.messages.verbose()) hooks.stage = {};
    // Notices are not printed here, since print_check() prints them together with the warnings.
    else if (hooks.stage)
        hooks.stage = [say = hooks.stage](const std::string& text) {
            if (!text.starts_with("notice: ")) say(text);
        };
    try {
        const TestCheck checked = check_test(description, hooks);
        given.messages.make_room();
        if (json)
            print_text(check_as_json(checked, 2) + '\n');
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
    // Tries to start no more threads than requested, since many tests may run at the same time.
    const ThreadRoom room =
        room_for_threads(static_cast<int>(std::clamp<std::int64_t>(asked, 1, options.most_threads)));
    options.most_threads = room.threads;
    options.most_threads_why = room.why;
}

std::int64_t threads_to_resume(const TestOptions& options) {
    if (options.threads > 0) return options.threads;
    // The case file is temporarily absent while results are being moved.
    const std::filesystem::path own_case = options.folder / "case.toml";
    return is_file(own_case) ? read_case(own_case).numerics.threads : options.most_threads;
}

std::string check_as_json(const TestCheck& check, int indent) {
    const VirtualTest& test = check.test;
    const std::string stress = test.description.stress_unit();
    Json json{{"title", test.description.title},
              {"kind", name_of(test.description.loading.kind)},
              {"platens", name_of(test.description.loading.platens)},
              {"specimen", name_of(test.setup.specimen.kind)},
              {"particles", test.setup.specimen.particles},
              {"grains_across", check.grains_across},
              {"bonds", test.world.bonds.initial},
              {test.setup.apparatus.uniaxial ? "youngs_modulus" : "nominal_modulus", check.youngs_modulus},
              {"poissons_ratio", check.poissons_ratio},
              {"gauge_modulus", check.gauge_modulus},
              {"first_slip", loss_as_json(check.first_slip)},
              {"first_break", loss_as_json(check.first_break)},
              {"strength_estimate", check.strength ? strength_as_json(*check.strength) : Json(nullptr)},
              {"time_step", test.world.stepping.time_step},
              {"axial_strain_rate", check.rate},
              {"slowest_axial_strain_rate", check.slowest_rate},
              {"steps_per_second", check.steps_per_second},
              {"run_to_strength", check.to_strength ? run_as_json(*check.to_strength) : Json(nullptr)},
              {"run_to_max_axial_strain", run_as_json(check.to_end)},
              {"specimen_seconds", test.specimen_seconds},
              {"memory", check.memory},
              {"warnings", check.warnings}};
    if (check.disc) json["valid_disc"] = disc_as_json(*check.disc);
    json["units"] = units_of_check(stress, check.disc.has_value());
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

CommandLine describe_test() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("OUT"), "folder for the results")  //
        ("force", "replace the results in OUT once the new ones are complete")                                //
        ("resume", po::value<std::string>()->value_name("OUT"),
         "resume the test in this folder from its last checkpoint")  //
        ("verify",
         "also run companion tests (half the time step, half the rate, half and double the damping) to estimate "
         "numerical errors")                                                                                     //
        ("profile", "time the phases of a step, print a table of the times, and add `profile` to summary.json")  //
        ("threads", po::value<int>()->value_name("N"),
         "number of threads (default: as in the case); does not affect the results")  //
        ("long", "run the test even if it takes more than a day, or 1e10 steps")      //
        ("check",
         "make and bond the specimen, and print what to expect: moduli, first slip and break, a rough strength, steps, "
         "seconds, memory, warnings. Nothing is loaded or written")                                              //
        ("json", "with --check: print one JSON object")                                                          //
        ("allow-unstable", "accept a time step above the stability limit, and energy that grows without bound")  //
        ("keys", "list all keys of a case")                                                                      //
        ("files", "list the files of a test: every column, key and array, with its unit");
    return {.synopses = {"crackle test CASE.toml -o OUT [OPTIONS]", "crackle test --resume OUT [OPTIONS]",
                         "crackle test --check CASE.toml [--json]"},
            .description =
                "Makes the specimen that CASE.toml describes, bonds it with its platens, and loads it until it fails. "
                "Writes into OUT: curve.csv, events.csv, summary.json, frames/ (ParaView), checkpoint, and case.toml "
                "with all values written out.",
            .options = {{"options", options}},
            .operand = "CASE.toml",
            .companions = {{"json", {"check"}}},
            .verbose =
                "time taken by each stage in seconds, numbers of bodies, contacts and bytes written, and the time step "
                "and how it was chosen",
            .examples = {{"crackle test specimens/guide_rock/circles_tension.toml -o out/circles-tension"},
                         {"crackle test case.toml -o out/case --threads 2 -q"},
                         {"crackle test --check case.toml"},
                         {"crackle test case.toml -o out/case --verify"},
                         {"crackle test case.toml -o out/case --profile"},
                         {"crackle test --resume out/case",
                          "resumes after an interruption; results are identical to those of an uninterrupted test"},
                         {"crackle test --keys", "all keys of a case, with units, defaults and ranges"},
                         {"crackle test --files", "all columns, keys and arrays of the files in OUT"}}};
}

int test(const Invocation& given) {
    TestOptions options;  // created first, since it records the time at which the command began
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
            resume ? "crackle test: found CASE.toml and --resume, expected only one of the two; a resumed test has its "
                     "case in OUT"
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
    end_unheard(nothing_written);
    options.loading_begins = [] { end_unheard(nullptr); };
    const TestHooks hooks = hooks_for(given.messages);
    TestOutcome outcome;
    if (resume) {
        limit_threads(options, threads_to_resume(options));
        outcome = resume_test(options, hooks);
    } else {
        ResolvedCase description = read_case(given_or_shipped(given.operands.front()));
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
