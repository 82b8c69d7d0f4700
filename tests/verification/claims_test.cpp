// SPDX-License-Identifier: GPL-3.0-or-later
// Runs every claim of tests/bench/verify as a test with the claim's name; `crackle-bench verify` shows the same rows on
// a page.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/verify/claim.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {

/// Name of a claim in GoogleTest's messages.
void PrintTo(const Claim& claim, std::ostream* out) { *out << claim.name; }

namespace {

class ClaimTest : public ::testing::TestWithParam<Claim> {};

TEST_P(ClaimTest, Holds) {
    const Claim& claim = GetParam();
    fmt::print("  {}\n", claim.statement);
    const std::vector<ClaimRow> rows = check_claim(claim);
    ASSERT_FALSE(rows.empty());
    for (const ClaimRow& row : rows) {
        const char* relation = row.relation == Relation::equal ? "" : row.relation == Relation::at_most ? "<= " : ">= ";
        fmt::print("  {}: expected {}{:.10g}, got {:.10g}, error {:.3g} (tolerance {:.3g})", row.label, relation,
                   row.expected, row.got, row.error, row.tolerance);
        if (row.order) fmt::print(", order {:.2f} (expected {:g})", *row.order, *row.expected_order);
        fmt::print(": {}\n", verdict_of(claim, row));
        EXPECT_TRUE(row.holds || !claim.offered) << row.label;
    }
    if (!claim.offered) GTEST_SKIP() << "not offered: " << claim.note;
}

/// Whether a claim is skipped: with sanitizers it would take minutes, and test_kind_test covers the same code in
/// seconds.
bool left_out(const Claim& claim) {
#ifdef __SANITIZE_ADDRESS__
    return claim.group == "Laboratory";
#else
    return claim.group.empty();
#endif
}

std::vector<Claim> claims_of(bool slow) {
    std::vector<Claim> some;
    std::copy_if(claims().begin(), claims().end(), std::back_inserter(some),
                 [&](const Claim& claim) { return claim.slow == slow && !left_out(claim); });
    return some;
}

std::string name_of(const ::testing::TestParamInfo<Claim>& claim) { return claim.param.name; }

// Claims that take seconds have the label slow (CMakeLists.txt).
INSTANTIATE_TEST_SUITE_P(Quick, ClaimTest, ::testing::ValuesIn(claims_of(false)), name_of);
INSTANTIATE_TEST_SUITE_P(Slow, ClaimTest, ::testing::ValuesIn(claims_of(true)), name_of);

TEST(Claims, HaveNamesOfTheirOwnAndSayWhatTheyClaim) {
    std::set<std::string> names;
    for (const Claim& claim : claims()) {
        EXPECT_TRUE(names.insert(claim.name).second) << claim.name << " stands twice";
        EXPECT_EQ(claim.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos)
            << claim.name;
        EXPECT_FALSE(claim.group.empty() || claim.statement.empty() || claim.check == nullptr) << claim.name;
        EXPECT_TRUE(claim.offered || !claim.note.empty()) << claim.name << ": not offered, but why?";
    }
}

TEST(Claims, ThatEndInAnExceptionFailAndNameIt) {
    Claim claim;
    claim.check = []() -> std::vector<ClaimRow> { throw std::runtime_error("runaway energy"); };
    const std::vector<ClaimRow> rows = check_claim(claim);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_FALSE(rows[0].holds);
    EXPECT_EQ(rows[0].label, "ended by: runaway energy");
    EXPECT_STREQ(verdict_of(claim, rows[0]), "FAILS");
}

// Tests how rows are judged: a tolerance that is met, one that is not, NaN, and an order that is too low.
TEST(Rows, AreJudgedAsTheyAreAdded) {
    Rows rows;
    rows.relative("inside", 101.0, 100.0, 0.011, "test").relative("outside", 101.0, 100.0, 0.009, "test");
    rows.absolute("no number", std::nan(""), 0.0, 1.0, "test").at_most("no number", std::nan(""), 1.0, "test");
    rows.at_most("above", 1.1, 1.0, "test").at_least("below", 0.9, 1.0, "test").exactly("other", 1.0, 2.0);
    rows.absolute("second order", 0.0, 0.0, 1.0, "test").converging({16.0, 1.0, 4.0, 2.0});
    rows.absolute("first order", 0.0, 0.0, 1.0, "test").converging({4.0, 1.0, 4.0, 2.0});
    rows.shown("figure", 7.0);
    const std::vector<bool> expected{true, false, false, false, false, false, false, true, false, true};
    const std::vector<ClaimRow> got = rows.take();
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t k = 0; k < got.size(); ++k) EXPECT_EQ(got[k].holds, expected[k]) << got[k].label;
    EXPECT_DOUBLE_EQ(got[7].order.value_or(0.0), 2.0);
}

TEST(Claims, StandOnTheShippedPage) {
    std::ifstream in(std::string(CRACKLE_SOURCE_DIR) + "/tests/benchmarks/results/verification.md");
    const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    for (const Claim& claim : claims())
        EXPECT_NE(page.find("\n### " + claim.name + "\n"), std::string::npos)
            << claim.name << ": make the page again, crackle-bench verify -o tests/benchmarks/results/verification.md";
    const auto sections = [&] {
        std::size_t count = 0;
        for (std::size_t at = page.find("\n### "); at != std::string::npos; at = page.find("\n### ", at + 1)) ++count;
        return count;
    }();
    EXPECT_EQ(sections, claims().size()) << "the page has claims that do not exist";
    EXPECT_EQ(page.find("FAILS"), std::string::npos);
}

}  // namespace
}  // namespace crackle::verification
