// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle run DIR`: runs a DEMseg deck.

#include <fmt/format.h>

#include <string>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_run.hpp"
#include "solver/files/output_path.hpp"
#include "tools/command_line/command_line.hpp"
#include "tools/commands/commands.hpp"
#include "tools/terminal/interrupt.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/shipped.hpp"
#include "tools/terminal/threads.hpp"

namespace crackle::tools {
namespace {

DeckOptions deck_options(const Invocation& given) {
    const po::variables_map& values = given.values;
    DeckOptions options;
    options.folder = given_or_shipped(given.operands.front());
    if (values.contains("output")) options.output = output_folder(values["output"].as<std::string>());
    options.goes_on = values.contains("continue");
    options.overwrite = values.contains("force");
    if (options.overwrite && options.goes_on && options.output.empty())
        throw without_effect("crackle run", "--force", "--continue without -o");
    if (values.contains("steps")) options.steps = values["steps"].as<std::int64_t>();
    if (values.contains("seed")) options.seed = values["seed"].as<std::uint64_t>();
    if (values.contains("law")) options.law = value_named<SegmentLaw>("--law", values["law"].as<std::string>());
    if (values.contains("integrator"))
        options.integrator = value_named<Integrator>("--integrator", values["integrator"].as<std::string>());
    options.allow_unstable = values.contains("allow-unstable");
    options.threads = threads_of_machine(values["threads"].as<int>(), given.messages);
    return options;
}

/// Prints the details of a finished run that -v shows.
void report_details(Messages& messages, const World& world) {
    messages.detail(fmt::format("{} contact points, {} of them bonded; {} threads", world.points.size(),
                                world.bonds.initial - world.bonds.broken, world.workers.threads));
}

}  // namespace

CommandLine describe_run() {
    po::options_description options;
    options.add_options()("output,o", po::value<std::string>()->value_name("DIR"),
                          "folder for the outputs (default: the folder of the deck)")                         //
        ("continue", "resume from new_in_*.dat of DIR; without -o the outputs are appended to those in DIR")  //
        ("steps", po::value<std::int64_t>()->value_name("N"),
         "number of steps, instead of the deck's nstep; prescribed displacements are still spread over nstep steps")  //
        ("force", "replace the outputs of an earlier run")                                                            //
        ("seed", po::value<std::uint64_t>()->value_name("N"), "seed of the random circles of mode 0 (default: 1)")    //
        ("law", po::value<std::string>()->value_name("LAW"),
         "contact law of segments: rounded; demseg, the law of DEMseg's guide, which adds the overlaps of a pair's "
         "discs; or demseg_mean, which takes their mean; default: rounded, or for a continued run its earlier law")  //
        ("integrator", po::value<std::string>()->value_name("NAME"),
         "treatment of contacts that open and close: leapfrog, as in DEMseg's guide, or consistent, which conserves "
         "energy; default: leapfrog, or for a continued run its earlier choice")                                 //
        ("allow-unstable", "accept a time step above the stability limit, and energy that grows without bound")  //
        ("threads", po::value<int>()->value_name("N")->default_value(1),
         "number of threads; does not affect the results");
    return {.synopses = {"crackle run DIR [OPTIONS]"},
            .description =
                "Runs the DEMseg deck in DIR: in_gm.dat and in_bc.dat, with in_cf.dat (jclid 1) or in_cf0.dat (jclid "
                "3). Writes output.dat, cont.dat, cont2.dat, energy.dat, f-d_curve.dat, velocity_y.dat, bonds.dat and "
                "events.csv (a row per broken bond). Also writes new_in_gm.dat, new_in_bc.dat, new_in_cf.dat, "
                "new_in_cf0.dat and new_state.bin, from which the run can be continued.",
            .options = {{"options", options}},
            .operand = "DIR",
            .choices = {{"law", names_of<SegmentLaw>()}, {"integrator", names_of<Integrator>()}},
            .verbose = "numbers of bodies and contacts, and the time step with its stability limit",
            .examples = {
                {"crackle run specimens/demseg/circle -o out/circle", "the bouncing circle of DEMseg's guide"},
                {"crackle run specimens/demseg/circle -o out/half --steps 10000", "the first half of its steps"},
                {"crackle run specimens/demseg/triangle -o out/t --law demseg",
                 "a polygon with the contact law of DEMseg's guide"},
                {"crackle run out/half --continue", "runs the remaining steps and appends their outputs"},
                {"crackle run out/half --continue --steps 5000 -o out/more", "5000 more steps with separate outputs"}}};
}

int run_deck(const Invocation& given) {
    if (given.operands.empty())
        throw InputError(
            "crackle run: argument DIR is missing, expected the folder of a deck (see crackle run --help)");
    DeckRun deck(deck_options(given));
    Messages& messages = given.messages;
    for (const std::string& notice : deck.notices()) messages.notice(notice);
    const World& world = deck.world();
    if (messages.verbose()) {
        messages.detail(fmt::format("read {} bodies", world.bodies.size()));
        messages.detail(fmt::format("time step {:.6g}, stable below {:.6g} with the present contacts",
                                    world.stepping.time_step, world.stepping.step_bound));
    }
    watch_interrupts();
    messages.progress().begin("", static_cast<double>(deck.last_step() - deck.first_step()), "steps");
    deck.run([&](const World& now) {
        // Progress is updated only every 16th step, because reading the clock takes as long as a step of a small deck.
        if ((now.stepping.steps & 15) == 0)
            messages.progress().count(static_cast<double>(now.stepping.steps - deck.first_step()));
        return !interrupted();
    });
    messages.make_room();
    report_details(messages, world);
    if (!messages.quiet()) {
        print_out("{} bodies, steps {} to {}: outputs in {}\n", world.bodies.size(), deck.first_step(),
                  world.stepping.steps, deck.output_folder().string());
    }
    if (!interrupted()) return exit_done;
    report_error(fmt::format("interrupted; resume with `crackle run {} --continue`", deck.output_folder().string()));
    return exit_interrupted;
}

}  // namespace crackle::tools
