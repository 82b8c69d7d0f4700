// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle run DIR`: runs a DEMseg deck.

#include <fmt/format.h>

#include <iostream>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_run.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

DeckOptions deck_options(const Invocation& given) {
    const po::variables_map& values = given.values;
    DeckOptions options;
    options.folder = given_or_shipped(given.operands.front());
    if (values.contains("output")) options.output = values["output"].as<std::string>();
    options.goes_on = values.contains("continue");
    options.overwrite = values.contains("force");
    if (options.overwrite && options.goes_on && options.output.empty())
        throw without_effect("crackle run", "--force", "--continue without -o");
    if (values.contains("steps")) options.steps = values["steps"].as<std::int64_t>();
    if (values.contains("seed")) options.seed = values["seed"].as<std::uint64_t>();
    if (values.contains("law")) options.law = segment_law_named("--law", values["law"].as<std::string>());
    if (values.contains("integrator"))
        options.integrator = integrator_named("--integrator", values["integrator"].as<std::string>());
    options.allow_unstable = values.contains("allow-unstable");
    options.threads = threads_of_machine(values["threads"].as<int>(), given.messages);
    return options;
}

/// What -v reports of a run that has ended.
void report_details(Messages& messages, const World& world) {
    messages.detail(fmt::format("{} contact points, {} of them bonded; {} threads", world.points.size(),
                                world.bonds.initial - world.bonds.broken, world.workers.threads));
}

}  // namespace

CommandLine describe_run() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"),
                          "folder for the outputs (default: that of the deck)")                              //
        ("continue", "go on from new_in_*.dat of DIR; without -o the outputs are appended to those in DIR")  //
        ("steps", po::value<std::int64_t>()->value_name("N"),
         "do so many steps instead of nstep; displacements still take nstep")                                  //
        ("force", "replace the outputs of an earlier run")                                                     //
        ("seed", po::value<std::uint64_t>()->value_name("N"), "of the random circles of mode 0 (default: 1)")  //
        ("law", po::value<std::string>()->value_name("LAW"),
         "contact law of segments: rounded, or the guide's demseg (demseg_mean: mean of its disc cases); default: "
         "rounded, or that of the run before, which new_state.bin keeps")  //
        ("integrator", po::value<std::string>()->value_name("NAME"),
         "how contacts open and close: leapfrog, the guide's, or consistent with the energy; default: leapfrog, or "
         "that of the run before, likewise")                                                 //
        ("allow-unstable", "accept a time step above the stable bound, and runaway energy")  //
        ("threads", po::value<int>()->value_name("N")->default_value(1), "threads; the results do not depend on them");
    return {.synopses = {"crackle run DIR [OPTIONS]"},
            .description =
                "Runs the DEMseg deck in DIR (in_gm.dat, in_bc.dat; in_cf.dat with jclid 1, in_cf0.dat with jclid 3) "
                "and writes output.dat, cont.dat, cont2.dat, energy.dat, f-d_curve.dat, velocity_y.dat, bonds.dat, "
                "events.csv (a row a broken bond), and "
                "new_in_gm.dat, new_in_bc.dat, new_in_cf.dat, new_in_cf0.dat and new_state.bin, with which the run "
                "can be continued.",
            .options = {{"options", options}},
            .operand = "DIR",
            .choices = {{"law", {"rounded", "demseg", "demseg_mean"}}, {"integrator", {"leapfrog", "consistent"}}},
            .verbose = "bodies, time step and its bound, contacts",
            .examples = {
                {"crackle run specimens/demseg/circle -o out/circle", "the guide's bouncing circle"},
                {"crackle run specimens/demseg/circle -o out/half --steps 10000", "half of it"},
                {"crackle run specimens/demseg/triangle -o out/t --law demseg",
                 "a polygon under the guide's own contact law"},
                {"crackle run out/half --continue", "the rest, outputs appended"},
                {"crackle run out/half --continue --steps 5000 -o out/more", "5000 steps more, outputs of their own"}}};
}

int run_deck(const Invocation& given) {
    if (given.operands.empty())
        throw InputError("crackle run: found no DIR, expected the folder of a deck (see crackle run --help)");
    DeckRun deck(deck_options(given));
    Messages& messages = given.messages;
    for (const std::string& notice : deck.notices()) messages.notice(notice);
    const World& world = deck.world();
    if (messages.verbose()) {
        messages.detail(fmt::format("read {} bodies", world.bodies.size()));
        messages.detail(fmt::format("time step {:.6g}, stable below {:.6g} as the contacts are",
                                    world.stepping.time_step, world.stepping.step_bound));
    }
    watch_interrupts();
    messages.progress().begin("", static_cast<double>(deck.last_step() - deck.first_step()), "steps");
    deck.run([&](const World& now) {
        // The clock costs as much as a small step.
        if ((now.stepping.steps & 15) == 0)
            messages.progress().count(static_cast<double>(now.stepping.steps - deck.first_step()));
        return !interrupted();
    });
    messages.make_room();
    report_details(messages, world);
    if (!messages.quiet()) {
        std::cout << fmt::format("{} bodies, steps {} to {}: outputs in {}\n", world.bodies.size(), deck.first_step(),
                                 world.stepping.steps, deck.output_folder().string());
    }
    if (!interrupted()) return exit_done;
    report_error(fmt::format("interrupted; go on with `crackle run {} --continue`", deck.output_folder().string()));
    return exit_interrupted;
}

}  // namespace crackle::tools
