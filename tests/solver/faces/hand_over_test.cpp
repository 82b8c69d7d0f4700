// SPDX-License-Identifier: GPL-3.0-or-later
// The hand-over from a broken face to contact points: no jump of force over slips of three cells and turns of 90°.

#include "solver/faces/hand_over.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

using testing::within;

constexpr double gap = 0.02;       // m, of cells of 1 m
constexpr double pressing = 1e-4;  // N
constexpr int base_cells = 5, top_id = 100;

/// A row of cells on a held block, and one cell that lies on the second of them, without a bond, under a force.
World sliding_cell() {
    Scene scene;
    Material rock = any_material();
    rock.shear_stiffness = 1.0;
    scene.materials.push_back(rock);
    scene.time_step = 1e-3;
    scene.allow_unstable = true;
    scene.units = StiffnessUnits::area;
    scene.bond_law = BondLaw::face;
    scene.domain = {-10.0, 20.0, -10.0, 20.0, {false, false, false, false}};
    scene.thick = gap;
    const double half = 0.5 * gap;
    const auto box = [&](double x, double y, double width, double height) {
        return std::vector<Vec2>{{x + half, y + half},
                                 {x + width - half, y + half},
                                 {x + width - half, y + height - half},
                                 {x + half, y + height - half}};
    };
    for (int k = 0; k < base_cells; ++k) scene.add_chain_body(k + 1, 0, box(k, 0.0, 1.0, 1.0), true);
    Control held;
    held.body = static_cast<int>(scene.add_chain_body(base_cells + 1, 0, box(0.0, -1.0, base_cells, 1.0), true));
    held.x.drive = held.y.drive = held.rotation.drive = Drive::velocity;
    scene.controls.push_back(held);
    Control pushed;
    pushed.body = static_cast<int>(scene.add_chain_body(top_id, 0, box(0.5, 1.0, 1.0, 1.0), true));
    pushed.y = {Drive::force, -pressing};
    scene.controls.push_back(pushed);
    World world = build_world(scene);
    FaceBonding bonding;
    bonding.materials.push_back({face_moduli(1.0, 0.26, 1.0 / 1.6, 0.0), {}});
    bonding.materials[0].law.damping_ratio = 0.0;
    bonding.gap = gap;
    bonding.platens = PlatenFaces::glued;
    bonding.leaves = [&](BodyIndex i, BodyIndex j) {
        return world.bodies.names[i].id == top_id || world.bodies.names[j].id == top_id;
    };
    bond_by_faces(world, bonding);
    return world;
}

BodyIndex top_of(const World& world) { return body_of_id(world, top_id); }

TEST(HandOver, HasNoJumpOfForceOverASlipOfThreeCells) {
    World world = sliding_cell();
    const BodyIndex top = top_of(world);
    // Fast enough to climb out of the hollow that it presses into the cell below.
    world.bodies.state[top].vx = 2e-2;
    velocities_changed(world);
    double last = std::numeric_limits<double>::quiet_NaN(), jump = 0.0, largest = 0.0, taken = 0.0;
    const double start = world.bodies.state[top].x;
    int steps = 0;
    Ledger ledger;
    while (world.bodies.state[top].x < start + 3.0 && steps < 2'000'000) {
        compute_forces(world);
        const double force = world.bodies.force[top].fy;
        if (!std::isnan(last)) jump = std::max(jump, std::abs(force - last));
        largest = std::max(largest, std::abs(force));
        last = force;
        for (const BrokenFace& face : world.faces.broken) taken = std::max(taken, face.taken);
        if (steps % 1000 == 0) ledger = measure_ledger(world);
        advance(world);
        ++steps;
    }
    EXPECT_GE(world.bodies.state[top].x, start + 3.0);
    EXPECT_EQ(taken, 1.0);
    fmt::print("  {} steps, largest force {:.3g} of {:.3g} N\n", steps, largest, pressing);
    EXPECT_TRUE(within("largest change of force in a step, of the largest force", jump / largest, 0.0, 0.01));
    EXPECT_TRUE(
        within("closing error, of the energy", ledger.closing_error / (ledger.kinetic + ledger.strain), 0.0, 0.02));
}

TEST(HandOver, HasNoJumpOfForceOverATurnOf90Degrees) {
    World world = sliding_cell();
    const BodyIndex top = top_of(world);
    const BodyState start = world.bodies.state[top];
    // The cell turns about its lower left corner, which is pressed into the cell below.
    const double depth = 1e-4;
    const double half = 0.5 * (1.0 - gap);  // m, of the cell after the inset; its corners are round
    const Vec2 corner{start.x - half, start.y - half};
    double last_force = 0.0, last_torque = 0.0, jump = 0.0, largest = 0.0, taken = 0.0;
    double before = 0.0, jump_between = 0.0, after = 0.0;  // N, about the turns at which the face hands over
    constexpr int turns = 20'000;
    for (int n = 0; n <= turns; ++n) {
        const double angle = 0.5 * std::numbers::pi * n / turns;
        BodyState& body = world.bodies.state[top];
        const double c = std::cos(angle), s = std::sin(angle);
        body.x = corner.x + half * c - half * s;
        body.y = corner.y + half * s + half * c - depth;
        body.angle = angle;
        body.shape[0] = c, body.shape[1] = s;
        bodies_moved(world);
        compute_forces(world);
        const BodyForce& force = world.bodies.force[top];
        if (n > 0) jump = std::max({jump, std::abs(force.fy - last_force), std::abs(force.torque - last_torque)});
        largest = std::max(largest, std::abs(force.fy));
        if (angle < 0.015) before = std::abs(force.fy);
        const bool on_corner = angle < 1.4;  // later, the next side of the cell comes to lie on the cells below
        if (angle >= 0.015 && on_corner) jump_between = std::max(jump_between, std::abs(force.fy - last_force));
        if (angle > 0.05 && on_corner) after = std::max(after, std::abs(force.fy));
        last_force = force.fy, last_torque = force.torque;
        for (const BrokenFace& face : world.faces.broken) taken = std::max(taken, face.taken);
    }
    EXPECT_EQ(taken, 1.0);
    // The face's share falls over 0.02 rad, in 255 increments.
    EXPECT_TRUE(
        within("change of force in an increment of the hand-over, of that before", jump_between / before, 0.0, 0.02));
    EXPECT_LE(after, before) << "points begin without force";
    // Where the cell lies flat, a turn of one increment opens a length of φ/depth of it.
    const double opening = 0.5 * std::numbers::pi / turns / depth;
    EXPECT_TRUE(within("largest change of force or moment, of the force", jump / largest, 0.0, opening));
}

/// Moves a body to a point in steps of at most 0.01 m. @return largest force on it on the way, N
double carry_to(World& world, BodyIndex body, double x, double y) {
    double largest = 0.0;
    const double from_x = world.bodies.state[body].x, from_y = world.bodies.state[body].y;
    const int steps = static_cast<int>(std::ceil(std::hypot(x - from_x, y - from_y) / 0.01));
    for (int n = 1; n <= steps; ++n) {
        world.bodies.state[body].x = from_x + (x - from_x) * n / steps;
        world.bodies.state[body].y = from_y + (y - from_y) * n / steps;
        bodies_moved(world);
        compute_forces(world);
        const BodyForce& force = world.bodies.force[body];
        largest = std::max({largest, std::abs(force.fx), std::abs(force.fy)});
    }
    return largest;
}

TEST(HandOver, LeavesBodiesThatHaveMovedPastEachOtherAlone) {
    World world = sliding_cell();
    const BodyIndex top = top_of(world);
    const BodyState start = world.bodies.state[top];
    compute_forces(world);
    // Up, to the right beyond the row of cells, down, and back below it: there, the laps of all faces are as at the
    // start.
    double largest = 0.0;
    for (const auto& [x, y] : {Vec2{start.x, 4.0}, Vec2{8.0, 4.0}, Vec2{8.0, -4.0}, Vec2{start.x, -4.0}})
        largest = std::max(largest, carry_to(world, top, x, y));
    EXPECT_TRUE(
        within("largest force on the way, of that which had pressed the cell on", largest / pressing, 0.0, 1e-12));
    // On the way back, the edges meet again at a distance, and the face bears the load as at the start.
    const double depth = 1e-4;
    for (const auto& [x, y] : {Vec2{8.0, -4.0}, Vec2{8.0, 4.0}, Vec2{start.x, 4.0}, Vec2{start.x, start.y}})
        carry_to(world, top, x, y);
    EXPECT_TRUE(std::ranges::none_of(world.faces.broken, [](const BrokenFace& face) { return face.taken > 0.5; }));
    carry_to(world, top, start.x, start.y - depth);
    const double force = world.bodies.force[top].fy;
    World fresh = sliding_cell();
    compute_forces(fresh);
    carry_to(fresh, top_of(fresh), start.x, start.y - depth);
    EXPECT_TRUE(within("force at the same overlap, of a cell that has never left",
                       force / fresh.bodies.force[top_of(fresh)].fy, 1.0, 1e-9));
}

TEST(HandOver, SharesAFaceByItsLapAndItsTurn) {
    const FaceSprings springs{1.0, 1.0, 1.0, 0.5, 0.5, 0.0, 0.0};
    const auto share = [&](double sliding, double turn) {
        return share_of_points(springs, {{1.0, 0.0}, 0.0, sliding, turn}, gap);
    };
    EXPECT_EQ(share(0.0, 0.0), 0.0);
    EXPECT_NEAR(share(1.0 - 2.0 * gap, 0.0), 0.0, 1e-15);
    EXPECT_NEAR(share(-(1.0 - gap), 0.0), 0.5, 1e-14);
    EXPECT_EQ(share(1.5, 0.0), 1.0);
    EXPECT_NEAR(share(0.0, -0.03), 0.5, 1e-14);
    EXPECT_EQ(share(0.0, 0.05), 1.0);
}

}  // namespace
}  // namespace crackle::verification
