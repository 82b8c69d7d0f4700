// SPDX-License-Identifier: GPL-3.0-or-later
// The ensemble of the guide's rock as a page and as CSV. No date, version or time in them, but run times are measured.
// Tested by tests/bench_tests/guide/ensemble_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/guide/ensemble.hpp"

namespace crackle::studies {

struct GuidePage {
    std::string command;            ///< that makes it, named in its header
    std::vector<std::string> laws;  ///< columns; runs of experiments are of the first
    std::int64_t packings = 0;      ///< seeds 1 to this
    double rate_factor = 1.0;
    std::size_t tests_missing = 0;  ///< planned and not run yet
};

/// The table with verdicts, then each row outside with the experiments tried on it. Markdown.
std::string guide_page(const GuidePage& page, const GuideResults& results);

/// A line a packing, experiment, law and quantity: the page's rows by key, and what the tests measured as
/// specimen.loading.quantity.
std::string guide_csv(const GuidePage& page, const GuideResults& results);

}  // namespace crackle::studies
