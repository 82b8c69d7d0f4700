// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle-bench stress`: runs the scenes of the claims «Stability under stress» for any number of steps.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <iostream>

#include "solver/base/errors.hpp"
#include "tests/bench/commands/bench.hpp"
#include "tests/bench/verify/assembly/stress.hpp"
#include "tools/command_line/command_line.hpp"

namespace crackle::tools {
namespace {

using verification::Endured;
using verification::StressScene;

}  // namespace

CommandLine describe_bench_stress() {
    po::options_description options;
    options.add_options()("steps", po::value<std::int64_t>()->value_name("N")->default_value(1000000),
                          "steps of each scene");
    return {.synopses = {"crackle-bench stress [OPTIONS]"},
            .description = "Runs difficult scenes and reports the closing error of each energy balance.",
            .options = {{"options", options}},
            .verbose = "time step and its bound for each scene",
            .examples = {{"crackle-bench stress"}, {"crackle-bench stress --steps 10000"}},
            .notes = {"exit codes: 0 the energy balance of every scene closes, 1 one does not, or a scene became "
                      "unstable, 2 bad input"}};
}

int bench_stress(const Invocation& given) {
    Messages& messages = given.messages;
    const auto steps = given.values["steps"].as<std::int64_t>();
    if (steps < 1) throw InputError(fmt::format("crackle-bench stress: --steps: found {}, expected at least 1", steps));
    fmt::print(
        "| scene | bodies | steps | closing error [-] | wall time [s] | verdict |\n"
        "| --- | ---: | ---: | ---: | ---: | --- |\n");
    std::fflush(stdout);
    bool fails = false;
    messages.progress().begin("", static_cast<double>(verification::stress_scenes().size()), "scenes");
    double done = 0.0;
    for (const StressScene& scene : verification::stress_scenes()) {
        const auto start = std::chrono::steady_clock::now();
        World world = scene.build();
        messages.detail(fmt::format("{}: time step {:.3g} s, bound {:.3g} s", scene.name, world.stepping.time_step,
                                    world.stepping.step_bound));
        messages.progress().step(done++, fmt::format("{}, {} bodies", scene.name, world.bodies.size()));
        const Endured endured = verification::endure(world, steps);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const bool holds = endured.error.empty() && endured.closing_error <= verification::open_account;
        fails = fails || !holds;
        messages.make_room();
        fmt::print("| {} | {} | {} | {:.2g} | {:.1f} | {} |\n", scene.name, world.bodies.size(), endured.steps,
                   endured.closing_error, seconds, holds ? "holds" : "FAILS " + endured.error);
        std::fflush(stdout);  // a scene may take minutes
    }
    return fails ? exit_claim_fails : exit_done;
}

}  // namespace crackle::tools
