// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a linear solve can be ended by its caller between any two of its steps.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "solver/linear/critical_step.hpp"
#include "solver/linear/elastic.hpp"
#include "solver/linear/lanczos_bound.hpp"
#include "solver/linear/vibration.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

struct Enough {};

class StoppedSolve : public ::testing::Test {
  protected:
    StoppedSolve() {
        Scene scene = testing::small_rock_scene();
        scene.time_step = 0.0;
        world_ = build_world(std::move(scene));
        bond_all(world_, 2.0 * testing::rock_overlap);
    }

    /// Ends `solve` at each of its calls of while_solving, in separate runs.
    void expect_heard(const std::function<void()>& solve, int fewest) {
        int looks = 0;
        world_.workers.while_solving = [&] { ++looks; };
        solve();
        EXPECT_GE(looks, fewest);
        const int all = looks;
        for (int last = 1; last <= all; ++last) {
            int left = last;
            world_.workers.while_solving = [&] {
                if (--left == 0) throw Enough();
            };
            EXPECT_THROW(solve(), Enough) << last << " of " << all;
        }
        world_.workers.while_solving = {};
    }

    World world_;
};

TEST_F(StoppedSolve, OfTheElasticSolution) {
    expect_heard([&] { solve_elastic(world_, {{0, {}}, {5, {0.0, 1e-6, 0.0}}}); }, 2);
}

TEST_F(StoppedSolve, OfFreeMotions) {
    expect_heard([&] { find_free_motions(world_, {}); }, 5);  // the whole specimen is free, so probes follow
}

TEST_F(StoppedSolve, OfTheCriticalStep) {
    expect_heard([&] { critical_step(world_, ClosedPoints::bonded); }, 40);
    expect_heard([&] { stable_at(world_, ClosedPoints::bonded, 1e-6); }, 2);
    expect_heard([&] { growth_per_step(world_, ClosedPoints::bonded, 1e-3); }, 40);
}

TEST_F(StoppedSolve, OfTheStepOfLargeWorlds) {
    expect_heard([&] { lanczos_step(world_, ClosedPoints::bonded, 1e-6); }, 40);
}

TEST_F(StoppedSolve, OfVibrations) {
    const auto free = find_free_motions(world_, {});
    expect_heard([&] { lowest_modes(world_, 3, free.count); }, 10);
}

}  // namespace
}  // namespace crackle
