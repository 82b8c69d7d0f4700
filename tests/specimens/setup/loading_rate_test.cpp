// SPDX-License-Identifier: GPL-3.0-or-later
// Tests loading by tolerance, and the companion tests that determine a test's error.

#include "specimens/setup/loading_rate.hpp"

#include <cmath>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/companions.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/measures/crack_thresholds.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_circles_rock.hpp"
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

/// Rate after 400 calls, twenty transit times, at a constant error.
double rate_after(double error, double tolerance) {
    const RateRule rule = rule_of(tolerance);
    RateState state;
    state.rate = largest_rate(rule);
    state.out_of_balance = error;
    for (int n = 0; n < 400; ++n) choose_rate(state, rule, state.rate, 0.0, 1.0, n * 5e-4);
    return state.rate;
}

TEST(LoadingRate, StaysAtItsLimitWhereNothingHappensAndFallsWithTheError) {
    const double limit = std::sqrt(0.01) * 1e-4 / 0.01;
    EXPECT_TRUE(agrees("first rate, 1/s", largest_rate(rule_of(0.01)), limit, 1e-12));
    EXPECT_LT(rate_after(0.03, 0.01), rate_after(0.005, 0.01));
    EXPECT_LE(rate_after(0.0, 0.01), limit * (1.0 + 1e-12));
    EXPECT_TRUE(agrees("rate at an error of the tolerance itself", rate_after(0.01, 0.01), limit, 1e-12));
    EXPECT_TRUE(agrees("rate at any error, 1/s", rate_after(1e3, 0.01), 0.15 * limit, 1e-9))
        << "the time for settling is limited";
}

struct Moment {
    const char* what;
    double balance, share_before, kinetic, stored;  // -, -, J, J
};

TEST(LoadingRate, FollowsItsFormulaInBothErrorsOfEachSign) {
    RateRule rule = rule_of(0.01);
    rule.kinetic_per_rate = 2e4;  // J s2; at the rate of 5e-4 below, loading itself has 5e-3 J
    rule.energy_floor = 1.0;
    const Moment moments[] = {
        {"nothing but the loading", 0.0, 0.0, 5e-3, 2.0},
        {"less than the loading", 0.004, 0.0, 1e-3, 2.0},
        {"upper platen ahead", 0.0102, 0.0, 5e-3, 2.0},
        {"lower platen ahead", -0.0102, 0.0, 5e-3, 2.0},
        {"lower platen far ahead", -0.7, 0.0, 5e-3, 2.0},
        {"nearly balanced", -0.009, 0.0, 5e-3, 2.0},
        {"moves beyond the loading", 0.0, 0.0098, 0.043, 2.0},
        {"moves, little stored", 0.0, 0.0098, 0.043, 0.5},
        {"moves less than before", 0.0, 0.012, 0.005, 2.0},
        {"both, the motion larger", -0.0101, 0.0105, 0.025, 2.0},
        {"both, the imbalance larger", 0.0105, 0.0101, 0.025, 2.0},
    };
    for (const Moment& m : moments) {
        RateState state;
        state.rate = state.slowest = state.fastest = 5e-4;  // half the limit of 1e-3
        state.out_of_balance = m.balance;
        state.kinetic_share = m.share_before;
        choose_rate(state, rule, state.rate, m.kinetic, m.stored, 3.0);
        // Each call is a twentieth of a transit time; per transit time, ln(rate) changes by root(tolerance)
        // ln(tolerance/error), by at most root(tolerance) upwards and four times that downwards.
        const double beyond = std::max(0.0, m.kinetic - 5e-3) / std::max(m.stored, 1.0);
        const double share = m.share_before + (beyond - m.share_before) / 20.0;
        const double error = std::max(std::abs(m.balance), share);
        double change = error > 0.0 ? 0.1 * std::log(0.01 / error) : 0.1;
        change = std::min(0.1, std::max(-0.4, change)) / 20.0;
        EXPECT_TRUE(agrees(fmt::format("{}: rate, 1/s", m.what), state.rate, 5e-4 * std::exp(change), 1e-12));
        EXPECT_TRUE(within(fmt::format("{}: smoothed kinetic share", m.what), state.kinetic_share, share, 1e-15));
        EXPECT_EQ(state.slowest, std::min(5e-4, state.rate)) << m.what;
        EXPECT_EQ(state.fastest, std::max(5e-4, state.rate)) << m.what;
        EXPECT_DOUBLE_EQ(state.next_check, 3.0 + 0.01 / 20.0) << m.what;
        EXPECT_DOUBLE_EQ(state.strain_above, error > 0.01 ? 5e-4 * 0.01 / 20.0 : 0.0) << m.what;
    }
}

TEST(LoadingRate, RemembersItsSlowestAndFastestRate) {
    const RateRule rule = rule_of(0.01);
    RateState state;
    state.rate = state.slowest = state.fastest = 5e-4;
    state.out_of_balance = 0.02;
    choose_rate(state, rule, state.rate, 0.0, 1.0, 0.0);
    const double slow = state.rate;
    state.out_of_balance = 0.0;
    for (int n = 0; n < 40; ++n) choose_rate(state, rule, state.rate, 0.0, 1.0, 0.0);
    const double fast = state.rate;
    state.out_of_balance = 0.02;
    choose_rate(state, rule, state.rate, 0.0, 1.0, 0.0);
    EXPECT_LT(slow, 5e-4);
    EXPECT_GT(fast, 5e-4);
    EXPECT_EQ(state.slowest, slow);
    EXPECT_EQ(state.fastest, fast);
}

TEST(LoadingRate, BalanceIsSmoothedOverATransitWithItsSignOverTheLargestStress) {
    RateRule rule = rule_of(0.01);
    rule.stress_floor = 10.0;
    RateState state;
    watch_balance(state, rule, 3.0, 1.0, 1e-3);  // a tenth of a transit; the stress of 2 is below the least, 10
    EXPECT_TRUE(agrees("upper platen ahead", state.out_of_balance, 0.1 * 0.2, 1e-12));
    watch_balance(state, rule, 30.0, 50.0, 1e-3);
    EXPECT_TRUE(agrees("lower platen ahead", state.out_of_balance, 0.02 + 0.1 * (-20.0 / 40.0 - 0.02), 1e-12));
    EXPECT_DOUBLE_EQ(state.largest_stress, 40.0);
    const double before = state.out_of_balance;
    watch_balance(state, rule, 1.0, 3.0, 1e-3);  // the largest stress so far, not the present one
    EXPECT_TRUE(agrees("after a fall", state.out_of_balance, before + 0.1 * (-2.0 / 40.0 - before), 1e-12));
    watch_balance(state, rule, 8.0, 0.0, 1.0);  // a step longer than a transit time discards earlier values
    EXPECT_TRUE(agrees("a step longer than a transit", state.out_of_balance, 0.2, 1e-12));
}

class ByTolerance : public ::testing::Test {
  protected:
    ResolvedCase small_case(const SmallCase& wanted) const {
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    ResolvedCase by_tolerance(const std::string& mesh, double tolerance) const {
        SmallCase wanted;
        wanted.mesh = mesh;
        ResolvedCase description = small_case(wanted);
        description.loading.rate = parts::RateTolerance{tolerance};
        return description;
    }
    VirtualTest tested(const ResolvedCase& description) const {
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        return test;
    }
    testing::ScratchFolder scratch_;
};

TEST_F(ByTolerance, StartsAsTheElasticSolutionMovesWithoutAShock) {
    for (const char* mesh : {"", "voronoi"}) {
        ResolvedCase description = by_tolerance(mesh, 0.01);
        description.loading.max_axial_strain = 2e-5;  // small enough that nothing slides
        description.numerics.intact = true;
        const VirtualTest test = tested(description);
        const double modulus = test.state.youngs_modulus;
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        double worst = 0.0;
        for (const CurveRow& row : test.state.rows) {
            // Dashpots carry their part of the stress from the first step on.
            const double expected = first.axial_stress + modulus * (row.axial_strain - first.axial_strain);
            worst = std::max(worst, std::abs(row.axial_stress - expected) / last.axial_stress);
        }
        // A sudden start at the platen's speed would cause an error of rate·transit/strain = sqrt(tolerance) = 0.1. The
        // initial ramp of the rule reduces it to half the tolerance.
        EXPECT_TRUE(
            within(fmt::format("{}: stress off the line of slope E, over the last stress", mesh), worst, 0.0, 0.01));
    }
}

TEST_F(ByTolerance, RuleHoldsTheSpecimensOwnScales) {
    for (const char* mesh : {"", "voronoi"}) {
        const VirtualTest test = prepare_test(by_tolerance(mesh, 0.01));
        const RateRule& rule = test.setup.rate_rule;
        const double modulus = test.small_strain->moduli.youngs_modulus, strain = test.small_strain->yield_strain;
        const double area = test.setup.specimen.width * test.setup.specimen.height;
        double mass = 0.0, kinetic = 0.0;
        for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
            const BodyState& body = test.world.bodies.state[b];
            const double own = test.world.bodies.inertia[b].mass;
            if (!test.setup.apparatus.is_platen(b)) mass += own;
            kinetic += 0.5 * (own * (body.vx * body.vx + body.vy * body.vy) +
                              test.world.bodies.info(b).moment * body.omega * body.omega);
        }
        EXPECT_EQ(rule.tolerance, 0.01);
        EXPECT_EQ(rule.first_strain, strain);
        EXPECT_TRUE(agrees("transit time, s", rule.transit_time,
                           test.setup.specimen.height * std::sqrt(mass / area / modulus), 1e-12));
        EXPECT_TRUE(agrees("stress at the first strain, N/m", rule.stress_floor, modulus * strain, 1e-12));
        EXPECT_TRUE(agrees("energy stored at it, J", rule.energy_floor, modulus * strain * strain * area / 2.0, 1e-12));
        const double rate = test.state.rate.rate;
        EXPECT_TRUE(agrees("first rate, 1/s", rate, 0.1 * strain / rule.transit_time, 1e-12));
        EXPECT_TRUE(agrees("kinetic energy of the start, J", rule.kinetic_per_rate * rate * rate, kinetic, 1e-12));
    }
}

TEST_F(ByTolerance, FirstRowsRiseByTheSolvedModulusAtTheRateOfAWholeTest) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        ResolvedCase description = by_tolerance(mesh, 0.01);
        description.numerics.intact = true;
        VirtualTest test = prepare_test(description);
        test.description.loading.max_axial_strain = 2e-5;  // the rate is for the whole test
        load_specimen(test);
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        EXPECT_GT(first.axial_stress, 0.0) << "the dashpots' share";
        const double slope = (last.axial_stress - first.axial_stress) / (last.axial_strain - first.axial_strain);
        // The remaining error is of second order in strain and speed.
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
    ResolvedCase description = small_case(wanted);
    description.loading.rate = parts::StrainRate{5e-4};
    const VirtualTest slow = tested(description);
    description.loading.rate = parts::RateTolerance{0.02};
    const VirtualTest quick = tested(description);
    EXPECT_LT(quick.world.stepping.steps, slow.world.stepping.steps / 2);
    EXPECT_TRUE(agrees("peak stress, N/m", quick.state.failure.peak_stress, slow.state.failure.peak_stress, 0.02));
    fmt::print("  {} steps against {}; rates {:.2g} to {:.2g} 1/s\n", quick.world.stepping.steps,
               slow.world.stepping.steps, quick.state.rate.slowest, quick.state.rate.fastest);
    const CurveRow& end = quick.state.rows.back();
    EXPECT_TRUE(within("energy closing error over the work", end.energy_error / end.platen_work, 0.0, 1e-3));
}

TEST_F(ByTolerance, TakesTheSameStepsHoweverFarApartTheRowsOfTheCurveAre) {
    ResolvedCase description = by_tolerance("", 0.02);
    const VirtualTest close = tested(description);
    description.loading.max_axial_strain *= 7.0;  // the number of rows is constant, so their spacing increases
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
    ResolvedCase description = small_case(wanted);
    description.loading.rate = parts::StrainRate{0.02};
    const VirtualTest test = tested(description);
    const auto errors = run_companions(test, {});
    ASSERT_TRUE(errors);
    EXPECT_EQ(errors->figures.companions->size(), 4U);
    EXPECT_EQ(errors->peak_converged, true);
    EXPECT_FALSE(errors->figures.crack_initiation_stress) << "of a tension";
    description.loading.rate = parts::StrainRate{0.004};
    const VirtualTest slow = tested(description);
    const double actual = std::abs(slow.state.failure.peak_stress / test.state.failure.peak_stress - 1.0);
    fmt::print("  stated {:.3g}, actual {:.3g}\n", *errors->figures.peak_stress->stated, actual);
    EXPECT_LE(actual, *errors->figures.peak_stress->stated);
    EXPECT_LE(*errors->figures.peak_stress->stated, 0.05);
}

TEST_F(ByTolerance, CracksOfACompressionHaveTheErrorsOfItsCompanions) {
    testing::write_circles_rock(scratch_ / "");
    const VirtualTest test = tested(read_case(scratch_ / "compression.toml"));
    ASSERT_TRUE(test.state.failure.failed);
    const auto errors = run_companions(test, {});
    ASSERT_TRUE(errors && errors->figures.crack_initiation_stress && errors->figures.crack_damage_stress);
    const ErrorFigures& damage = *errors->figures.crack_damage_stress;
    const auto thresholds = find_crack_thresholds(test.state.rows, test.state.failure.peak_row,
                                                  test.state.youngs_modulus, test.state.poissons_ratio);
    for (const auto& [name, companion] : *errors->figures.companions) {
        EXPECT_GT(*companion.crack_damage_stress, 0.0) << name;
        EXPECT_LE(*companion.crack_damage_stress, *companion.peak_stress) << name;
        if (name != "half_rate") continue;
        EXPECT_TRUE(agrees("damage, change at half the rate", *damage.rate,
                           std::abs(*companion.crack_damage_stress / thresholds.damage - 1.0), 1e-12));
    }
    // There are too few breaks to fit two lines, in the test or its companions.
    EXPECT_EQ(!errors->figures.crack_initiation_stress->stated, std::isnan(thresholds.count_break));
    const double spacing = test.state.rows[1].axial_stress / thresholds.damage;
    EXPECT_GT(*damage.resolution, 0.0);
    EXPECT_LT(*damage.resolution, 2.0 * spacing);
}

Table<CompanionFigures> companions_of_peaks(double half_step, double half_rate, double half_damping,
                                            double double_damping) {
    Table<CompanionFigures> all;
    const char* const names[] = {"half_time_step", "half_rate", "half_damping", "double_damping"};
    const double peaks[] = {half_step, half_rate, half_damping, double_damping};
    for (std::size_t k = 0; k < 4; ++k) all.emplace_back(names[k], CompanionFigures{.peak_stress = peaks[k]});
    return all;
}

TEST(StatedError, IsTheLargerOfChanceAndRateBesideTheRows) {
    // Values 10, 11, 10.1: s² = (0.3667² + 0.6333² + 0.2667²)/2; compares t√2 s/10 with 3·0.01.
    const auto chance =
        error_of(10.0, 0.05, companions_of_peaks(11.0, 10.1, 9.8, 10.3), &CompanionFigures::peak_stress);
    const double s = std::sqrt((0.11 / 0.3 * 0.11 / 0.3 + 0.19 / 0.3 * 0.19 / 0.3 + 0.08 / 0.3 * 0.08 / 0.3) / 2.0);
    EXPECT_TRUE(agrees("by chance", *chance.stated, std::hypot(0.05, 2.919986 * std::sqrt(2.0) * s / 10.0), 1e-4));
    EXPECT_TRUE(agrees("of the half step", *chance.time_step, 0.1, 1e-12));
    EXPECT_TRUE(agrees("of the half rate", *chance.rate, 0.01, 1e-12));
    EXPECT_TRUE(agrees("of the dampings", *chance.damping, 0.03, 1e-12));
    // Values 10, 10, 9: s² = 1/3; compares t√2 s/10 = 0.238 with 3·0.1.
    const auto rate = error_of(10.0, 0.05, companions_of_peaks(10.0, 9.0, 10.0, 10.0), &CompanionFigures::peak_stress);
    EXPECT_TRUE(agrees("by the rate", *rate.stated, std::hypot(0.05, 0.3), 1e-12));
    EXPECT_TRUE(
        !error_of(10.0, 0.05, companions_of_peaks(10.0, NAN, 10.0, 10.0), &CompanionFigures::peak_stress).stated);
}

TEST(StatedError, APeakIsConvergedInStressAndStrainByStepAndRate) {
    const auto within = [](double change) { return ErrorFigures{.time_step = change, .rate = change}; };
    const double stress = 0.9 * branch_stress_change, strain = 0.9 * branch_strain_change;
    EXPECT_TRUE(on_one_branch(within(stress), within(strain)));
    const auto moved = [](double by_step, double by_rate) {
        return ErrorFigures{.time_step = by_step, .rate = by_rate};
    };
    EXPECT_FALSE(on_one_branch(moved(1.5 * stress, stress), within(strain)));
    EXPECT_FALSE(on_one_branch(moved(stress, 1.5 * stress), within(strain)));
    EXPECT_FALSE(on_one_branch(within(stress), moved(1.5 * strain, strain)));
    EXPECT_FALSE(on_one_branch(within(stress), moved(strain, 1.5 * strain)));
    EXPECT_FALSE(on_one_branch(within(stress), moved(strain, NAN)));
}

TEST_F(ByTolerance, HoldsWhereNoRateIsGivenAndRefusesARateBesideIt) {
    const auto answer = [&](const std::string& from, const std::string& to) {
        const auto path = testing::write_small_case(scratch_ / "", {});
        std::string text = read_file(path);
        text.replace(text.find(from), from.size(), to);
        std::ofstream(path) << text;
        try {
            const ResolvedCase test = read_case(path);
            if (const double* tolerance = test.loading.rate_tolerance(); tolerance != nullptr && *tolerance == 0.01)
                return std::string("tolerance");
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
