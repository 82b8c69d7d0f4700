// SPDX-License-Identifier: GPL-3.0-or-later
// The claims and what came out, as a Markdown page. No date, version or time in it: the same numbers give the same
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
    /// Largest error over its tolerance; not a number where no row has a tolerance above 0.
    double share_of_tolerance() const;
};

/// @param command that makes the page, named in its header
std::string verification_page(const std::vector<CheckedClaim>& checked, const std::string& command);

}  // namespace crackle::verification
