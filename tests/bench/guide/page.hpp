// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the results for the guide's rock as a page and as CSV. They contain measured processor times, but no date,
// version or wall-clock time.
// Tested by tests/bench_tests/guide/ensemble_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/bench/guide/ensemble.hpp"

namespace crackle::studies {

struct GuidePage {
    std::string command;            ///< command that writes the page, printed in its header
    std::vector<std::string> laws;  ///< one column per law; experiments use the first law
    std::int64_t packings = 0;      ///< the seeds are 1 to this number
    double rate_factor = 1.0;
    std::size_t tests_missing = 0;  ///< number of planned tests not run yet
};

/// The page in Markdown: the table with verdicts, then each row outside the limits with its experiments.
std::string guide_page(const GuidePage& page, const GuideResults& results);

/// CSV with one line per packing, experiment, law and quantity. Quantities are the page's rows, by key, and the tests'
/// own results, as specimen.loading.quantity.
std::string guide_csv(const GuidePage& page, const GuideResults& results);

}  // namespace crackle::studies
