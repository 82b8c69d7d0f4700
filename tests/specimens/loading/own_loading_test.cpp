// SPDX-License-Identifier: GPL-3.0-or-later
// Tests callbacks during a test, and loading by a caller's own rule.

#include "specimens/loading/own_loading.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/stepping/controls.hpp"
#include "solver/world/state_hash.hpp"
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

class OwnLoading : public ::testing::Test {
  protected:
    VirtualTest prepared(const SmallCase& wanted) {
        return prepare_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
    }
    /// A test loaded by a tolerance instead of a rate.
    VirtualTest tolerant(const std::vector<double>& unload_at_strain) {
        ResolvedCase description = read_case(testing::write_small_case(scratch_ / "", brief()));
        description.loading.rate = parts::RateTolerance{0.05};
        description.loading.unloading = {true, unload_at_strain, 0.1};
        return prepare_test(description);
    }
    static SmallCase brief() {
        SmallCase wanted;
        wanted.rate = 0.0005;  // several steps per row
        wanted.max_strain = 0.001;
        wanted.output = "curve_rows = 200\nframes = 3";
        return wanted;
    }

  private:
    testing::ScratchFolder scratch_;
};

TEST_F(OwnLoading, LooksChangeNothing) {
    VirtualTest unseen = prepared(brief());
    load_specimen(unseen);
    for (const std::int64_t every : {0, 1, 77}) {
        VirtualTest seen = prepared(brief());
        std::int64_t looks = 0;
        TestHooks hooks;
        hooks.look_every = every;
        hooks.look = [&](VirtualTest& test) {
            ++looks;
            EXPECT_TRUE(test.world.stepping.forces_current);
            return AfterLook::go_on;
        };
        load_specimen(seen, hooks);
        EXPECT_EQ(hash_state(seen.world), hash_state(unseen.world)) << every;
        EXPECT_EQ(seen.state.rows.size(), unseen.state.rows.size());
        const std::int64_t steps = seen.world.stepping.steps;
        EXPECT_NEAR(static_cast<double>(looks),
                    static_cast<double>(every == 0 ? std::ssize(seen.state.rows) : steps / every), 2.0);
    }
}

TEST_F(OwnLoading, ALookEndsATestAtItsMoment) {
    VirtualTest test = prepared(brief());
    TestHooks hooks;
    hooks.look_every = 50;
    double at = 0.0;
    hooks.look = [&](VirtualTest& now) {
        at = now.setup.apparatus.axial_strain(now.world);
        return at > 3e-4 ? AfterLook::end : AfterLook::go_on;
    };
    load_specimen(test, hooks);
    EXPECT_EQ(test.state.ended_by, ended_by_caller);
    EXPECT_EQ(test.state.rows.back().axial_strain, at);
}

TEST_F(OwnLoading, AnInterruptByALookLeavesTheTestAsAnyOther) {
    VirtualTest straight = prepared(brief()), broken = prepared(brief());
    load_specimen(straight);
    TestHooks hooks;
    hooks.look = [](VirtualTest& now) {
        return now.state.rows.size() == 700 ? AfterLook::interrupt : AfterLook::go_on;
    };
    load_specimen(broken, hooks);
    ASSERT_TRUE(broken.state.ended_by.empty());
    EXPECT_EQ(broken.state.rows.size(), 700U);
    load_specimen(broken);
    EXPECT_EQ(hash_state(broken.world), hash_state(straight.world));
}

TEST_F(OwnLoading, RowsFollowThePlatenBackAndForth) {
    VirtualTest test = prepared(brief());
    const double speed = platen_speed(test);
    EXPECT_TRUE(agrees("speed, m/s", speed, 0.0005 * test.setup.apparatus.length, 1e-12));
    TestHooks hooks;
    hooks.look_every = 1;
    bool back = false;
    hooks.look = [&](VirtualTest& now) {
        const double strain = now.setup.apparatus.axial_strain(now.world);
        if (!back && strain > 2e-4) {
            back = true;
            set_platen_speed(now, -0.5 * speed);
            EXPECT_TRUE(agrees("speed back, m/s", platen_speed(now), -0.5 * speed, 1e-12));
        }
        return back && strain < 1e-4 ? AfterLook::end : AfterLook::go_on;
    };
    load_specimen(test, hooks);
    const std::vector<CurveRow>& rows = test.state.rows;
    const auto top = std::ranges::max_element(rows, {}, &CurveRow::axial_strain);
    EXPECT_NEAR(top->axial_strain, 2e-4, 1e-6);
    EXPECT_LT(rows.back().axial_strain, 1e-4);
    // Unloading has as many rows per strain as loading.
    const double up = static_cast<double>(top - rows.begin()) / 2e-4;
    const double down = static_cast<double>(rows.end() - top) / 1e-4;
    EXPECT_NEAR(down / up, 1.0, 0.02);
    EXPECT_TRUE(std::ranges::any_of(test.setup.origin.notices, [](const std::string& text) {
        return text.find("since a strain of 0.0002") != std::string::npos;
    }));
}

TEST_F(OwnLoading, EndsLoadingByTolerance) {
    VirtualTest test = tolerant({});
    ASSERT_GT(test.setup.rate_rule.tolerance, 0.0);
    const double speed = 0.5 * platen_speed(test);
    set_platen_speed(test, speed);
    load_specimen(test);
    EXPECT_EQ(platen_speed(test), speed);
    EXPECT_EQ(test.state.rate.slowest, test.state.rate.fastest) << "the rule must not change the rate";
}

TEST_F(OwnLoading, RefusesASpeedWhereTheCaseTurnsThePlaten) {
    VirtualTest test = tolerant({1e-4});
    EXPECT_NE(testing::refusal([&] { set_platen_speed(test, 0.1); }).find("list of unloadings"), std::string::npos);
    VirtualTest free = prepared(brief());
    EXPECT_NE(testing::refusal([&] { set_platen_speed(free, std::nan("")); }).find("found nan"), std::string::npos);
}

TEST_F(OwnLoading, RefusesASpeedOfAPartThatIsNotDrivenAtOne) {
    VirtualTest test = prepared(brief());
    const double speed = platen_speed(test);
    const DofControl still{Drive::velocity, 0.0};
    for (const DofControl& along : {DofControl{}, DofControl{Drive::force, 10.0}}) {
        const DofControl dof[3] = {along, along, still};
        set_control(test.world, test.setup.apparatus.top, dof, 0);
        EXPECT_NE(testing::refusal([&] { set_platen_speed(test, speed); }).find("driven at a given velocity"),
                  std::string::npos);
    }
    const DofControl dof[3] = {still, still, still};
    set_control(test.world, test.setup.apparatus.top, dof, 0);
    set_platen_speed(test, speed);
    EXPECT_EQ(platen_speed(test), speed);
}

}  // namespace
}  // namespace crackle
