// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/commands/bench.hpp"

namespace crackle::tools {

const std::vector<Command>& bench_studies() {
    static const std::vector<Command> all{
        {"accuracy", "error against processor time: contact laws, integrators, time steps, rates",
         describe_bench_accuracy, bench_accuracy},
        {"features", "cost of each feature per contact and step, and of absent features", describe_bench_features,
         bench_features},
        {"guide", "the rock of DEMseg's guide on many packings: its numbers compared with ours", describe_bench_guide,
         bench_guide},
        {"stress", "difficult scenes, for a million steps", describe_bench_stress, bench_stress},
        {"throughput", "particle-steps per second compared with the limits of the machine", describe_bench_throughput,
         bench_throughput},
        {"verify", "comparison of the engine with closed forms and laws", describe_bench_verify, bench_verify},
    };
    return all;
}

}  // namespace crackle::tools
