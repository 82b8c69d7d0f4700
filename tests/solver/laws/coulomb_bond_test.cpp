// SPDX-License-Identifier: GPL-3.0-or-later
// Tests envelope and energies of the coulomb bond (solver/MODEL.md 5.2) with two discs, one held and the other driven.

#include "solver/laws/coulomb_bond.hpp"

#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"

namespace crackle::coulomb_bond_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double radius = 0.02, overlap = 1e-7, stiffness = 1e7, shear_share = 0.25, time_step = 1e-5;
constexpr double tensile = 2.0, cohesion = 3.0;  // N; k_n δ0 is 1 N, so the bond breaks only at a gap
const double friction = std::tan(30.0 * std::numbers::pi / 180.0), residual = std::tan(20.0 * std::numbers::pi / 180.0);

Material strong_rock() {
    Material material = undamped_rock(stiffness, 30.0, shear_share);
    material.density = 1e12;
    material.residual_friction_angle = 20.0;
    material.tensile_strength = tensile;
    material.cohesion = cohesion;
    return material;
}

/// Two bonded discs side by side. The right one is driven such that the bond's forces change by these amounts per step,
/// N. The other is free to rotate, since nothing would be computed otherwise, but far too heavy to move.
World driven_pair(double normal, double shear, double gap = -overlap) {
    Scene scene;
    scene.materials = {strong_rock()};
    scene.bond_law = BondLaw::coulomb;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.time_step = time_step;
    scene.add_circle_body(4, 0, {{0.0, 0.0}, radius, 0.0});
    scene.add_circle_body(9, 0, {{2.0 * radius + gap, 0.0}, radius, 0.0});
    const DofControl still{Drive::velocity, 0.0};
    const double closing = normal / stiffness / time_step, slipping = shear / (shear_share * stiffness) / time_step;
    scene.controls = {{0, still, still, {}, 0},
                      {1, {Drive::velocity, -closing}, {Drive::velocity, slipping}, still, 0}};
    World world = build_world(scene);
    Bonding bonding;
    bonding.range = gap > 0.0 ? 2.0 * gap / radius : 0.0;
    EXPECT_EQ(bond_all(world, bonding), 1);
    return world;
}

const BreakEvent& broken(World& world, int most = 100000) {
    for (int n = 0; n < most && world.bonds.events.empty(); ++n) step(world);
    EXPECT_EQ(world.bonds.events.size(), 1U);
    return world.bonds.events.at(0);
}

/// Distance of a force beyond the envelope, N.
double excess(double normal, double shear) {
    return std::max(-tensile - normal, std::abs(shear) - cohesion - friction * normal);
}

TEST(CoulombBond, BreaksOnItsEnvelopeAtAnyAngleToFirstOrderInTheStep) {
    // The corner of the envelope is at f_n = -2, |f_t| = 3 - 2 tan 30° = 1.845, or 137.3 degrees.
    for (const double degrees : {0.0, 45.0, 90.0, 120.0, 135.0, 140.0, 180.0}) {
        const double angle = degrees * std::numbers::pi / 180.0;
        double last = 0.0;
        for (const int finer : {1, 2, 4}) {
            const double force = 0.01 / finer;  // N per step
            World world = driven_pair(force * std::cos(angle), force * std::sin(angle));
            if (degrees == 0.0) {
                for (int n = 0; n < 2000; ++n) step(world);
                EXPECT_EQ(world.bonds.broken, 0) << "squeezed to ten times its strength";
                continue;
            }
            const BreakEvent event = broken(world);
            const double beyond = excess(event.normal_force, event.shear_force);
            // The tolerance is the increase of |f_t| - μ f_n in a step, plus the rotation of the normal by the slip,
            // 1e-7 over 4 cm.
            EXPECT_TRUE(within("beyond the envelope, N", beyond, 0.0, (1.0 + friction) * force + 1e-4)) << degrees;
            EXPECT_GE(beyond, -1e-9);
            EXPECT_EQ(event.shear_mode, degrees < 137.0) << degrees;
            EXPECT_GE(event.energy, 0.0);
            last = beyond;
        }
        EXPECT_LE(last, 0.01 / 4 * (1.0 + friction) + 1e-4);
    }
}

TEST(CoulombBond, OfTwoLimitsExceededInOneStepTheFirstOnTheWayDecides) {
    const BondStrength<double> strength{2.0, 3.0, 0.5};
    // Starting at zero force, the shear limit is reached at the fraction (3 - 0.5 a)/b of the path to (-a, b), the
    // tensile limit at 2/a.
    EXPECT_TRUE(CoulombBond::shear_comes_first(strength, {0.0, 0.0}, {-4.0, 9.0}));   // 3/11 against 1/2
    EXPECT_FALSE(CoulombBond::shear_comes_first(strength, {0.0, 0.0}, {-9.0, 3.0}));  // 3/7.5 against 2/9
    EXPECT_TRUE(CoulombBond::shear_comes_first(strength, {0.0, 0.0}, {-4.0, -9.0}));
    EXPECT_FALSE(CoulombBond::shear_comes_first({1.0, 0.5, 0.5}, {0.0, 0.0}, {-3.0, 0.0}))
        << "at the apex it is tension";
}

TEST(CoulombBond, InTensionTakesTheEnergyOfItsSpring) {
    World world = driven_pair(-1e-3, 0.0);
    const BreakEvent event = broken(world);
    // The break is found within a step of the strength; the energy account of a step uses x'x instead of x².
    EXPECT_TRUE(agrees("energy, J", event.energy, 0.5 * tensile * tensile / stiffness, 2e-3));
    EXPECT_TRUE(agrees("strength, N", event.strength, tensile, 1e-7));
    for (int n = 0; n < 10; ++n) step(world);
    EXPECT_EQ(view_point(world, 0).normal_force, 0.0);
}

TEST(CoulombBond, InShearTakesTheEnergyOfItsSpringLessWhatFrictionKeeps) {
    World world = driven_pair(0.0, 1e-3);
    const BreakEvent event = broken(world);
    EXPECT_TRUE(event.shear_mode);
    EXPECT_TRUE(agrees("energy, J", event.energy, 0.5 * cohesion * cohesion / (shear_share * stiffness), 2e-3));
    EXPECT_TRUE(agrees("strength, N", event.strength, cohesion, 1e-3));
}

/// In a strong impact, a force changes its sign and reaches its limit in one step; its energy before was returned on
/// the way.
TEST(CoulombBond, TakesNothingOfAForceThatTurnedInTheStepOfItsBreak) {
    const BondStrength<double> strength{tensile, cohesion, friction};
    Law<double> law{};
    law.normal_stiffness = stiffness;
    law.shear_stiffness = shear_share * stiffness;
    law.has_shear_spring = true;
    law.friction = residual;
    const auto energy = [&](BondForces<double> before, BondForces<double> now) {
        return CoulombBond::break_bond(law, strength, before, now, now.normal / stiffness, overlap).energy;
    };
    const double of_normal = 0.5 * 0.5 * 2.5 / stiffness, of_shear = 0.5 * 1.0 * 4.0 / law.shear_stiffness;
    // The bond breaks in tension, so no force remains. The energy account of a step uses x'x instead of x², and f'f
    // instead of f².
    EXPECT_TRUE(agrees("neither, J", energy({-0.5, 1.0}, {-2.5, 4.0}), of_normal + of_shear, 1e-12));
    EXPECT_TRUE(agrees("the normal one, J", energy({0.5, 1.0}, {-2.5, 4.0}), of_shear, 1e-12));
    EXPECT_TRUE(agrees("the shear one, J", energy({-0.5, -1.0}, {-2.5, 4.0}), of_normal, 1e-12));
    EXPECT_EQ(energy({0.5, -1.0}, {-2.5, 4.0}), 0.0) << "both";
}

TEST(CoulombBond, BrokenInShearUnderPressureGoesOnPushingAndRubsAtTheResidualFriction) {
    World world = driven_pair(5e-3, 0.0);
    for (int n = 0; n < 1000; ++n) step(world);
    EXPECT_TRUE(agrees("pushes, N", view_point(world, 0).normal_force, 5.0, 1e-5));
    change_velocity(world, 1, 0, 0.0);
    change_velocity(world, 1, 1, 1e-3 / (shear_share * stiffness) / time_step);
    const BreakEvent event = broken(world);
    const double before = view_point(world, 0).normal_force;
    const double sticks = cohesion + friction * 5.0, rubs = residual * before;
    EXPECT_TRUE(agrees("strength, N", event.strength, sticks, 1e-3));
    EXPECT_TRUE(
        agrees("energy, J", event.energy, 0.5 * (sticks * sticks - rubs * rubs) / (shear_share * stiffness), 2e-3));
    compute_forces(world);
    const PointView after = view_point(world, 0);
    // The slip of 2.4e-6 m increases the distance of the centres by 7e-11 m, which is 7e-4 N.
    EXPECT_TRUE(agrees("pushes as before, N", after.normal_force, 5.0, 3e-4)) << "its rest overlap stays";
    EXPECT_TRUE(agrees("rubs, N", std::abs(after.shear_force), residual * after.normal_force, 1e-9));
    for (int n = 0; n < 100; ++n) step(world);
    compute_forces(world);
    EXPECT_TRUE(agrees("rubs on, N", std::abs(view_point(world, 0).shear_force), rubs, 1e-3));
    const Ledger ledger = measure_ledger(world);
    EXPECT_TRUE(within("closing error over the work", ledger.closing_error / ledger.displacement_work, 0.0, 1e-6));
}

TEST(CoulombBond, OfAGapFallsToWhatTheSurfacesPushWith) {
    // Bonded at a gap of 1 N / k_n. Under a compression of 0.5 N the gap is still open, so no force remains after a
    // break in shear.
    World world = driven_pair(5e-3, 0.0, overlap);
    for (int n = 0; n < 100; ++n) step(world);
    change_velocity(world, 1, 0, 0.0);
    change_velocity(world, 1, 1, 1e-3 / (shear_share * stiffness) / time_step);
    const BreakEvent event = broken(world);
    EXPECT_TRUE(event.shear_mode);
    EXPECT_TRUE(agrees("failed under, N", event.normal_force, 0.5, 1e-3));
    EXPECT_EQ(view_point(world, 0).normal_force, 0.0);
    const double shear = cohesion + friction * 0.5;
    EXPECT_TRUE(agrees("energy, J", event.energy,
                       0.5 * 0.25 / stiffness + 0.5 * shear * shear / (shear_share * stiffness), 2e-3));
}

TEST(CoulombBond, CycleBelowTheEnvelopeLosesNothing) {
    World world = driven_pair(-1e-2, 1e-2);
    for (int n = 0; n < 80; ++n) step(world);
    for (const double back : {-1.0, 1.0, -1.0}) {
        compute_forces(world);  // the slip so far is due to the previous velocity
        change_velocity(world, 1, 0, back * 1e-2 / stiffness / time_step);
        change_velocity(world, 1, 1, back * 1e-2 / (shear_share * stiffness) / time_step);
        for (int n = 0; n < 80; ++n) step(world);
    }
    compute_forces(world);
    EXPECT_EQ(world.bonds.broken, 0);
    EXPECT_EQ(world.account.friction_loss, 0.0);
    EXPECT_EQ(world.account.fracture_loss, 0.0);
    // The slip of 3e-7 m increases the distance of the centres by 1e-12 m.
    EXPECT_TRUE(within("normal force left, N", view_point(world, 0).normal_force, 0.0, 2e-5));
    EXPECT_TRUE(within("shear force left, N", view_point(world, 0).shear_force, 0.0, 2e-5));
}

/// If its strengths equal those due to its overlap, it behaves like a back-tension bond until something slips or
/// breaks.
TEST(CoulombBond, WithTheStrengthsOfItsOverlapIsABackTensionBondUntilTheFirstSlip) {
    constexpr double lattice_overlap = 8e-5;
    Scene scene = triangular_lattice(9, 9, 0.02, lattice_overlap, undamped_rock(1e7, 27.0));
    const double mu = std::tan(27.0 * std::numbers::pi / 180.0);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        scene.bodies[b].velocity = {1e-3 * std::sin(1.7 * static_cast<double>(b)),
                                    1e-3 * std::cos(2.3 * static_cast<double>(b))};
    Scene strong = scene;
    strong.bond_law = BondLaw::coulomb;
    strong.materials[0].tensile_strength = 1e7 * lattice_overlap;
    strong.materials[0].cohesion = mu * 1e7 * lattice_overlap * (1.0 + 1e-9);  // allows for round-off
    strong.materials[0].residual_friction_angle = 27.0;
    World by_overlap = build_world(scene), by_strength = build_world(strong);
    bond_all(by_overlap, 0.0);
    bond_all(by_strength, 0.0);
    for (int n = 0; n < 500; ++n) {
        step(by_overlap);
        step(by_strength);
    }
    ASSERT_EQ(by_overlap.account.friction_loss, 0.0) << "nothing has slipped";
    ASSERT_EQ(by_strength.bonds.broken, 0);
    double farthest = 0.0, fastest = 0.0;
    for (std::size_t b = 0; b < by_overlap.bodies.size(); ++b) {
        const BodyState &one = by_overlap.bodies.state[b], &other = by_strength.bodies.state[b];
        farthest = std::max(farthest, norm({one.x - other.x, one.y - other.y}));
        fastest = std::max(fastest, norm({one.vx, one.vy}));
    }
    // k(δ - δ0) and kδ - kδ0 differ by 1e-16 of kδ0 in each of 500 steps.
    EXPECT_TRUE(within("apart, m", farthest, 0.0, 1e-10 * lattice_overlap));
    EXPECT_GT(fastest, 1e-4);
}

TEST(CoulombBond, StaysTheSameWhateverTheSkinOfTheList) {
    const auto run = [](double skin) {
        Scene scene = triangular_lattice(9, 9, 0.02, 8e-5, undamped_rock(1e7, 30.0));
        scene.bond_law = BondLaw::coulomb;
        scene.skin = skin;
        scene.materials[0].tensile_strength = 300.0;
        scene.materials[0].cohesion = 400.0;
        scene.materials[0].residual_friction_angle = 20.0;
        for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
            scene.bodies[b].velocity = {2.0 * std::sin(1.7 * static_cast<double>(b)),
                                        2.0 * std::cos(2.3 * static_cast<double>(b))};
        }
        World world = build_world(scene);
        bond_all(world, 0.0);
        for (int n = 0; n < 3000; ++n) step(world);
        return world;
    };
    const World narrow = run(5e-4), wide = run(6e-3);
    ASSERT_GT(narrow.list.builds, wide.list.builds);
    ASSERT_GT(narrow.bonds.broken, 50);
    for (std::size_t b = 0; b < narrow.bodies.size(); ++b) {
        EXPECT_EQ(narrow.bodies.state[b].x, wide.bodies.state[b].x);
        EXPECT_EQ(narrow.bodies.state[b].vy, wide.bodies.state[b].vy);
    }
}

}  // namespace
}  // namespace crackle::coulomb_bond_test
