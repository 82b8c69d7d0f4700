// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which contacts are across a joint, for cells whose faces on traces are known.

#include "solver/geometry/across_joint.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "tests/support/jointed_cells.hpp"

namespace crackle::across_joint_test {
namespace {

using testing::JointedCells;

constexpr int most_steps = 200'000;  // limit for runs in which bodies should slide

Joint of_friction(double angle) {
    Joint joint;
    joint.friction_angle = angle;
    return joint;
}

std::int32_t between(const World& world, int a, int b) {
    return joint_between(world, body_of_id(world, a), body_of_id(world, b));
}

TEST(AcrossJoint, BodiesAreWhereTheyHaveFacesOnOppositeSidesOfATrace) {
    JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints = {of_friction(20.0)};
    const World world = jointed_world(cells);
    EXPECT_EQ(between(world, 5, 9), 0) << "above each other";
    EXPECT_EQ(between(world, 9, 5), 0) << "in either order";
    EXPECT_EQ(between(world, 5, 12), 0) << "far apart along the trace, where one may slide to the other";
    EXPECT_EQ(between(world, 5, 6), no_joint) << "neighbours on one side";
    EXPECT_EQ(between(world, 1, 5), no_joint) << "a face of the rock";
    EXPECT_EQ(between(world, 1, 9), no_joint) << "one without a face on it";
}

TEST(AcrossJoint, WhereTracesCrossTheFirstOfThoseThatPartTheBodiesCounts) {
    JointedCells cells;
    cells.above_row = {{1, 1}};
    cells.right_of_column = {{1, 0}};
    cells.joints = {of_friction(20.0), of_friction(25.0)};
    const World world = jointed_world(cells);
    EXPECT_EQ(between(world, 6, 10), 1) << "across the horizontal trace";
    EXPECT_EQ(between(world, 6, 7), 0) << "across the vertical trace";
    EXPECT_EQ(between(world, 6, 11), 1) << "across both traces: the first one";
    EXPECT_EQ(between(world, 5, 10), 1);
    EXPECT_EQ(between(world, 5, 6), no_joint);
}

TEST(AcrossJoint, ATraceThatIsAsTheRockHasNone) {
    JointedCells cells;
    cells.above_row = {{0, -1}, {1, 0}};
    cells.joints = {of_friction(20.0)};
    const World world = jointed_world(cells);
    EXPECT_EQ(between(world, 1, 5), no_joint);
    EXPECT_EQ(between(world, 5, 9), 0);
}

/// Indices of the laws of points between bodies on opposite sides, and of all other points.
TEST(AcrossJoint, PointsHaveItsLawBondedBrokenAndMetLater) {
    JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints = {of_friction(20.0)};
    cells.joints[0].strength_factor = 1e-3;
    World world = jointed_world(cells);
    const std::size_t first = world.settings.first_joint_law();
    const auto check = [&](const char* when) {
        int across = 0, elsewhere = 0;
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            const ContactPoint point = world.points.contact[k];
            const bool parted = joint_between(world, point.body_i, point.body_j) == 0;
            ASSERT_EQ(world.points.state[k].law >= first, parted) << when << ", point " << k;
            ++(parted ? across : elsewhere);
        }
        EXPECT_GT(across, 0) << when;
        EXPECT_GT(elsewhere, 0) << when;
    };
    check("bonded");
    // The upper half slides over the lower one by more than a cell, so that each cell meets others.
    for (int id = 1; id <= 16; ++id) {
        BodyState& body = world.bodies.state[body_of_id(world, id)];
        body.vx = id > 8 ? 1.0 : -1.0;
        body.vy = id > 8 ? -0.02 : 0.02;
    }
    velocities_changed(world);
    const std::int64_t built = world.list.builds;
    const double reach = 1.5 * cells.size;
    const BodyIndex low = body_of_id(world, 5), high = body_of_id(world, 9);
    const auto slid = [&] { return world.bodies.state[high].x - world.bodies.state[low].x; };
    for (int n = 0; n < most_steps && slid() < reach; ++n) step(world);
    EXPECT_GE(slid(), reach);
    EXPECT_GT(world.list.builds, built);
    EXPECT_GT(world.bonds.broken, 0);
    check("slid");
}

TEST(AcrossJoint, ContactsMetLaterHaveItsAperture) {
    JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints.resize(1);
    cells.joints[0].bonded = false;
    cells.joints[0].aperture = 1e-5;
    World world = jointed_world(cells);
    for (int id = 1; id <= 16; ++id) world.bodies.state[body_of_id(world, id)].vx = id > 8 ? 1.0 : -1.0;
    velocities_changed(world);
    const BodyIndex low = body_of_id(world, 5), high = body_of_id(world, 9);
    const auto slid = [&] { return world.bodies.state[high].x - world.bodies.state[low].x; };
    for (int n = 0; n < most_steps && slid() < 1.5 * cells.size; ++n) step(world);
    EXPECT_GE(slid(), 1.5 * cells.size);
    int met_later = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        if (joint_between(world, point.body_i, point.body_j) == no_joint) continue;
        if ((world.points.state[k].flags & point_had_bond) != 0) continue;
        EXPECT_EQ(world.points.bond_overlap[k], cells.joints[0].aperture) << k;
        ++met_later;
    }
    EXPECT_GT(met_later, 5);
}

TEST(AcrossJoint, LawsAreTheSameHoweverWideTheListsSkinIs) {
    JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints = {of_friction(20.0)};
    cells.joints[0].bonded = false;
    Scene scene = jointed_scene(cells);
    scene.time_step = 4e-7;  // fixed, since an automatic step depends on the listed points
    std::vector<BodyState> ends[2];
    for (const bool wide : {false, true}) {
        scene.skin = wide ? 0.02 : 0.002;
        World world = build_world(scene);
        Bonding bonding;
        bonding.thick = cells.thick;
        bonding.gap = 0.05 * cells.thick;
        bond_all(world, bonding);
        for (int id = 1; id <= 16; ++id) world.bodies.state[body_of_id(world, id)].vx = id > 8 ? 1.0 : -1.0;
        for (int id = 1; id <= 16; ++id) world.bodies.state[body_of_id(world, id)].vy = id > 8 ? -0.02 : 0.02;
        velocities_changed(world);
        for (int n = 0; n < 30000; ++n) step(world);
        ends[wide ? 1 : 0].assign(world.bodies.state.begin(), world.bodies.state.end());
    }
    for (std::size_t b = 0; b < ends[0].size(); ++b) {
        EXPECT_NEAR(ends[0][b].x, ends[1][b].x, 1e-9) << b;
        EXPECT_NEAR(ends[0][b].y, ends[1][b].y, 1e-9) << b;
    }
}

}  // namespace
}  // namespace crackle::across_joint_test
