// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/machine_limits.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "solver/base/chosen_set.hpp"
#include "tests/bench/throughput/triad.hpp"

namespace crackle::throughput {
namespace {

using Clock = std::chrono::steady_clock;

/// Value of a key in /proc/self/status, bytes.
std::size_t status_bytes(const std::string& key) {
    std::ifstream in("/proc/self/status");
    for (std::string word; in >> word;) {
        std::size_t kilobytes = 0;
        if (word == key && in >> kilobytes) return 1024 * kilobytes;
    }
    return 0;
}

}  // namespace

double triad_bandwidth(std::size_t bytes, double seconds) {
    const std::size_t count = bytes / (3 * sizeof(double));
    std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
    const std::size_t repeats = std::max<std::size_t>(1, (std::size_t{1} << 22) / std::max<std::size_t>(1, count));
    const Triad triad = of_chosen_set([]<InstructionSet S>() { return &triad_of<S>; });
    double best = 0.0;
    const Clock::time_point start = Clock::now();
    do {
        const Clock::time_point begun = Clock::now();
        for (std::size_t r = 0; r < repeats; ++r) triad(a.data(), b.data(), c.data(), 3.0, count);
        const double took = std::chrono::duration<double>(Clock::now() - begun).count();
        best = std::max(best, 24e-9 * static_cast<double>(count * repeats) / took);
    } while (std::chrono::duration<double>(Clock::now() - start).count() < seconds);
    return best;
}

std::size_t peak_memory() { return status_bytes("VmHWM:"); }

void reset_peak_memory() {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
}

std::string processor_name() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

}  // namespace crackle::throughput
