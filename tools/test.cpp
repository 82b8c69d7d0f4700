// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle test CASE.toml -o OUT`: one virtual test.

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <boost/program_options.hpp>
#include <csignal>
#include <iostream>
#include <string>

#include "solver/errors.hpp"
#include "specimens/observers/profile_report.hpp"
#include "specimens/virtual_test.hpp"
#include "tools/commands.hpp"

namespace crackle::tools {
namespace {

namespace po = boost::program_options;

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void ask_test_to_stop(int) { stop_asked = true; }

constexpr const char* test_usage =
    "usage: crackle test CASE.toml -o OUT [OPTIONS]\n"
    "       crackle test --resume OUT [OPTIONS]\n\n"
    "Makes the specimen that CASE.toml describes, bonds it with its platens, loads it until it fails, and writes into "
    "OUT:\n"
    "curve.csv, events.csv, summary.json, frames/ (ParaView), checkpoint, and case.toml with every value in the "
    "open.\n\n";

constexpr const char* test_examples =
    "\nexamples:\n"
    "  crackle test specimens/guide_rock/circles_tension.toml -o out/circles-tension\n"
    "  crackle test case.toml -o out/case --threads 2 -q\n"
    "  crackle test case.toml -o out/case --verify\n"
    "  crackle test case.toml -o out/case --profile\n"
    "  crackle test --resume out/case           goes on after an interrupt, to the bytes of an uninterrupted test\n"
    "  crackle test --keys                      all keys of a case, with units, defaults and ranges\n";

po::options_description test_options() {
    po::options_description options("options");
    options.add_options()("help,h", "this text")                                                                 //
        ("output,o", po::value<std::string>(), "folder for the results")                                         //
        ("force", "replace the results in OUT once the new ones are complete")                                   //
        ("resume", po::value<std::string>(), "go on with the test in this folder from its last checkpoint")      //
        ("verify", "run the test's companions too (half step, half rate, half and double damping): error bars")  //
        ("profile", "time the phases of a step: a table, and `profile` in summary.json")                         //
        ("threads", po::value<int>(), "threads (default: the case's); results do not depend on them")            //
        ("allow-unstable", "accept a time step above the stable bound, and runaway energy")                      //
        ("keys", "list all keys of a case")                                                                      //
        ("quiet,q", "no progress, no notices, no figures");
    return options;
}

/// One line that is written over, on a terminal only.
class ProgressLine {
  public:
    explicit ProgressLine(bool wanted) : shown_(wanted && isatty(STDERR_FILENO) != 0) {}
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    bool shown() const { return shown_; }
    void show(const TestProgress& p) const {
        std::cerr << fmt::format(
                         "\r\x1b[K{:5.1f} %  strain {:.3e}  stress {:.3e} N/m (peak {:.3e})  {} bonds broken  {:.3g} "
                         "steps/s  at "
                         "most {:.0f} s left",
                         100.0 * p.share_done, p.axial_strain, p.axial_stress, p.peak_stress, p.bonds_broken,
                         p.steps_per_second, p.seconds_left)
                  << std::flush;
    }
    void clear() const {
        if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    }

  private:
    bool shown_;
};

std::string shown(const nlohmann::ordered_json& summary, const std::string& key) {
    const auto value = summary.find(key);
    if (value == summary.end() || value->is_null()) return "-";
    return value->is_number() ? fmt::format("{:.4g}", value->get<double>()) : value->dump();
}

void print_figures(const TestOutcome& outcome) {
    const auto& s = outcome.summary;
    const bool failed = s.value("failed", false);
    const std::string so_far = failed ? "" : "_so_far";
    std::cout << fmt::format("{}, {}: {}\n", s.value("specimen", ""), s.value("kind", ""),
                             failed ? "failed" : "has not failed (ended by " + s.value("ended_by", "nothing") + ")");
    std::cout << fmt::format("  {} {} N/m at strain {}\n", failed ? "strength" : "largest stress so far",
                             shown(s, "peak_stress" + so_far), shown(s, "peak_strain" + so_far));
    std::cout << fmt::format("  modulus: small strain {} N/m, initial tangent {} N/m, at half the peak {} N/m\n",
                             shown(s, "youngs_modulus"), shown(s, "initial_tangent_modulus"),
                             shown(s, "tangent_modulus_50"));
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

TestHooks hooks_for(const ProgressLine& line, bool quiet) {
    TestHooks hooks;
    hooks.interrupted = [] { return stop_asked.load(); };
    if (!quiet) hooks.stage = [](const std::string& text) { std::cerr << text << '\n'; };
    if (line.shown()) hooks.progress = [&line](const TestProgress& p) { line.show(p); };
    return hooks;
}

int finish(const TestOutcome& outcome, const std::string& wanted, bool quiet) {
    if (outcome.was_finished) {
        if (!quiet) std::cout << outcome.folder.string() << ": the test is finished, nothing is left to do\n";
        return exit_done;
    }
    if (!quiet) print_figures(outcome);
    if (outcome.unverified) {
        std::cerr << fmt::format(
            "crackle: the test is complete, its companions were interrupted and no error is stated; `crackle test "
            "--resume {} --verify` runs them again\n",
            outcome.folder.string());
        return exit_interrupted;
    }
    if (!outcome.interrupted) return exit_done;
    if (outcome.folder != std::filesystem::path(wanted) && !quiet) {
        std::cerr << fmt::format("crackle: earlier results in {} are as they were\n", wanted);
    }
    std::cerr << fmt::format("crackle: interrupted; go on with `crackle test --resume {}`\n", outcome.folder.string());
    return exit_interrupted;
}

}  // namespace

int test(const Arguments& arguments) {
    TestOptions options;  // takes the time
    po::options_description all = test_options();
    all.add_options()("case", po::value<std::string>(), "");
    po::positional_options_description positional;
    positional.add("case", 1);
    po::variables_map values;
    po::store(po::command_line_parser(arguments).options(all).positional(positional).run(), values);
    po::notify(values);
    if (values.contains("help")) {
        std::cout << test_usage << test_options() << test_examples;
        return exit_done;
    }
    if (values.contains("keys")) {
        describe_case_keys(std::cout);
        return exit_done;
    }
    const bool resume = values.contains("resume");
    if (resume == values.contains("case")) {
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
    for (const std::string& word : arguments) options.command += ' ' + word;
    const bool quiet = values.contains("quiet");
    std::signal(SIGINT, ask_test_to_stop);
    std::signal(SIGTERM, ask_test_to_stop);

    const ProgressLine line(!quiet);
    const TestHooks hooks = hooks_for(line, quiet);
    TestOutcome outcome;
    if (resume) {
        outcome = resume_test(options, hooks);
    } else {
        TestCase description = read_case(values["case"].as<std::string>());
        if (values.contains("allow-unstable")) description.numerics.allow_unstable = true;
        try {
            outcome = run_test(description, options, hooks);
        } catch (const TestInterrupted& stop) {
            line.clear();
            std::cerr << "crackle: " << stop.what() << '\n';
            return exit_interrupted;
        }
    }
    line.clear();
    return finish(outcome, options.folder.string(), quiet);
}

}  // namespace crackle::tools
