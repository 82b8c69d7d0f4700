// SPDX-License-Identifier: GPL-3.0-or-later
// Tests changes of laws and bonds while a world runs, with two discs of which one is driven away from the other.

#include "solver/stepping/change_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::change_law_test {
namespace {

using testing::agrees;
using testing::refusal;

constexpr double radius = 0.02, overlap = 1e-5, stiffness = 1e7;

/// Two unbonded discs; the right one is driven away by 1e-4 of the overlap per step. The left one is held, or free if
/// the time step is to be automatic.
World parting_pair(BondLaw law = BondLaw::back_tension, double gap = 0.0, bool free = false) {
    Scene scene;
    scene.materials = {undamped_rock(stiffness, 27.0)};
    scene.materials[0].damping_ratio = 0.2;
    if (law == BondLaw::coulomb) {
        scene.materials[0].tensile_strength = 20.0;
        scene.materials[0].cohesion = 50.0;
    }
    scene.bond_law = law;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    scene.skin = 0.01;
    scene.add_circle_body(4, 0, {{0.0, 0.0}, radius, 0.0});
    scene.add_circle_body(9, 0, {{2.0 * radius - overlap + gap, 0.0}, radius, 0.0});
    const DofControl still{Drive::velocity, 0.0};
    scene.controls = {{1, still, still, still, 0}};
    if (!free) {
        scene.controls.push_back({0, still, still, {}, 0});
        scene.time_step = 1e-5;
    }
    World world = build_world(scene);
    change_velocity(world, body_of_id(world, 9), 0, 1e-4 * overlap / world.stepping.time_step);
    return world;
}

const BodyPair both{0, 1};

TEST(BondPairs, ABondAddedWhileAWorldRunsIsWithoutForceAndAsStrongAsItOverlaps) {
    World world = parting_pair();
    for (int n = 0; n < 2000; ++n) step(world);
    const double left = 0.8 * overlap;
    EXPECT_TRUE(agrees("force before, N", view_point(world, 0).normal_force, stiffness * left, 1e-9));
    EXPECT_EQ(bond_pairs(world, {&both, 1}, 0.0), 1);
    EXPECT_EQ(bond_pairs(world, {&both, 1}, 0.0), 0) << "has a bond";
    EXPECT_EQ(world.bonds.initial, 1);
    EXPECT_EQ(world.bonds.interfaces_initial, 1);
    compute_forces(world);
    EXPECT_EQ(view_point(world, 0).normal_force, 0.0);
    for (int n = 0; n < 7990; ++n) step(world);
    EXPECT_TRUE(
        agrees("pull before it breaks, N", view_point(world, 0).normal_force, -stiffness * 7990e-4 * overlap, 1e-6));
    EXPECT_EQ(world.bonds.broken, 0);
    for (int n = 0; n < 20; ++n) step(world);
    ASSERT_EQ(world.bonds.broken, 1);
    EXPECT_TRUE(agrees("strength, N", world.bonds.events[0].strength, stiffness * left, 1e-9));
    EXPECT_EQ(world.bonds.interfaces_lost, 1);
    // The work of the drive equals the energy stored in the bond, ½ k δ0², up to the work of the last step.
    const Ledger ledger = measure_ledger(world);
    EXPECT_TRUE(agrees("fracture, J", world.account.fracture_loss, 0.5 * stiffness * left * left, 1e-3));
    EXPECT_TRUE(testing::within("closing error, J", ledger.closing_error, 0.0, 1e-3 * 0.5 * stiffness * left * left));
}

TEST(BondPairs, GapsAreBondedAsFarAsAsked) {
    World world = parting_pair(BondLaw::coulomb, 3.0 * overlap);
    EXPECT_EQ(bond_pairs(world, {&both, 1}, 1.9 * overlap), 0);
    EXPECT_EQ(bond_pairs(world, {&both, 1}, 2.1 * overlap), 1);
    for (int n = 0; n < 1900; ++n) step(world);
    EXPECT_EQ(world.bonds.broken, 0);
    EXPECT_TRUE(agrees("pull, N", view_point(world, 0).normal_force, -stiffness * 0.19 * overlap, 1e-3));
    for (int n = 0; n < 200; ++n) step(world);
    EXPECT_EQ(world.bonds.broken, 1) << "at 20 N, after 2000 steps";
    EXPECT_NE(refusal([&] {
                  bond_pairs(world, std::array{BodyPair{1, 1}}, 0.0);
              }).find("body 9 twice"),
              std::string::npos);
}

/// Two squares face to face, one of them held; a face has four points.
World two_squares() {
    Scene scene;
    scene.materials = {undamped_rock(stiffness, 27.0)};
    scene.materials[0].tensile_strength = 20.0;
    scene.materials[0].cohesion = 50.0;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.thick = 1.1e-3;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    const auto add = [&](int id, double low) {
        scene.add_chain_body(id, 0, {{0.0, low}, {0.1, low}, {0.1, low + 0.1}, {0.0, low + 0.1}}, true);
    };
    add(4, 0.0);
    add(9, 0.101);
    return build_world(scene);
}

TEST(BondPairs, OfAFaceShareItAndLeaveTheBondsThatItHasAlone) {
    World world = two_squares();
    ASSERT_EQ(bond_pairs(world, {&both, 1}, 0.0), 4);
    double shares = 0.0;
    for (const float share : world.points.strength_share) shares += share;
    // Extended by half the gap of 1e-3 m at either end, as before the inset of a mesh.
    EXPECT_TRUE(agrees("length of the face, m", shares, 0.101, 1e-6));
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        world.points.state[k].flags = point_touching;  // as after a break
        break;
    }
    const Array<float> before = world.points.strength_share;
    EXPECT_NE(refusal([&] {
                  bond_pairs(world, {&both, 1}, 0.0);
              }).find("intact bonds on the face between bodies 4 and 9"),
              std::string::npos);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(world.points.strength_share[k], before[k]);
}

TEST(BondPairs, RefuseAGapUnderBackTension) {
    World world = parting_pair(BondLaw::back_tension, 3.0 * overlap);
    EXPECT_NE(refusal([&] {
                  bond_pairs(world, {&both, 1}, 2.1 * overlap);
              }).find("bond.law = \"coulomb\""),
              std::string::npos);
    EXPECT_EQ(world.bonds.initial, 0);
    EXPECT_EQ(bond_pairs(world, {&both, 1}, 0.0), 0) << "do not touch";
}

TEST(ChangeLaw, IsTheLawOfAWorldBuiltWithIt) {
    World changed = parting_pair(BondLaw::coulomb, 0.0, true);
    bond_pairs(changed, {&both, 1}, 0.0);
    const double before = changed.stepping.time_step;
    change_law(changed, 0, 0, "normal_stiffness", 4.0 * stiffness);
    change_law(changed, 0, 0, "shear_stiffness", stiffness);
    change_law(changed, 0, 0, "cohesion", 80.0);
    change_law(changed, 0, 0, "tensile_strength", 30.0);
    change_law(changed, 0, 0, "friction_angle", 30.0);
    change_law(changed, 0, 0, "residual_friction_angle", 20.0);
    Material other = undamped_rock(4.0 * stiffness, 30.0);
    other.shear_stiffness = stiffness;
    other.damping_ratio = 0.2;
    other.residual_friction_angle = 20.0;
    other.tensile_strength = 30.0;
    other.cohesion = 80.0;
    Scene scene;
    scene.materials = {other};
    scene.bond_law = BondLaw::coulomb;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    scene.add_circle_body(4, 0, {{0.0, 0.0}, radius, 0.0});
    const World built = build_world(scene);
    ASSERT_EQ(changed.settings.laws.size(), built.settings.laws.size());
    for (std::size_t k = 0; k < built.settings.laws.size(); ++k) {
        const ContactLaw &got = changed.settings.laws[k], &expected = built.settings.laws[k];
        EXPECT_EQ(got.normal_stiffness, expected.normal_stiffness) << k;
        EXPECT_EQ(got.shear_stiffness, expected.shear_stiffness) << k;
        EXPECT_EQ(got.friction, expected.friction) << k;
        EXPECT_EQ(got.bond_friction, k == 1 ? got.bond_friction : expected.bond_friction) << k;
        EXPECT_EQ(got.tensile_strength, expected.tensile_strength) << k;
        EXPECT_EQ(got.cohesion, expected.cohesion) << k;
        EXPECT_TRUE(agrees("damping term", got.normal_damping_ratio_term, expected.normal_damping_ratio_term, 1e-15));
        EXPECT_TRUE(agrees("damping term", got.shear_damping_ratio_term, expected.shear_damping_ratio_term, 1e-15));
    }
    // With four times the stiffness and the same damping ratio, the time step is halved.
    EXPECT_TRUE(agrees("time step, s", changed.stepping.time_step, 0.5 * before, 1e-6));
}

TEST(ChangeLaw, RefusesWhatNoLawCanBe) {
    World world = parting_pair(), coulomb = parting_pair(BondLaw::coulomb);
    const auto says = [](World& of, std::size_t b, const char* name, double value, const char* words) {
        const double before = of.settings.laws[0].normal_stiffness;
        EXPECT_NE(refusal([&] { change_law(of, 0, b, name, value); }).find(words), std::string::npos) << name;
        EXPECT_EQ(of.settings.laws[0].normal_stiffness, before);
    };
    says(world, 0, "stiffness", 1.0, "expected one of normal_stiffness");
    says(world, 0, "normal_stiffness", 0.0, "> 0");
    says(world, 0, "normal_stiffness", std::nan(""), "found nan");
    says(world, 0, "shear_stiffness", -1.0, ">= 0");
    says(world, 0, "shear_stiffness", 0.0, "the damping ratio");
    says(world, 0, "friction_angle", 90.0, "< 90");
    says(world, 0, "cohesion", 1.0, "expected bond.law = \"coulomb\"");
    says(world, 1, "friction_angle", 20.0, "materials 1 and 2, expected 1 to 1");
    says(coulomb, 0, "tensile_strength", 1e3, "beyond the apex");
}

}  // namespace
}  // namespace crackle::change_law_test
