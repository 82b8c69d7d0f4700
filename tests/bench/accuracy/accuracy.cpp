// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/accuracy/accuracy.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <iterator>

namespace crackle::accuracy {
namespace {

// Time in s above which a run is timed only once; the times of such runs scatter by only a few per cent.
constexpr double long_enough = 0.5;

}  // namespace

const std::vector<AccuracyStudy>& accuracy_studies() {
    static const std::vector<AccuracyStudy> all = [] {
        std::vector<AccuracyStudy> list = collision_studies();
        std::vector<AccuracyStudy> more = specimen_studies();
        std::move(more.begin(), more.end(), std::back_inserter(list));
        return list;
    }();
    return all;
}

double median_cpu_seconds(const std::function<void()>& work) {
    std::array<double, 3> seconds{};
    for (double& s : seconds) {
        // Processor time of this process, so that other programs on the machine do not count.
        timespec begin{}, end{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
        work();
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
        s = static_cast<double>(end.tv_sec - begin.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec);
        if (s > long_enough) return s;
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[1];
}

}  // namespace crackle::accuracy
