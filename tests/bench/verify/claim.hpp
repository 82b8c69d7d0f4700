// SPDX-License-Identifier: GPL-3.0-or-later
// A verification claim: a closed form or a law that the engine has to meet, and the rows that show how well it does.
// Plain data with two readers: the tests (tests/verification/claims_test.cpp) and the page (`crackle-bench verify`).
//
// A row compares one number. Its tolerance comes from an estimate of the error, named beside it, never from what came
// out. Where a discretisation error exists, a row carries the observed order of convergence too, and falls with it.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace crackle::verification {

/// How `got` has to stand to `expected`.
enum class Relation : std::uint8_t { equal, at_most, at_least };

struct ClaimRow {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    std::string label;
    Relation relation = Relation::equal;
    double expected = none;
    double got = none;        ///< not a number in a row that the engine does not offer
    double error = none;      ///< absolute, or over the expected value
    double tolerance = none;  ///< not a number in a row that only shows a figure
    std::string estimate;     ///< where the tolerance comes from, in a word or two
    std::optional<double> order, expected_order;
    bool holds = false;
    bool relative_error = false;  ///< error and tolerance are over the expected value
    bool shown_only = false;      ///< a figure that belongs to the claim but is not compared; always holds
};

struct Claim {
    std::string name;       ///< snake_case, the test's name
    std::string group;      ///< heading on the page
    std::string statement;  ///< the closed form in words
    std::vector<ClaimRow> (*check)() = nullptr;
    bool slow = false;      ///< seconds in a release build: a test of its own label
    bool offered = true;    ///< false: the engine has no such option; the rows show what would be expected
    std::string note = {};  ///< derivation, limits, why it is not offered
};

/// All claims in the order of the page.
const std::vector<Claim>& claims();

/// The rows of a claim. A check that ends with an exception (such as an unstable run) is a row that fails and names it.
std::vector<ClaimRow> check_claim(const Claim& claim);

/// «holds», «FAILS», «shown» or «not offered».
const char* verdict_of(const Claim& claim, const ClaimRow& row);

}  // namespace crackle::verification
