// SPDX-License-Identifier: GPL-3.0-or-later
// A bonded specimen free in space: what it must keep (momentum, angular momentum, energy, its bonds), what must not
// pull at it (a rigid motion), and that leapfrog runs backwards.

#include <cmath>
#include <numbers>

#include "specimens/catalogue/disordered.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/measures.hpp"

namespace crackle {
namespace {

using testing::breaking_energy;
using testing::momentum_error;
using testing::momentum_of;
using testing::rock;
using testing::within;

enum class Kind { discs, polygons };
const char* name_of(Kind kind) { return kind == Kind::discs ? "discs" : "polygons"; }

/// Around the origin. Polygons: gap 1 mm, bonded with 1.08 mm, so that faces overlap by 0.08 mm.
World specimen(Kind kind, double friction_angle, double step_share = 0.5, IntactOptions intact = {}) {
    Scene scene;
    if (kind == Kind::discs) {
        DisorderedDiscs request;
        request.columns = 9, request.rows = 10;
        scene = disordered_discs(request, rock(friction_angle));
        for (CircleElement& circle : scene.circles) circle.centre = circle.centre - Vec2{0.16, 0.16};
    } else {
        ShakenCells request;
        request.columns = 6, request.rows = 6;
        scene = shaken_cells(request, rock(friction_angle));
        for (Vec2& corner : scene.vertices) corner = corner - Vec2{0.12, 0.12};
    }
    scene.safety_factor = step_share;
    scene.intact = intact;
    World world = build_world(std::move(scene));
    bond_all(world, 1.08e-3);
    // Bonding has widened the reach of the polygons, so the bound was found anew; the same step for all.
    world.automatic_step = false;
    world.time_step = step_share * world.step_bound;
    return world;
}

struct Drift {
    double momentum, energy;  // largest relative errors
    std::int64_t broken;
    bool slid;
};

Drift shaken_run(Kind kind, double step_share, int steps) {
    World world = specimen(kind, 27.0, step_share);
    const double energy = 1e-4 * breaking_energy(world);
    testing::shake(world, energy, 11);
    const testing::Momentum start = momentum_of(world);
    Drift worst{0.0, 0.0, 0, false};
    for (int n = 0; n < steps; ++n) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        worst.energy = std::max(worst.energy, std::abs(ledger.kinetic + ledger.strain - energy) / energy);
        advance(world);
        worst.momentum = std::max(worst.momentum, momentum_error(start, momentum_of(world)));
    }
    worst.broken = world.bonds_broken;
    for (const ContactPoint& point : world.points) worst.slid = worst.slid || (point.flags & point_slid) != 0;
    return worst;
}

TEST(FreeBondedSpecimen, ShakenKeepsMomentumEnergyAndItsBonds) {
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        const Drift coarse = shaken_run(kind, 0.4, 2000), fine = shaken_run(kind, 0.1, 8000);
        const double order = 0.5 * std::log2(coarse.energy / fine.energy);
        fmt::print(
            "  {}: momenta {:.2g} and {:.2g}; energy {:.3g} at 0.4 of the bound, {:.3g} at 0.1, order {:.2f}; "
            "slid: {}\n",
            name_of(kind), coarse.momentum, fine.momentum, coarse.energy, fine.energy, order, coarse.slid);
        EXPECT_EQ(coarse.broken, 0) << name_of(kind);
        EXPECT_EQ(fine.broken, 0) << name_of(kind);
        EXPECT_LT(coarse.momentum, 1e-12) << name_of(kind);
        EXPECT_LT(fine.momentum, 1e-12) << name_of(kind);
        EXPECT_LT(coarse.energy, 0.1) << name_of(kind);
        EXPECT_GT(order, 1.8) << name_of(kind);
        EXPECT_LT(order, 2.2) << name_of(kind);
    }
}

/// Largest spring force after a full turn imposed in equal steps about the origin, over k_n times the mean overlap.
double force_after_turn(Kind kind, int steps, std::int64_t& broken) {
    World world = specimen(kind, 27.0);
    const std::vector<BodyState> start = world.bodies;
    const double by = 2.0 * std::numbers::pi / steps, dt = world.time_step;
    double worst = 0.0;
    compute_forces(world);
    for (int n = 1; n <= steps; ++n) {
        const double c = std::cos(by * n), s = std::sin(by * n);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            BodyState& body = world.bodies[b];
            const double x = c * start[b].x - s * start[b].y, y = s * start[b].x + c * start[b].y;
            body.vx = (x - body.x) / dt;
            body.vy = (y - body.y) / dt;
            body.omega = by / dt;
            body.x = x;
            body.y = y;
            body.angle = start[b].angle + by * n;
            if (!world.info[b].single_circle) {
                body.shape[0] = c;
                body.shape[1] = s;
            }
        }
        world.drift = dt;
        world.list_valid = n % 16 != 0;  // the list is found anew along the way
        world.forces_current = false;
        compute_forces(world);
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            if ((world.points[k].flags & point_bonded) == 0) continue;
            const PointView view = view_point(world, k);
            worst = std::max({worst, std::abs(view.normal_force), std::abs(view.shear_force)});
        }
    }
    broken = world.bonds_broken;
    return worst / (1e7 * 8e-5);
}

TEST(FreeBondedSpecimen, TurnedRigidlyByAFullTurnFeelsNoForce) {
    // A step of angle α leads each centroid along its chord. Seen from the contact, the chord's slip is that of the
    // exact turn up to (sin α - α)·D, D the distance of the centroids along the normal: α³D/6 a step, so πα²D/3 in a
    // full turn.
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        std::int64_t broken_coarse = 0, broken_fine = 0;
        const double coarse = force_after_turn(kind, 4000, broken_coarse);
        const double fine = force_after_turn(kind, 16000, broken_fine);
        const double by = 2.0 * std::numbers::pi / 16000, reach = 0.08;
        const double estimate = 2.5e6 * std::numbers::pi * by * by * reach / 3.0 / (1e7 * 8e-5);
        const double order = 0.5 * std::log2(coarse / fine);
        fmt::print(
            "  {}: largest force over mean strength {:.3g} in 4000 steps, {:.3g} in 16000 (estimate {:.3g}), order "
            "{:.2f}\n",
            name_of(kind), coarse, fine, estimate, order);
        EXPECT_EQ(broken_coarse + broken_fine, 0) << name_of(kind);
        EXPECT_LT(fine, estimate) << name_of(kind);
        EXPECT_GT(order, 1.9) << name_of(kind);
    }
}

/// Largest spring force of a specimen spinning freely from rest shape, N, averaged over a while.
double spinning_force(Kind kind, double spin) {
    World world = specimen(kind, 27.0, 0.2);
    for (BodyState& body : world.bodies) {
        body.vx = -spin * body.y;
        body.vy = spin * body.x;
        body.omega = spin;
    }
    double largest = 0.0;
    for (int n = 0; n < 4000; ++n) {
        step(world);
        compute_forces(world);
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            const PointView view = view_point(world, k);
            largest = std::max({largest, std::abs(view.normal_force), std::abs(view.shear_force)});
        }
    }
    EXPECT_EQ(world.bonds_broken, 0) << name_of(kind);
    return largest;
}

TEST(FreeBondedSpecimen, SpinningSlowlyFeelsTheCentripetalForceAlone) {
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        const double slow = spinning_force(kind, 0.05), fast = spinning_force(kind, 0.1);
        // Twice the pull ρω²R²/2 over a disc's width is the most that a sudden start can overshoot to.
        const double pull = 2500.0 * 0.01 * 0.17 * 0.17 / 2.0 * 0.04;
        fmt::print("  {}: {:.4g} N at 0.05 rad/s, {:.4g} N at 0.1 (ratio {:.4f}), centripetal pull about {:.3g} N\n",
                   name_of(kind), slow, fast, fast / slow, pull);
        EXPECT_NEAR(fast / slow, 4.0, 0.02) << name_of(kind);
        EXPECT_LT(fast, 3.0 * pull) << name_of(kind);
    }
}

TEST(FreeBondedSpecimen, FrictionlessRunsBackwardsToItsStart) {
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        World world = specimen(kind, 0.0);
        testing::shake(world, 1e-4 * breaking_energy(world), 12);
        const std::vector<BodyState> start = world.bodies;
        const int steps = 2000;
        for (int n = 0; n < steps; ++n) step(world);
        double way = 0.0, off = 0.0;
        for (std::size_t b = 0; b < start.size(); ++b)
            way = std::max(way, std::hypot(world.bodies[b].x - start[b].x, world.bodies[b].y - start[b].y));
        compute_forces(world);
        for (std::size_t b = 0; b < start.size(); ++b) {
            BodyState& body = world.bodies[b];
            const BodyInertia& inertia = world.inertia[b];
            body.vx = -(body.vx + world.time_step * inertia.inverse_mass_x * world.forces[b].fx);
            body.vy = -(body.vy + world.time_step * inertia.inverse_mass_y * world.forces[b].fy);
            body.omega = -(body.omega + world.time_step * inertia.inverse_moment * world.forces[b].torque);
        }
        for (int n = 0; n < steps; ++n) step(world);
        for (std::size_t b = 0; b < start.size(); ++b)
            off = std::max(off, std::hypot(world.bodies[b].x - start[b].x, world.bodies[b].y - start[b].y));
        fmt::print("  {}: {:.3g} m away after {} steps, {:.3g} m off after going back\n", name_of(kind), way, steps,
                   off);
        EXPECT_GT(way, 1e-6) << name_of(kind);
        EXPECT_LT(off / way, 1e-8) << name_of(kind);
        EXPECT_LT(off, 1e-10 * 0.04) << name_of(kind);
    }
}

TEST(Bond, SqueezedToTenTimesItsStrengthHolds) {
    Scene scene;
    scene.materials = {rock()};
    scene.materials[0].damping_ratio = 0.3;
    scene.domain.wall_present = {false, false, false, false};
    const double overlap = 1e-4;
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    scene.add_circle_body(2, 0, {{0.04 - overlap, 0.0}, 0.02, 0.0});
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({1, {Drive::displacement, -10.0 * overlap}, held, {}, 20000});
    World world = build_world(scene);
    ASSERT_EQ(bond_all(world, 0.0), 1);
    for (int n = 0; n < 25000; ++n) step(world);
    compute_forces(world);
    const BodyIndex fixed = body_of_id(world, 1);
    EXPECT_TRUE(
        testing::agrees("squeezing force over strength", -world.forces[fixed].fx / (1e7 * overlap), 10.0, 1e-9));
    EXPECT_EQ(world.bonds_broken, 0);
    EXPECT_TRUE(world.events.empty());
}

TEST(Bond, OfVanishingStrengthEqualsNoBond) {
    // A disc thrown against another that it barely touches: bonded with an overlap of 1e-9 of its radius, or not
    // bonded.
    const auto rebound = [](bool bonded) {
        Scene scene;
        scene.materials = {rock()};
        scene.domain.wall_present = {false, false, false, false};
        scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
        scene.add_circle_body(2, 0, {{0.04 - 2e-11, 0.0}, 0.02, 0.0});
        scene.bodies[0].velocity = {0.01, 0.003};
        scene.bodies[1].spin = 0.2;
        scene.safety_factor = 0.02;
        World world = build_world(scene);
        if (bonded) {
            EXPECT_EQ(bond_all(world, 0.0), 1);
        }
        for (int n = 0; n < 1000; ++n) step(world);
        EXPECT_EQ(world.bonds_broken, bonded ? 1 : 0);
        return world.bodies;
    };
    const std::vector<BodyState> with = rebound(true), without = rebound(false);
    for (std::size_t b = 0; b < 2; ++b) {
        EXPECT_TRUE(within("velocity along", with[b].vx, without[b].vx, 1e-7));
        EXPECT_TRUE(within("velocity across", with[b].vy, without[b].vy, 1e-7));
        EXPECT_TRUE(within("spin times radius", 0.02 * with[b].omega, 0.02 * without[b].omega, 1e-7));
    }
}

}  // namespace
}  // namespace crackle
