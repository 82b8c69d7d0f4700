// SPDX-License-Identifier: GPL-3.0-or-later
// Tests means, biases and their errors for results set by hand, column by column of the printed table.

#include "specimens/campaign/point_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "specimens/summary/summary_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using testing::agrees;

/// The results of one point: three packings as requested, at half the step and at half the rate; the last packing did
/// not fail. Twice the changes of the strengths are 1, 2, 3 for the step and 4, 1, 4 for the rate; their sums are 5, 3,
/// 7.
LedgerTable three_packings(const std::string& units) {
    LedgerTable results;
    results.columns = {"row",
                       "test",
                       "material.friction_angle",
                       "seed",
                       "variant",
                       "identity",
                       "state",
                       "processor_seconds",
                       "failed",
                       "material_units",
                       "peak_stress",
                       "tangent_modulus_50",
                       "youngs_modulus"};
    const std::map<Variant, std::array<double, 3>> strengths{{Variant::as_asked, {4.0, 5.0, 9.0}},
                                                             {Variant::half_step, {3.5, 4.0, 7.5}},
                                                             {Variant::half_rate, {2.0, 4.5, 7.0}}};
    for (const auto& [variant, values] : strengths) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double number = static_cast<double>(results.rows.size());
            results.rows.push_back({number, "tension", 27.0, static_cast<double>(k + 1), name_of(variant),
                                    fmt::format("{:032}", results.rows.size()), row_done, 1.0, k == 2 ? 0.0 : 1.0,
                                    units, values[k], 10.0 + 3.0 * static_cast<double>(k), 100.0});
        }
    }
    return results;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
}

/// The row of each result, as values by column name.
std::map<std::string, std::map<std::string, std::string>> rows_of(const std::string& csv) {
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> names = cells_of(line);
    std::map<std::string, std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = cells_of(line);
        std::map<std::string, std::string> row;
        for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = k < cells.size() ? cells[k] : "";
        rows[row.at("figure")] = row;
    }
    return rows;
}

TEST(PointTable, EachColumnIsWhatItsNameSays) {
    const std::vector<std::string> figures{"peak_stress", "tangent_modulus_50", "youngs_modulus"};
    const auto points = summarise(three_packings("area"), figures);
    ASSERT_EQ(points.size(), 1U);
    const auto rows = rows_of(points_csv(points, figures));
    const auto number = [&](const char* figure, const char* column) { return std::stod(rows.at(figure).at(column)); };
    EXPECT_EQ(rows.at("peak_stress").at("unit"), "Pa");
    EXPECT_EQ(number("peak_stress", "material.friction_angle"), 27.0);
    EXPECT_EQ(number("peak_stress", "planned"), 3.0);
    EXPECT_EQ(number("peak_stress", "done"), 3.0);
    EXPECT_EQ(number("peak_stress", "not_failed"), 1.0);
    EXPECT_EQ(number("peak_stress", "gone_wrong"), 0.0);
    // For 4, 5, 9 the sum of squares about the mean of 6 is 14; t is for two degrees of freedom.
    const double error = std::sqrt(7.0 / 3.0), t = 4.302653;
    EXPECT_TRUE(agrees("mean", number("peak_stress", "mean"), 6.0, 1e-12));
    EXPECT_TRUE(agrees("deviation", number("peak_stress", "standard_deviation"), std::sqrt(7.0), 1e-12));
    EXPECT_TRUE(agrees("its error", number("peak_stress", "standard_error"), error, 1e-12));
    EXPECT_TRUE(agrees("lower end", number("peak_stress", "low_95"), 6.0 - t * error, 1e-6));
    EXPECT_TRUE(agrees("upper end", number("peak_stress", "high_95"), 6.0 + t * error, 1e-6));
    EXPECT_TRUE(agrees("bias", number("peak_stress", "bias"), 5.0, 1e-12));
    EXPECT_TRUE(agrees("its error", number("peak_stress", "bias_standard_error"), 2.0 / std::sqrt(3.0), 1e-12));
    EXPECT_TRUE(agrees("by the step", number("peak_stress", "bias_step"), 2.0, 1e-12));
    EXPECT_TRUE(agrees("by the rate", number("peak_stress", "bias_rate"), 3.0, 1e-12));
    EXPECT_EQ(number("peak_stress", "bias_packings"), 3.0);
    // The packing that did not fail has no tangent modulus at half the peak.
    EXPECT_EQ(number("tangent_modulus_50", "packings"), 2.0);
    EXPECT_TRUE(agrees("mean of those that failed", number("tangent_modulus_50", "mean"), 11.5, 1e-12));
    EXPECT_EQ(points[0].values.at("tangent_modulus_50"), (std::vector{10.0, 13.0})) << "values of a drawn figure";
    EXPECT_EQ(number("youngs_modulus", "packings"), 3.0) << "Young's modulus needs no peak";
    EXPECT_EQ(rows_of(points_csv(summarise(three_packings("point"), figures), figures)).at("peak_stress").at("unit"),
              "N/m");
}

TEST(Verdict, NamesWhatDominatesAndWhatWouldChangeIt) {
    MeanFigure mean;
    mean.count = 4;
    mean.mean = 100.0;
    mean.deviation = 2.0;
    mean.standard_error = 1.0;
    const MeanBias by_step{4, 5.0, 0.1, 1.0, 0.1, 6.0, 0.1}, by_rate{4, 1.0, 0.1, 5.0, 0.1, 6.0, 0.1};
    EXPECT_NE(verdict_on(mean, by_step).find("it exceeds the error"), std::string::npos);
    EXPECT_NE(verdict_on(mean, by_step).find("a smaller safety_factor"), std::string::npos);
    EXPECT_NE(verdict_on(mean, by_rate).find("a lower rate or rate_tolerance"), std::string::npos);
    EXPECT_NE(
        verdict_on(mean, by_rate).find("(due to the time step +1 ± 0.1 %, due to the rate +5 ± 0.1 %; 4 packings)"),
        std::string::npos)
        << verdict_on(mean, by_rate);
    // Three packings do not decide, however small their errors seem.
    const MeanBias few{3, 5.0, 0.1, 1.0, 0.1, 6.0, 0.1};
    EXPECT_NE(verdict_on(mean, few).find("too few for a judgement, which needs at least 4 packings"), std::string::npos)
        << verdict_on(mean, few);
    EXPECT_EQ(verdict_on(mean, few).find("reduces it"), std::string::npos);
    // Nine packings give an error of 2 %, so one gives 6 %, and 36 give 1 %.
    const MeanBias unseen{9, 0.1, 2.0, 0.1, 2.0, 0.2, 2.0};
    EXPECT_NE(verdict_on(mean, unseen).find("not significant; 36 packings would reveal a bias of 1 %"),
              std::string::npos)
        << verdict_on(mean, unseen);
    // The bias is 0.5 and the scatter 2, so their effects are equal for 16 packings.
    const MeanBias small{4, 0.4, 0.01, 0.1, 0.01, 0.5, 0.01};
    EXPECT_NE(verdict_on(mean, small)
                  .find("the scatter of the packings is larger, ± 1 %; with 16 packings both would be equal"),
              std::string::npos)
        << verdict_on(mean, small);
}

TEST(CampaignFigures, FlagsAreOneWhereTheyHold) {
    const Figures expected{{"failed", 1.0}, {"interrupted", 0.0}};
    EXPECT_EQ(figures_of(parse_summary(R"({"failed": true, "interrupted": false, "peak_converged": null})")), expected);
}

TEST(Ledger, KeepsProcessorAndClockApart) {
    const testing::ScratchFolder scratch;
    CampaignLedger ledger = CampaignLedger::open(scratch / "campaign.sqlite");
    RowResult result;
    result.identity = "0123";
    result.state = row_done;
    result.processor_seconds = 3.0;
    result.wall_seconds = 5.0;
    ledger.record(result, "here");
    const LedgerTable times = ledger.query("SELECT processor_seconds, wall_seconds FROM test");
    EXPECT_EQ(std::get<double>(times.rows[0][0]), 3.0);
    EXPECT_EQ(std::get<double>(times.rows[0][1]), 5.0);
}

LedgerTable named(const std::string& name) {
    return {{"row", "test", "seed", "variant", "identity", "state", "processor_seconds"},
            {{1.0, name, 1.0, std::string("as_asked"), std::string("0"), std::string("done"), 1.0}}};
}

std::string cell_of(const std::string& name) {
    const std::string line =
        tests_csv(named(name)).substr(std::string("row,test,seed,variant,identity,state\n").size());
    return line.substr(2, line.find(",1,as_asked") - 2);
}

TEST(PointTable, ASpreadsheetComputesNoName) {
    EXPECT_EQ(cell_of("=1+1"), "\"'=1+1\"");
    EXPECT_EQ(cell_of("+cmd"), "\"'+cmd\"");
    EXPECT_EQ(cell_of("-x\"y"), "\"'-x\"\"y\"");
    EXPECT_EQ(cell_of("@SUM(A1)"), "\"'@SUM(A1)\"");
    EXPECT_EQ(cell_of("\t=1"), "\"'\t=1\"");
    EXPECT_EQ(cell_of("'=1"), "\"''=1\"") << "one apostrophe comes off again";
    for (const char* same : {"-1.5e3", "+2", "a=b", "it's", "", "1-2"}) EXPECT_EQ(cell_of(same), same);
    EXPECT_EQ(cell_of("a,b"), "\"a,b\"");
}

}  // namespace
}  // namespace crackle
