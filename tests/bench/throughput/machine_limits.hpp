// SPDX-License-Identifier: GPL-3.0-or-later
// What the machine can do, measured in the run whose rates are compared with it.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <cstddef>
#include <string>

namespace crackle::throughput {

/// a[k] = b[k] + s·c[k] over three arrays of `bytes` together, GB/s of 24 bytes an element; best of a few rounds of at
/// least `seconds` together.
double triad_bandwidth(std::size_t bytes, double seconds);

/// Largest resident set since reset_peak_memory(), bytes; 0 where the system does not report it.
std::size_t peak_memory();
/// Gives freed memory back first. Needs Linux's /proc.
void reset_peak_memory();

/// Model of the processor as the system names it, or "unknown".
std::string processor_name();

}  // namespace crackle::throughput
