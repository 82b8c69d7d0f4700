// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the ensemble of the guide's rock: its statistics, its verdicts, and the changes made by its experiments.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "solver/base/errors.hpp"
#include "tests/bench/guide/experiments.hpp"
#include "tests/bench/guide/page.hpp"
#include "tests/bench/guide/rows.hpp"

namespace crackle::studies {
namespace {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();

EnsembleOptions shipped_options() {
    EnsembleOptions options;
    options.cases = std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens" / "guide_rock";
    return options;
}

const GuideRow& row_named(const std::string& key) {
    for (const GuideRow& row : guide_rows()) {
        if (row.key == key) return row;
    }
    throw InputError("no row " + key);
}

GuideResult peak(double stress) { return {{{"largest_stress", stress}, {"strain_at_largest_stress", 0.002}}, ""}; }

TEST(GuideEnsemble, SpreadIsTheSampleDeviationOfWhatIsThere) {
    const Spread spread = spread_of({2.0, absent, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
    EXPECT_EQ(spread.packings, 8);
    EXPECT_DOUBLE_EQ(spread.mean, 5.0);
    EXPECT_DOUBLE_EQ(spread.deviation, std::sqrt(32.0 / 7.0));
    EXPECT_TRUE(std::isnan(spread_of({1.0}).deviation));
    EXPECT_TRUE(std::isnan(spread_of({absent}).mean));
}

TEST(GuideEnsemble, InsideIsWithinTwoDeviationsAndNeedsTwoPackings) {
    const GuideRow& row = row_named("circles_compressive_over_tensile");  // 2
    EXPECT_EQ(judge(row, {5, 2.4, 0.21}), GuideVerdict::inside);
    EXPECT_EQ(judge(row, {5, 2.4, 0.19}), GuideVerdict::outside);
    EXPECT_EQ(judge(row, {5, 1.6, 0.19}), GuideVerdict::outside);
    EXPECT_EQ(judge(row, {1, 2.0, absent}), GuideVerdict::open);
    EXPECT_EQ(judge(row_named("circles_back_tension"), {5, 0.7743, 0.0}), GuideVerdict::inside) << "its rounding";
    const GuideRow& larger = row_named("voronoi_compressive_over_delaunay");
    EXPECT_EQ(judge(larger, {5, 2.2, 0.1}), GuideVerdict::inside);
    EXPECT_EQ(judge(larger, {5, 0.9, 0.2}), GuideVerdict::outside);
}

TEST(GuideEnsemble, TestsThatAnExperimentDoesNotTouchAreTheShippedOnes) {
    GuideResults results;
    results[guide_test(as_shipped, "demseg", "circles", "tension", 3)] = peak(2.0);
    results[guide_test(as_shipped, "demseg", "circles", "compression", 3)] = peak(6.0);
    results[guide_test("smooth_platens", "demseg", "circles", "compression", 3)] = peak(5.0);
    results[guide_test("low_friction", "demseg", "circles", "compression", 3)] = peak(5.0);
    const GuideRow& row = row_named("circles_compressive_over_tensile");
    EXPECT_DOUBLE_EQ(row_value(row, results, as_shipped, "rounded", 3), 3.0)
        << "results of circles are used for all laws";
    EXPECT_DOUBLE_EQ(row_value(row, results, "smooth_platens", "demseg", 3), 2.5)
        << "platens that only touch cannot pull";
    EXPECT_TRUE(std::isnan(row_value(row, results, "low_friction", "demseg", 3))) << "its tension test is missing";
    EXPECT_TRUE(std::isnan(row_value(row, results, as_shipped, "demseg", 4)));
}

TEST(GuideEnsemble, EveryExperimentChangesTheCaseOfEveryTestItReaches) {
    const EnsembleOptions options = shipped_options();
    for (const GuideExperiment& experiment : guide_experiments()) {
        for (const char* specimen : {"circles", "delaunay", "voronoi"}) {
            for (const char* loading : {elastic_test, "tension", "compression"}) {
                if (!experiment.reach.holds(specimen, loading)) continue;
                const ResolvedCase test =
                    guide_case(guide_test(experiment.name, "rounded", specimen, loading, 7), options);
                EXPECT_EQ(test.packing()->seed, 7);
                EXPECT_EQ(test.loading.kind, from_name<LoadingKind>(loading).value_or(LoadingKind::tension));
                EXPECT_TRUE(test.loading.platens == PlatenKind::bonded || test.loading.kind == LoadingKind::compression)
                    << experiment.name;
            }
        }
    }
    EXPECT_DOUBLE_EQ(*guide_case({"double_overlap", "rounded", "delaunay", elastic_test, 1}, options).bond.thick,
                     1.16e-3);
    EXPECT_THROW(guide_experiment("no_such_experiment"), InputError);
}

TEST(GuideEnsemble, CirclesAreNearlyTheSameUnderEveryLaw) {
    const EnsembleOptions options = shipped_options();
    const auto elastic = [&](const char* law) {
        const GuideTest test{as_shipped, law, "circles", elastic_test, 1};
        return measure_guide_test(guide_case(test, options), test, {}).quantities;
    };
    const auto rounded = elastic("rounded"), guide = elastic("demseg");
    for (const char* quantity : {"youngs_modulus", "mean_back_tension", "contacts", "first_slip_stress"}) {
        // One of about 300 circles may touch the end of a platen's face, where the laws differ.
        EXPECT_NEAR(guide.at(quantity) / rounded.at(quantity), 1.0, 1e-3) << quantity;
    }
    EXPECT_NEAR(rounded.at("mean_back_tension"), 774.0, 0.5) << "N, the value to which the packing is compressed";
}

TEST(GuideEnsemble, TrianglesBetweenTheCentresAloneAreCountedWithoutPlatens) {
    const EnsembleOptions options = shipped_options();
    const auto counted = [&](const char* specimen) {
        const GuideTest test = guide_test("seeds_boundary", "demseg", specimen, elastic_test, 1);
        return measure_guide_test(guide_case(test, options), test, {});
    };
    const GuideResult triangles = counted("delaunay"), circles = counted("circles");
    EXPECT_EQ(triangles.error, "");
    EXPECT_EQ(circles.quantities.at("particles"), 304.0);
    // There are 2n - 2 - h triangles for n centres, h of them on the outline; the guide has 537.
    EXPECT_GT(triangles.quantities.at("particles"), 500.0);
    EXPECT_LT(triangles.quantities.at("particles"), 2.0 * 304.0 - 2.0 - 30.0);
    EXPECT_NEAR(circles.quantities.at("mean_back_tension"), 774.0, 15.0) << "without the platens' bonds";
}

TEST(GuideEnsemble, RowsOutsideNameTheExperimentThatReachesTheGuide) {
    GuideResults results;
    for (std::int64_t seed = 1; seed <= 3; ++seed) {
        const double spread = 0.1 * static_cast<double>(seed);
        results[guide_test(as_shipped, "rounded", "circles", "tension", seed)] = peak(5e3);
        results[guide_test(as_shipped, "rounded", "circles", "compression", seed)] = peak(15e3 + 1e3 * spread);
        results[guide_test("smooth_platens", "rounded", "circles", "compression", seed)] = peak(10e3);
        results[guide_test("frictional_platens", "rounded", "circles", "compression", seed)] = peak(14e3);
    }
    const std::string text = guide_page({"crackle-bench guide", {"rounded"}, 3, 1.0, 4}, results);
    for (const char* part :
         {"| circles' compressive over tensile strength | about 2 | 3.04 ± 0.02 (3) | **outside**, +52 % |",
          "### circles' compressive over tensile strength: the guide about 2, ours 3.04 ± 0.02 (3)",
          "Brings it inside: `smooth_platens` (2).",
          "| frictional_platens | platens not bonded, friction 27 degrees | 3 | 3.04 | 2.8 | outside |",
          "4 tests of this plan have not been run yet"})
        EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

}  // namespace
}  // namespace crackle::studies
