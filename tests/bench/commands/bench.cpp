// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/commands/bench.hpp"

namespace crackle::tools {

const std::vector<Command>& bench_studies() {
    static const std::vector<Command> all{
        {"accuracy", "what an error costs in processor time: contact laws, integrators, time steps, rates",
         describe_bench_accuracy, bench_accuracy},
        {"features", "what each feature costs a contact and step, and what is left of absent ones",
         describe_bench_features, bench_features},
        {"guide", "the rock of DEMseg's guide on many packings: each of its numbers beside ours", describe_bench_guide,
         bench_guide},
        {"stress", "scenes that are hard on the engine, for a million steps", describe_bench_stress, bench_stress},
        {"throughput", "particle-steps a second beside what the machine can do", describe_bench_throughput,
         bench_throughput},
        {"verify", "every closed form and law that the engine has to meet, against what it does", describe_bench_verify,
         bench_verify},
    };
    return all;
}

}  // namespace crackle::tools
