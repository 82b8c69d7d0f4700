// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <cstddef>

#include "solver/base/instruction_set.hpp"

namespace crackle::throughput {

/// Computes a[k] = b[k] + s·c[k], compiled for an instruction set.
using Triad = void (*)(double* a, const double* b, const double* c, double s, std::size_t count);
template <InstructionSet>
void triad_of(double* a, const double* b, const double* c, double s, std::size_t count);

}  // namespace crackle::throughput
