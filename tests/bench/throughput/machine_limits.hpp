// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of the machine, measured in the same run as the speeds that are compared with them.
// Tested by tests/bench_tests/commands/bench_test.cpp.
#pragma once

#include <cstddef>
#include <string>

namespace crackle::throughput {

/// Bandwidth of a[k] = b[k] + s·c[k] with three arrays of `bytes` in total, GB/s, counting 24 bytes per element. The
/// best of several rounds that take at least `seconds` in total.
double triad_bandwidth(std::size_t bytes, double seconds);

/// Largest resident set since reset_peak_memory(), bytes; 0 where the system does not report it.
std::size_t peak_memory();
/// Resets the peak after returning freed memory to the system. Requires Linux's /proc.
void reset_peak_memory();

/// Model of the processor as reported by the system, or "unknown".
std::string processor_name();

}  // namespace crackle::throughput
