// SPDX-License-Identifier: GPL-3.0-or-later
// Tests loading that reverses: position and smoothness of the reversal, and the cycles of the curve.

#include "specimens/setup/unloading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/measures/cycles.hpp"
#include "specimens/results/checkpoint.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::SmallCase;
using testing::within;

TEST(Unloading, ABarTurnsWhereItIsAskedToWithoutMoreThanItsAcceleration) {
    RateRule rate;
    rate.tolerance = 0.01;
    rate.transit_time = 0.02;
    rate.first_strain = 1e-3;
    constexpr double modulus = 5e6;
    const UnloadRule rule = unload_rule_of({true, {2e-3, 4e-3}, 0.25}, rate, modulus);
    // ρ height² a/2 = E T² a/2, the stress that accelerates the bar, is the tolerance times E ε1.
    EXPECT_TRUE(agrees("out-of-balance by it, N/m",
                       modulus * rate.transit_time * rate.transit_time * rule.acceleration / 2.0,
                       rate.tolerance * modulus * rate.first_strain, 1e-12));

    const double interval = rate.transit_time / checks_per_transit, fastest = largest_rate(rate);
    LoadingPath path;
    path.speed = fastest;
    double strain = 0.0, most_change = 0.0, travel = 0.0;
    std::vector<double> turns;
    for (int n = 0; n < 100000 && strain < 6e-3; ++n) {
        const double before = path.speed, turned_at = path.turned_at;
        turn_by_list(path, rule, fastest, strain, modulus * strain, interval);
        if (path.turned_at != turned_at) turns.push_back(strain);
        most_change = std::max(most_change, std::abs(path.speed - before));
        strain += path.speed * interval;
        travel += std::abs(path.speed) * interval;
    }
    EXPECT_TRUE(within("change of speed over that of the acceleration", most_change / (rule.acceleration * interval),
                       1.0, 1e-9));
    const double expected[] = {2e-3, 0.25 * 2e-3, 4e-3, 0.25 * 4e-3};
    ASSERT_EQ(turns.size(), 4U);
    // Overshoot at the reversal: two intervals at the creeping speed, and the deceleration from it.
    const double beyond = 2.0 * rule.creep * interval + rule.creep * rule.creep / (2.0 * rule.acceleration);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_TRUE(within("strain at turn, per 1e-3", 1e3 * turns[k], 1e3 * expected[k], 1e3 * beyond));
    EXPECT_TRUE(agrees("travel", path.travel(strain), travel, 1e-12));
}

TEST(Unloading, NeverStandsStillBeforeAStressThatIsNotReached) {
    RateRule rate;
    rate.tolerance = 0.01;
    rate.transit_time = 0.02;
    rate.first_strain = 1e-3;
    const UnloadRule rule = unload_rule_of({false, {1000.0}, 0.1}, rate, 1e6);
    LoadingPath path;
    path.speed = largest_rate(rate);
    for (int n = 0; n < 1000; ++n) turn_by_list(path, rule, largest_rate(rate), 1e-3, 999.9, 1e-3);
    EXPECT_TRUE(agrees("speed, 1/s", path.speed, 0.05 * largest_rate(rate), 1e-9));
}

class UnloadedRock : public ::testing::Test {
  protected:
    ResolvedCase loaded(const std::string& kind, const std::string& mesh, double max_strain) const {
        SmallCase wanted;
        wanted.kind = kind;
        wanted.mesh = mesh;
        wanted.max_strain = max_strain;
        ResolvedCase description = read_case(testing::write_small_case(scratch_ / "", wanted));
        description.loading.rate = parts::RateTolerance{0.01};
        return description;
    }
    /// Unloaded at two and four times its first strain, and then loaded to six times.
    ResolvedCase unloaded(const std::string& kind) const {
        ResolvedCase description = loaded(kind, "", 0.005);
        const double first = prepare_test(description).setup.rate_rule.first_strain;
        description.loading.unloading = {true, {2.0 * first, 4.0 * first}, 0.1};
        description.loading.max_axial_strain = 6.0 * first;
        return description;
    }
    VirtualTest tested(const ResolvedCase& description) const {
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        return test;
    }
    testing::ScratchFolder scratch_;
};

TEST_F(UnloadedRock, ElasticSpecimenHasItsModulusInEveryCycle) {
    for (const char* kind : {"compression", "tension"}) {
        ResolvedCase description = unloaded(kind);
        description.numerics.intact = true;
        const VirtualTest test = tested(description);
        const auto cycles = find_cycles(test.state.rows, test.setup.apparatus.compression);
        ASSERT_EQ(cycles.size(), 2U) << kind;
        const double first_strain = test.setup.rate_rule.first_strain, spacing = 6.0 * first_strain / 2000;
        const double area = test.setup.apparatus.section * test.setup.apparatus.length;
        for (std::size_t k = 0; k < 2; ++k) {
            const LoadingCycle& c = cycles[k];
            EXPECT_TRUE(
                within("strain at turn", c.strain, description.loading.unloading.at[k], spacing + 1e-3 * first_strain));
            // Dashpots exert no force on platens at rest; the remaining error is the out-of-balance force of the
            // reversal.
            EXPECT_TRUE(agrees("modulus of the cycle, N/m", c.modulus, test.state.youngs_modulus, 0.01));
            EXPECT_TRUE(within("Poisson's ratio", c.poissons_ratio, test.state.poissons_ratio, 0.01));
            EXPECT_TRUE(
                within("stress at the lowest strain, over that at the turn", c.low_stress / c.stress, 0.1, 0.01));
            EXPECT_TRUE(within("permanent over turning strain", c.permanent_strain / c.strain, 0.0, 0.01));
            const double stored = 0.5 * c.stress * c.strain * area;
            EXPECT_TRUE(within("loss over stored energy", c.loop * area / stored, 0.0, 0.02));
        }
        const FirstLoading first = first_loading(test.state.rows, test.state.failure.peak_row);
        for (const CurveRow& row : first.rows)
            ASSERT_NEAR(row.axial_stress, test.state.youngs_modulus * row.axial_strain,
                        0.01 * cycles[1].stress + 0.02 * test.state.youngs_modulus * row.axial_strain);
        EXPECT_FALSE(test.state.failure.failed) << "unloading is not failure";
    }
}

TEST_F(UnloadedRock, CyclesOfOneAmplitudeAllTurnThere) {
    for (const bool by_strain : {true, false}) {
        ResolvedCase description = unloaded("compression");
        description.numerics.intact = true;
        const VirtualTest prepared = prepare_test(description);
        const double first = prepared.setup.rate_rule.first_strain, strain = 2.0 * first;
        const double stress = strain * prepared.state.youngs_modulus;
        description.loading.max_axial_strain = 3.0 * first;
        description.loading.unloading = {by_strain, std::vector<double>(3, by_strain ? strain : stress), 0.1};
        const VirtualTest test = tested(description);
        const auto cycles = find_cycles(test.state.rows, true);
        ASSERT_EQ(cycles.size(), 3U);
        for (const LoadingCycle& c : cycles) {
            EXPECT_TRUE(agrees("strain at turn", c.strain, strain, 0.02));
            EXPECT_TRUE(agrees("modulus of the cycle, N/m", c.modulus, test.state.youngs_modulus, 0.01));
            EXPECT_FALSE(std::isnan(c.loop));
        }
    }
}

TEST_F(UnloadedRock, WhatBreaksLowersTheModulusAndCostsWork) {
    ResolvedCase description = loaded("compression", "voronoi", 0.02);
    const VirtualTest plain = tested(description);
    ASSERT_TRUE(plain.state.failure.failed);
    const double peak = plain.state.failure.peak_strain;
    description.loading.unloading = {true, {0.3 * peak, 0.95 * peak}, 0.1};
    const VirtualTest test = tested(description);
    const auto cycles = find_cycles(test.state.rows, true);
    ASSERT_EQ(cycles.size(), 2U);
    const double e = test.state.youngs_modulus;
    EXPECT_LT(cycles[1].modulus, cycles[0].modulus) << "of " << e;
    EXPECT_GT(cycles[1].loop, 0.0);
    EXPECT_TRUE(test.state.failure.failed);
    EXPECT_GT(test.state.failure.peak_strain, cycles[1].strain);
    // The energy account remains closed during the cycles.
    const CurveRow& last = test.state.rows.back();
    EXPECT_TRUE(within("energy left open over the platens' work", last.energy_error / last.platen_work, 0.0, 1e-3));
}

TEST_F(UnloadedRock, GoesOnFromWithinACycleAsIfItHadNotStopped) {
    const ResolvedCase description = unloaded("compression");
    const VirtualTest whole = tested(description);
    VirtualTest begun = prepare_test(description);
    TestHooks hooks;
    hooks.interrupted = [&] { return begun.state.path.unloading && begun.state.path.unloaded == 1; };
    load_specimen(begun, hooks);
    ASSERT_TRUE(begun.state.ended_by.empty());
    std::stringstream saved;
    save_test(saved, "case", begun.setup, begun.state, begun.world);
    TestCheckpoint read = load_test(saved, "checkpoint");
    VirtualTest resumed;
    resumed.description = begun.description;
    resumed.setup = std::move(read.setup);
    resumed.state = std::move(read.state);
    resumed.world = std::move(read.world);
    load_specimen(resumed);
    ASSERT_EQ(resumed.state.rows.size(), whole.state.rows.size());
    for (std::size_t k = 0; k < whole.state.rows.size(); ++k)
        ASSERT_EQ(curve_line(resumed.state.rows[k], false), curve_line(whole.state.rows[k], false)) << "row " << k;
}

TEST_F(UnloadedRock, ListsThatMakeNoSenseAreRefused) {
    const auto refusal = [&](const std::string& keys) {
        SmallCase wanted;
        wanted.loading = keys;
        return testing::refusal([&] { read_case(testing::write_small_case(scratch_ / "", wanted)); });
    };
    EXPECT_NE(refusal("unload_at_strain = [0.001]").find("expected a loading rate controlled by rate_tolerance"),
              std::string::npos);
    EXPECT_NE(refusal("unload_at_strain = 0.001").find("expected numbers in square brackets"), std::string::npos);
    EXPECT_NE(refusal("unload_at_strain = []").find("expected numbers in square brackets"), std::string::npos);
    EXPECT_NE(refusal("unload_at_strain = [0.001, -1.0]").find("found -1"), std::string::npos);
    EXPECT_NE(refusal("unload_to = 0.5").find("unload_at_strain"), std::string::npos);
}

}  // namespace
}  // namespace crackle
