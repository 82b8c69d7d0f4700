// SPDX-License-Identifier: GPL-3.0-or-later
// A verification claim: a closed form or a law that the engine must satisfy, and rows that show how well it does.
// Claims are plain data, used by the tests (tests/verification/claims_test.cpp) and for the page (`crackle-bench
// verify`). A row compares one number. Its tolerance comes from a named error estimate, never from the result itself.
// If there is a discretisation error, the row also checks the observed order of convergence.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace crackle::verification {

/// Required relation of `got` to `expected`.
enum class Relation : std::uint8_t { equal, at_most, at_least };

struct ClaimRow {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    std::string label;
    Relation relation = Relation::equal;
    double expected = none;
    double got = none;        ///< NaN if the engine does not have this option
    double error = none;      ///< absolute, or relative to the expected value
    double tolerance = none;  ///< NaN in a row that only shows a value
    std::string estimate;     ///< origin of the tolerance in one or two words
    std::optional<double> order, expected_order;
    bool holds = false;
    bool relative_error = false;  ///< whether error and tolerance are relative to the expected value
    bool shown_only = false;      ///< whether the value is shown but not compared; such a row always holds
};

struct Claim {
    std::string name;       ///< snake_case, the test's name
    std::string group;      ///< heading on the page
    std::string statement;  ///< the closed form in words
    std::vector<ClaimRow> (*check)() = nullptr;
    bool slow = false;      ///< whether it takes seconds in a release build; its test then has the label `slow`
    bool offered = true;    ///< whether the engine has this option; if not, the rows show what would be expected
    std::string note = {};  ///< derivation, limits, or why the option does not exist
};

/// All claims in the order of the page.
const std::vector<Claim>& claims();

/// The rows of a claim. If the check ends with an exception (such as an unstable run), the result is a failed row that
/// names it.
std::vector<ClaimRow> check_claim(const Claim& claim);

/// «holds», «FAILS», «shown» or «not offered».
const char* verdict_of(const Claim& claim, const ClaimRow& row);

}  // namespace crackle::verification
