// SPDX-License-Identifier: GPL-3.0-or-later
// Tests loading by lateral strain: the same as by axial strain while nothing breaks, backwards when the specimen
// bursts.

#include "specimens/setup/lateral_control.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::SmallCase;
using testing::within;

TEST(LateralControl, FollowsABarSteadilyAndGoesBackFromABurst) {
    LateralRule rule;
    rule.ratio = 0.25;
    rule.band = 1e-5;
    rule.acceleration = 50.0;
    constexpr double allowed = 0.01, interval = 1e-3;
    LoadingPath path;
    path.speed = allowed;
    double strain = 0.0, burst = 0.0;
    const auto go = [&](int intervals) {
        for (int n = 0; n < intervals; ++n) {
            follow_lateral(path, rule, allowed, strain, rule.ratio * strain + burst, interval);
            strain += path.speed * interval;
        }
    };
    go(100);
    EXPECT_TRUE(agrees("speed of an elastic bar, 1/s", path.speed, allowed, 1e-12));
    // A jump of twenty bands: after smoothing over twenty calls it grows by a band per call, while the target grows by
    // a quarter of one.
    burst = 2e-4;
    go(10);
    EXPECT_TRUE(agrees("speed in a burst, 1/s", path.speed, -allowed, 1e-12));
    const double in_burst = strain;
    go(10);
    EXPECT_LT(strain, in_burst);
    go(200);
    EXPECT_TRUE(agrees("speed once the target has come up with it, 1/s", path.speed, allowed, 1e-12));
}

class WidenedRock : public ::testing::Test {
  protected:
    ResolvedCase controlled(const std::string& mesh, double max_strain) const {
        SmallCase wanted;
        wanted.kind = "compression";
        wanted.mesh = mesh;
        wanted.max_strain = max_strain;
        ResolvedCase description = read_case(testing::write_small_case(scratch_ / "", wanted));
        description.loading.rate = parts::RateTolerance{0.01};
        description.loading.control = LoadingControl::lateral;
        return description;
    }
    testing::ScratchFolder scratch_;
};

TEST_F(WidenedRock, IsLoadedAsByAxialStrainWhileNothingBreaks) {
    ResolvedCase description = controlled("", 4e-4);
    description.numerics.intact = true;
    description.loading.max_axial_strain = 3.0 * prepare_test(description).setup.rate_rule.first_strain;
    VirtualTest test = prepare_test(description);
    load_specimen(test);
    description.loading.control = LoadingControl::axial;
    VirtualTest axial = prepare_test(description);
    load_specimen(axial);
    ASSERT_EQ(test.state.ended_by, ended_by_strain);
    const CurveRow &last = test.state.rows.back(), &other = axial.state.rows.back();
    // The specimen follows the target with a delay of one transit time; the test takes thirty.
    EXPECT_TRUE(agrees("rate of lateral strain, 1/s",
                       test.setup.gauges.median_lateral_strain(test.world, test.setup.bonds.start) / last.time,
                       test.state.poissons_ratio * other.axial_strain / other.time, 0.05));
    EXPECT_TRUE(agrees("stress, N/m", last.axial_stress, test.state.youngs_modulus * last.axial_strain, 0.01));
    EXPECT_EQ(test.state.path.travel(last.axial_strain), last.axial_strain);
}

TEST_F(WidenedRock, BreakingSpecimenWidensNoFasterThanItsTarget) {
    const auto widening = [&](bool lateral) {
        ResolvedCase description = controlled("voronoi", 0.02);
        if (!lateral) description.loading.control = LoadingControl::axial;
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        EXPECT_TRUE(test.state.failure.failed);
        const auto& rows = test.state.rows;
        const CurveRow &last = rows.back(), &peak = rows[static_cast<std::size_t>(test.state.failure.peak_row)];
        EXPECT_TRUE(within("energy left open over the platens' work", last.energy_error / last.platen_work, 0.0, 1e-3));
        return (last.lateral_strain - peak.lateral_strain) / (last.time - peak.time);
    };
    EXPECT_LT(widening(true), 0.5 * widening(false)) << "mean rate of lateral strain after the peak";
}

TEST_F(WidenedRock, ControlThatMakesNoSenseIsRefused) {
    const auto refusal = [&](const std::string& kind, const std::string& keys) {
        SmallCase wanted;
        wanted.kind = kind;
        wanted.loading = keys;
        return testing::refusal([&] { read_case(testing::write_small_case(scratch_ / "", wanted)); });
    };
    EXPECT_NE(refusal("tension", "control = \"lateral\"").find("expected \"axial\""), std::string::npos);
    EXPECT_NE(
        refusal("compression", "control = \"lateral\"").find("expected a loading rate controlled by rate_tolerance"),
        std::string::npos);
    EXPECT_NE(refusal("compression", "control = \"radial\"").find("expected \"axial\" or \"lateral\""),
              std::string::npos);
}

}  // namespace
}  // namespace crackle
