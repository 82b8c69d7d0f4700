// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle run DIR`: runs a DEMseg deck.

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <boost/program_options.hpp>
#include <chrono>
#include <csignal>
#include <iostream>
#include <string>

#include "solver/demseg/deck_run.hpp"
#include "solver/errors.hpp"
#include "tools/commands.hpp"

namespace crackle::tools {
namespace {

namespace po = boost::program_options;

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void note_interrupt(int) { interrupted = true; }

constexpr const char* run_usage =
    "usage: crackle run DIR [OPTIONS]\n\n"
    "Runs the DEMseg deck in DIR (in_gm.dat, in_bc.dat; in_cf.dat with jclid 1, in_cf0.dat with jclid 3) and writes\n"
    "output.dat, cont.dat, cont2.dat, energy.dat, f-d_curve.dat, velocity_y.dat, and new_in_gm.dat, new_in_bc.dat,\n"
    "new_in_cf.dat, new_in_cf0.dat and new_state.bin, with which the run can be continued.\n\n";

constexpr const char* run_examples =
    "\nexamples:\n"
    "  crackle run specimens/demseg/circle -o out/circle                the guide's bouncing circle\n"
    "  crackle run specimens/demseg/circle -o out/half --steps 10000    half of it\n"
    "  crackle run specimens/demseg/triangle -o out/t --law demseg      a polygon under the guide's own contact law\n"
    "  crackle run out/half --continue                                  the rest, outputs appended\n"
    "  crackle run out/half --continue --steps 5000 -o out/more         5000 steps more, outputs of their own\n";

/// One line that is written over, a few times a second, on a terminal only.
class ProgressLine {
  public:
    ProgressLine(bool shown, std::int64_t first, std::int64_t last)
        : shown_(shown && isatty(STDERR_FILENO) != 0),
          first_(first),
          last_(last),
          start_(Clock::now()),
          drawn_(start_) {}
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() {
        if (shown_) std::cerr << "\r\x1b[K";
    }

    void show(std::int64_t step) {
        if (!shown_ || (step & 15) != 0) return;  // the clock costs as much as a small step
        const auto now = Clock::now();
        if (now - drawn_ < std::chrono::milliseconds(200)) return;
        drawn_ = now;
        const double seconds = std::chrono::duration<double>(now - start_).count();
        const double rate = static_cast<double>(step - first_) / seconds;
        std::cerr << fmt::format("\r\x1b[Kstep {} of {}, {:.3g} steps/s, {:.0f} s left", step, last_, rate,
                                 static_cast<double>(last_ - step) / std::max(rate, 1e-300))
                  << std::flush;
    }

  private:
    using Clock = std::chrono::steady_clock;
    bool shown_;
    std::int64_t first_, last_;
    Clock::time_point start_, drawn_;
};

po::options_description run_options() {
    po::options_description options("options");
    options.add_options()("help,h", "this text")                                                                   //
        ("output,o", po::value<std::string>(), "folder for the outputs (default: DIR)")                            //
        ("continue", "go on from new_in_*.dat of DIR; without -o the outputs are appended to those in DIR")        //
        ("steps", po::value<std::int64_t>(), "do so many steps instead of nstep; displacements still take nstep")  //
        ("force", "replace the outputs of an earlier run")                                                         //
        ("seed", po::value<std::uint64_t>(), "of the random circles of mode 0 (default: 1)")                       //
        ("law", po::value<std::string>(),
         "contact law of segments: rounded, or the guide's demseg (demseg_mean: mean of its disc cases); default: "
         "rounded, or that of the run that goes on")  //
        ("integrator", po::value<std::string>(),
         "how contacts open and close: leapfrog, the guide's, or consistent with the energy; default: leapfrog, or "
         "that of the run that goes on")                                                               //
        ("allow-unstable", "accept a time step above the stable bound, and runaway energy")            //
        ("threads", po::value<int>()->default_value(1), "threads; the results do not depend on them")  //
        ("quiet,q", "no progress, no notices");
    return options;
}

DeckOptions deck_options(const po::variables_map& values) {
    DeckOptions options;
    options.folder = values["dir"].as<std::string>();
    if (values.contains("output")) options.output = values["output"].as<std::string>();
    options.goes_on = values.contains("continue");
    options.overwrite = values.contains("force");
    if (values.contains("steps")) options.steps = values["steps"].as<std::int64_t>();
    if (values.contains("seed")) options.seed = values["seed"].as<std::uint64_t>();
    if (values.contains("law")) options.law = segment_law_named("--law", values["law"].as<std::string>());
    if (values.contains("integrator"))
        options.integrator = integrator_named("--integrator", values["integrator"].as<std::string>());
    options.allow_unstable = values.contains("allow-unstable");
    options.threads = values["threads"].as<int>();
    return options;
}

}  // namespace

int run_deck(const Arguments& arguments) {
    po::options_description all = run_options();
    all.add_options()("dir", po::value<std::string>(), "");
    po::positional_options_description positional;
    positional.add("dir", 1);
    po::variables_map values;
    po::store(po::command_line_parser(arguments).options(all).positional(positional).run(), values);
    po::notify(values);
    if (values.contains("help")) {
        std::cout << run_usage << run_options() << run_examples;
        return exit_done;
    }
    if (!values.contains("dir"))
        throw InputError("crackle run: found no DIR, expected the folder of a deck (see crackle run --help)");

    const bool quiet = values.contains("quiet");
    DeckRun deck(deck_options(values));
    if (!quiet) {
        for (const std::string& notice : deck.notices()) std::cerr << "crackle: " << notice << '\n';
    }
    std::signal(SIGINT, note_interrupt);
    std::signal(SIGTERM, note_interrupt);
    {
        ProgressLine progress(!quiet, deck.first_step(), deck.last_step());
        deck.run([&](const World& world) {
            progress.show(world.step);
            return !interrupted;
        });
    }
    const World& world = deck.world();
    if (!quiet) {
        std::cout << fmt::format("{} bodies, steps {} to {}: outputs in {}\n", world.bodies.size(), deck.first_step(),
                                 world.step, deck.output_folder().string());
    }
    if (!interrupted) return exit_done;
    std::cerr << fmt::format("crackle: interrupted; go on with `crackle run {} --continue`\n",
                             deck.output_folder().string());
    return exit_interrupted;
}

}  // namespace crackle::tools
