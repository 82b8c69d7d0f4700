// SPDX-License-Identifier: GPL-3.0-or-later
// Writes claims and results as a Markdown page. It contains no date, version or time, so the same numbers give the same
// bytes.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/verify/claim.hpp"

namespace crackle::verification {

struct CheckedClaim {
    Claim claim;
    std::vector<ClaimRow> rows;

    bool fails() const;
    /// Largest ratio of error to tolerance; NaN if no row has a tolerance above 0.
    double share_of_tolerance() const;
};

/// @param command command that writes the page, printed in its header
std::string verification_page(const std::vector<CheckedClaim>& checked, const std::string& command);

}  // namespace crackle::verification
