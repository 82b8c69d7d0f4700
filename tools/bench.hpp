// SPDX-License-Identifier: GPL-3.0-or-later
// The studies of `crackle bench`, one file each; a study is a line in the table of bench.cpp.
#pragma once

#include "tools/commands.hpp"

namespace crackle::tools {

int bench_accuracy(const Arguments& arguments);
int bench_features(const Arguments& arguments);
int bench_guide(const Arguments& arguments);
int bench_verify(const Arguments& arguments);
int bench_stress(const Arguments& arguments);
int bench_throughput(const Arguments& arguments);

}  // namespace crackle::tools
