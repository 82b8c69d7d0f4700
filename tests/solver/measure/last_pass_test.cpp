// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that forces of points observed after a step are those of its force pass.

#include "solver/measure/last_pass.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::within;

/// Largest difference of forces, relative to the largest force.
double difference(const World& a, const World& b) {
    double worst = 0.0, largest = 0.0;
    for (PointIndex k = 0; k < a.points.size(); ++k) {
        const PointLoad one = load_of_last_pass(a, k), other = load_of_last_pass(b, k);
        worst = std::max({worst, norm(one.force - other.force), norm(one.place - other.place)});
        largest = std::max(largest, norm(one.force));
    }
    return worst / largest;
}

TEST(LastPass, IsTheSameBeforeAndAfterBodiesMove) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        const testing::ScratchFolder scratch;
        testing::SmallCase wanted;
        wanted.mesh = mesh;
        VirtualTest test = prepare_test(read_case(testing::write_small_case(scratch / "", wanted)));
        for (int n = 0; n < 300; ++n) step(test.world);
        World looked_at = test.world;
        compute_forces(looked_at);  // positions, rotations and time of the force pass itself
        step(test.world);
        ASSERT_FALSE(test.world.stepping.forces_current);
        EXPECT_EQ(time_of_last_pass(looked_at), looked_at.stepping.time);
        EXPECT_TRUE(within("time, s", time_of_last_pass(test.world), looked_at.stepping.time, 1e-18));
        // Overlaps are 1e-5 of the coordinates, and moving back adds a few rounding errors of the coordinates.
        EXPECT_TRUE(within("difference", difference(looked_at, test.world), 0.0, 1e-9));
    }
}

TEST(LastPass, AddsUpToTheForcesOfTheBodies) {
    Scene scene = testing::small_rock_scene();
    scene.materials[0] = undamped_rock(1e7, 27.0);
    scene.time_step = 1e-7;
    scene.controls = {{0, {}, {Drive::velocity, -0.01}, {}, 0}};
    World world = build_world(scene);
    bond_all(world, 0.0);
    for (int n = 0; n < 200; ++n) step(world);
    compute_forces(world);
    std::vector<Vec2> sums(world.bodies.size());
    double largest = 0.0, worst = 0.0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointLoad load = load_of_last_pass(world, k);
        const ContactPoint point = world.points.contact[k];
        sums[point.body_i] = sums[point.body_i] + load.force;
        const bool wall = k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
        if (!wall) sums[point.body_j] = sums[point.body_j] - load.force;
    }
    for (std::size_t b = 0; b < sums.size(); ++b) {
        const Vec2 force{world.bodies.force[b].fx, world.bodies.force[b].fy};
        worst = std::max(worst, norm(sums[b] - force));
        largest = std::max(largest, norm(force));
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_TRUE(within("difference over the largest force", worst / largest, 0.0, 1e-9));
}

}  // namespace
}  // namespace crackle
