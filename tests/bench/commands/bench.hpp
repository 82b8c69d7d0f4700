// SPDX-License-Identifier: GPL-3.0-or-later
// The studies of `crackle-bench`, one per file. The table in bench.cpp has a line for each study.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <vector>

#include "tools/command_line/program.hpp"

namespace crackle::tools {

const std::vector<Command>& bench_studies();

CommandLine describe_bench_accuracy();
int bench_accuracy(const Invocation& given);
CommandLine describe_bench_features();
int bench_features(const Invocation& given);
CommandLine describe_bench_guide();
int bench_guide(const Invocation& given);
CommandLine describe_bench_stress();
int bench_stress(const Invocation& given);
CommandLine describe_bench_throughput();
int bench_throughput(const Invocation& given);
CommandLine describe_bench_verify();
int bench_verify(const Invocation& given);

}  // namespace crackle::tools
