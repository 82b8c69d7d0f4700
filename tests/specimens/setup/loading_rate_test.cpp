// SPDX-License-Identifier: GPL-3.0-or-later
// Loading by tolerance, and the companions that state a test's error.

#include "specimens/setup/loading_rate.hpp"

#include <cmath>

#include "solver/base/errors.hpp"
#include "specimens/loading/companions.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::SmallCase;
using testing::within;

RateRule rule_of(double tolerance) {
    RateRule rule;
    rule.tolerance = tolerance;
    rule.transit_time = 0.01;
    rule.first_strain = 1e-4;
    rule.stress_floor = rule.energy_floor = 1.0;
    return rule;
}

/// Rate after 400 looks, twenty transits, at a steady error.
double rate_after(double error, double tolerance) {
    const RateRule rule = rule_of(tolerance);
    RateState state;
    state.rate = largest_rate(rule);
    state.out_of_balance = error;
    for (int n = 0; n < 400; ++n) choose_rate(state, rule, 0.0, 1.0, n * 5e-4);
    return state.rate;
}

TEST(LoadingRate, StaysAtItsLimitWhereNothingHappensAndFallsWithTheError) {
    const double limit = std::sqrt(0.01) * 1e-4 / 0.01;
    EXPECT_TRUE(agrees("first rate, 1/s", largest_rate(rule_of(0.01)), limit, 1e-12));
    EXPECT_LT(rate_after(0.03, 0.01), rate_after(0.005, 0.01));
    EXPECT_LE(rate_after(0.0, 0.01), limit * (1.0 + 1e-12));
    EXPECT_TRUE(agrees("rate at an error of the tolerance itself", rate_after(0.01, 0.01), limit, 1e-12));
    EXPECT_TRUE(agrees("rate at any error, 1/s", rate_after(1e3, 0.01), 0.15 * limit, 1e-9))
        << "a specimen that rings is not waited for without end";
}

class ByTolerance : public ::testing::Test {
  protected:
    TestCase small_case(const SmallCase& wanted) const {
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    VirtualTest tested(const TestCase& description) const {
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        return test;
    }
    testing::ScratchFolder scratch_;
};

TEST_F(ByTolerance, StartsAsTheElasticSolutionMovesWithoutAShock) {
    for (const char* mesh : {"", "voronoi"}) {
        SmallCase wanted;
        wanted.mesh = mesh;
        TestCase description = small_case(wanted);
        description.loading.axial_strain_rate.reset();
        description.loading.rate_tolerance = 0.01;
        description.loading.max_axial_strain = 2e-5;  // nothing slides yet
        description.numerics.intact = true;
        const VirtualTest test = tested(description);
        const double modulus = test.state.youngs_modulus;
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        double worst = 0.0;
        for (const CurveRow& row : test.state.rows) {
            // The dashpots bear their share of the stress from the first step on.
            const double expected = first.axial_stress + modulus * (row.axial_strain - first.axial_strain);
            worst = std::max(worst, std::abs(row.axial_stress - expected) / last.axial_stress);
        }
        // A shock of the platen's speed would be out by rate·transit/strain = sqrt(tolerance) = 0.1 of it; by the rule,
        // half of the tolerance is left.
        EXPECT_TRUE(
            within(fmt::format("{}: stress off the line of slope E, over the last stress", mesh), worst, 0.0, 0.01));
    }
}

TEST_F(ByTolerance, FirstRowsRiseByTheSolvedModulusAtTheRateOfAWholeTest) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        SmallCase wanted;
        wanted.mesh = mesh;
        TestCase description = small_case(wanted);
        description.loading.axial_strain_rate.reset();
        description.loading.rate_tolerance = 0.01;
        description.numerics.intact = true;
        VirtualTest test = prepare_test(description);
        test.description.loading.max_axial_strain = 2e-5;  // the rate is that of the whole test
        load_specimen(test);
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        EXPECT_GT(first.axial_stress, 0.0) << "the dashpots' share";
        const double slope = (last.axial_stress - first.axial_stress) / (last.axial_strain - first.axial_strain);
        // What is left is of second order in the strain and in the speed.
        EXPECT_TRUE(agrees(fmt::format("{}: slope of the first 2e-5 of strain, N/m", mesh), slope,
                           test.state.youngs_modulus, 2e-3));
        const double widening = (last.lateral_strain - first.lateral_strain) / (last.axial_strain - first.axial_strain);
        EXPECT_TRUE(
            agrees(fmt::format("{}: Poisson's ratio over them", mesh), -widening, test.state.poissons_ratio, 5e-3));
    }
}

TEST_F(ByTolerance, GivesThePeakOfASlowRunInFewerSteps) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    TestCase description = small_case(wanted);
    description.loading.axial_strain_rate = 5e-4;
    const VirtualTest slow = tested(description);
    description.loading.axial_strain_rate.reset();
    description.loading.rate_tolerance = 0.02;
    const VirtualTest quick = tested(description);
    EXPECT_LT(quick.world.stepping.steps, slow.world.stepping.steps / 2);
    EXPECT_TRUE(agrees("peak stress, N/m", quick.state.failure.peak_stress, slow.state.failure.peak_stress, 0.02));
    EXPECT_LE(quick.state.rate.slowest, quick.state.rate.fastest);
    fmt::print("  {} steps against {}; rates {:.2g} to {:.2g} 1/s\n", quick.world.stepping.steps,
               slow.world.stepping.steps, quick.state.rate.slowest, quick.state.rate.fastest);
    const CurveRow& end = quick.state.rows.back();
    EXPECT_TRUE(within("energy closing error over the work", end.energy_error / end.platen_work, 0.0, 1e-3));
}

TEST_F(ByTolerance, TakesTheSameStepsHoweverFarApartTheRowsOfTheCurveAre) {
    TestCase description = small_case({});
    description.loading.axial_strain_rate.reset();
    description.loading.rate_tolerance = 0.02;
    const VirtualTest close = tested(description);
    description.loading.max_axial_strain *= 7.0;  // rows share it out
    const VirtualTest apart = tested(description);
    EXPECT_GT(close.state.rows[1].axial_strain * 6.0, apart.state.rows[1].axial_strain);
    EXPECT_GT(apart.state.rows[1].axial_strain, 2.0 * close.state.rows[1].axial_strain);
    EXPECT_EQ(close.state.rate.largest_stress, apart.state.rate.largest_stress);
    EXPECT_TRUE(
        agrees("peak of the curve, N/m", apart.state.failure.peak_stress, close.state.failure.peak_stress, 0.01));
}

TEST_F(ByTolerance, StatedErrorCoversAFiveTimesSlowerRun) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    TestCase description = small_case(wanted);
    description.loading.axial_strain_rate = 0.02;
    const VirtualTest test = tested(description);
    const auto errors = run_companions(test, {});
    ASSERT_TRUE(errors);
    EXPECT_EQ(errors->companions.size(), 4U);
    EXPECT_EQ(errors->peak_converged, true);
    description.loading.axial_strain_rate = 0.004;
    const VirtualTest slow = tested(description);
    const double actual = std::abs(slow.state.failure.peak_stress / test.state.failure.peak_stress - 1.0);
    fmt::print("  stated {:.3g}, actual {:.3g}\n", errors->peak_stress.stated, actual);
    EXPECT_LE(actual, errors->peak_stress.stated);
    EXPECT_LE(errors->peak_stress.stated, 0.05);
}

TEST_F(ByTolerance, HoldsWhereNoRateIsGivenAndRefusesARateBesideIt) {
    const auto answer = [&](const std::string& from, const std::string& to) {
        const auto path = testing::write_small_case(scratch_ / "", {});
        std::string text = read_text_file(path);
        text.replace(text.find(from), from.size(), to);
        std::ofstream(path) << text;
        try {
            const TestCase test = read_case(path);
            if (test.loading.rate_tolerance == 0.01 && !test.loading.axial_strain_rate) return std::string("tolerance");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("rate");
    };
    EXPECT_NE(answer("max_axial_strain", "rate_tolerance = 0.01\nmax_axial_strain").find("expected one of them"),
              std::string::npos);
    EXPECT_EQ(answer("axial_strain_rate = 0.02\n", ""), "tolerance");
    EXPECT_EQ(answer("axial_strain_rate = 0.02", "rate_tolerance = 0.01"), "tolerance");
    EXPECT_EQ(answer("max_axial_strain", "max_axial_strain"), "rate");
}

}  // namespace
}  // namespace crackle
