// SPDX-License-Identifier: GPL-3.0-or-later
// The bare kernel computes the same forces as the engine; otherwise their rates could not be compared.

#include "tests/bench/throughput/bare_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/throughput/timed_test.hpp"

namespace crackle::throughput {
namespace {

constexpr double radius = 0.02;  // m, the same for all discs, since the bare kernel has only one dashpot constant

/// Discs that touch all their neighbours, with random velocities. Springs and dashpots act; at high speed, contacts
/// slide as well. @param speed m/s
World stirred_discs(double speed) {
    Scene scene = triangular_lattice(20, 20, radius, 8e-5, timed_rock());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b);
        scene.bodies[b].velocity = {speed * std::sin(1.7 * k), speed * std::cos(2.3 * k)};
        scene.bodies[b].spin = 50.0 * speed * std::sin(0.9 * k);
    }
    return build_world(scene);
}

double largest_difference(const World& world, const BareKernel& bare, double& scale, int& sliding) {
    std::map<std::pair<BodyIndex, BodyIndex>, PointIndex> points;
    for (PointIndex k = 0; k < world.points.size(); ++k)
        points[{world.points.contact[k].body_i, world.points.contact[k].body_j}] = k;
    double largest = 0.0;
    scale = 0.0;
    for (const BareKernel::Contact& contact : bare.contacts()) {
        const PointIndex k = points.at({contact.i, contact.j});
        const PointForce& engine = world.points.force[k];
        sliding += (world.points.state[k].flags & point_sliding) != 0 ? 1 : 0;
        scale = std::max(scale, std::hypot(engine.fx, engine.fy));
        largest = std::max({largest, std::abs(engine.fx - contact.force.fx), std::abs(engine.fy - contact.force.fy),
                            std::abs(engine.torque_i - contact.force.torque_i) / radius,
                            std::abs(engine.torque_j - contact.force.torque_j) / radius});
    }
    return largest;
}

TEST(BareKernel, HasTheForcesOfTheEngine) {
    World world = stirred_discs(5.0);
    compute_forces(world);
    advance(world);  // from now on a drift lasts a whole step, as in the bare kernel
    BareKernel bare(world);
    compute_forces(world);
    bare.compute_forces();
    double scale = 0.0;
    int sliding = 0;
    const double difference = largest_difference(world, bare, scale, sliding);
    // Overlaps of 8e-5 m are computed from coordinates of about 1 m, so they have 12 correct digits; velocities have as
    // many.
    std::printf("largest difference of forces: expected 0, got %.3g of the largest, %d of %zu points slide\n",
                difference / scale, sliding, bare.points());
    EXPECT_GT(bare.points(), 800u);
    EXPECT_GT(sliding, 20);
    EXPECT_LT(difference / scale, 1e-10);
}

TEST(BareKernel, MovesAsTheEngineDoes) {
    World world = stirred_discs(1e-3);
    compute_forces(world);
    advance(world);
    BareKernel bare(world);
    for (int k = 0; k < 3; ++k) {
        compute_forces(world);
        advance(world);
        bare.step();
    }
    compute_forces(world);
    bare.compute_forces();
    double scale = 0.0;
    int sliding = 0;
    const double difference = largest_difference(world, bare, scale, sliding);
    std::printf("after three steps: %.3g of the largest force\n", difference / scale);
    EXPECT_LT(difference / scale, 1e-9);
}

}  // namespace
}  // namespace crackle::throughput
