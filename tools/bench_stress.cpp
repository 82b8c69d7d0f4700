// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle bench stress`: the scenes of the claims «Stability under stress», for as long as wanted.

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "solver/errors.hpp"
#include "specimens/verification/stress.hpp"
#include "tools/bench.hpp"

namespace crackle::tools {
namespace {

namespace po = boost::program_options;
using verification::Endured;
using verification::StressScene;

constexpr const char* stress_examples = R"(
examples:
  crackle bench stress
  crackle bench stress --steps 10000

exit codes: 0 every scene kept its account of energy, 1 one did not or became unstable, 2 bad input
)";

}  // namespace

int bench_stress(const Arguments& arguments) {
    po::options_description options("options");
    options.add_options()("help,h", "show this")("steps", po::value<std::int64_t>()->default_value(1000000),
                                                 "steps of each scene");
    po::variables_map given;
    po::store(po::command_line_parser(arguments).options(options).positional({}).run(), given);
    po::notify(given);
    if (given.contains("help")) {
        std::cout
            << "usage: crackle bench stress [OPTIONS]\n\nRuns scenes that are hard on the engine and shows by how "
               "much of the energy each account stays open.\n\n"
            << options << stress_examples;
        return exit_done;
    }
    const auto steps = given["steps"].as<std::int64_t>();
    if (steps < 1) throw InputError(fmt::format("bench stress: --steps: found {}, expected at least 1", steps));
    fmt::print(
        "| scene | bodies | steps | account left open [-] | wall time [s] | verdict |\n"
        "| --- | ---: | ---: | ---: | ---: | --- |\n");
    bool fails = false;
    for (const StressScene& scene : verification::stress_scenes()) {
        const auto start = std::chrono::steady_clock::now();
        World world = scene.build();
        const Endured endured = verification::endure(world, steps);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const bool holds = endured.error.empty() && endured.closing_error <= verification::open_account;
        fails = fails || !holds;
        fmt::print("| {} | {} | {} | {:.2g} | {:.1f} | {} |\n", scene.name, world.bodies.size(), endured.steps,
                   endured.closing_error, seconds, holds ? "holds" : "FAILS " + endured.error);
        std::fflush(stdout);  // a scene may take minutes
    }
    return fails ? exit_claim_fails : exit_done;
}

}  // namespace crackle::tools
