// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of faces are the gradient of the energy for any rotation, and conserve momentum. That uniform strain balances
// every cell is a claim (tests/bench/verify/faces).

#include "solver/faces/face_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/geometry/face_motion.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

using testing::agrees;
using testing::within;

constexpr double nu = 0.26;

/// A small box whose cells have moved and turned at random by large amounts.
struct Disturbed {
    CellWorld cells;
};

Disturbed disturbed(double shear_ratio, bool broken) {
    CellBox box{.columns = 4, .rows = 4, .platens = true};
    Disturbed d{build_box(box)};
    FaceBonding bonding = elastic_rock(d.cells, box.gap, nu, shear_ratio);
    bonding.platens = PlatenFaces::glued;
    d.cells.world.faces = bond_faces(d.cells.world, bonding);
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (BodyState& body : d.cells.world.bodies.state) {
        body.x += 0.1 * number();
        body.y += 0.1 * number();
        const double turn = 2.0 + 0.3 * number();  // a large common rotation and smaller differences
        body.angle += turn;
        const double c = body.shape[0] * std::cos(turn) - body.shape[1] * std::sin(turn);
        body.shape[1] = body.shape[1] * std::cos(turn) + body.shape[0] * std::sin(turn);
        body.shape[0] = c;
    }
    if (broken) {
        compute_face_forces(d.cells.world);
        for (FaceLaw& law : d.cells.world.faces.laws) law.cohesion = law.tensile_strength = 0.0;
    }
    return d;
}

TEST(FaceMotion, IsContinuousOverTwoTurns) {
    const FacePlace place{
        .normal_i = {1.0, 0.0}, .normal_j = {1.0, 0.0}, .arm_i = {0.5, 0.2}, .arm_j = {-0.4, 0.1}, .rest_turn = 0.0};
    const auto body = [](double x, double angle) {
        BodyState state{};
        state.x = x;
        state.angle = angle;
        state.shape[0] = std::cos(angle);
        state.shape[1] = std::sin(angle);
        return state;
    };
    constexpr double step = 1e-3, first = -13.0;
    const BodyState i = body(0.0, 0.3);
    BondFaceMotion last = motion_of(place, i, body(1.0, 0.3 + first));
    double jump = 0.0, error = 0.0;
    for (double turn = first + step; turn < -first; turn += step) {
        const BondFaceMotion now = motion_of(place, i, body(1.0, 0.3 + turn));
        error = std::max(error, norm(now.normal - Vec2{std::cos(0.3 + 0.5 * turn), std::sin(0.3 + 0.5 * turn)}));
        jump = std::max({jump, std::abs(now.opening - last.opening), std::abs(now.sliding - last.sliding)});
        last = now;
    }
    EXPECT_TRUE(within("normal less that turned by half of the relative rotation, -13 to 13 rad", error, 0.0, 1e-12));
    // The gap is at most 2.1 m long and turns by half a step; the arm of body j turns by a whole one.
    EXPECT_LT(jump, 2.0 * step) << "m, largest change of opening or sliding in a step";
}

TEST(FaceForces, AreTheGradientOfTheEnergyForAnyRotation) {
    for (const double ratio : {1.0, 1.0 / 1.6}) {
        Disturbed d = disturbed(ratio, false);
        compute_face_forces(d.cells.world);
        const Array<BodyForce> forces = d.cells.world.bodies.force;
        double scale = 0.0, error = 0.0, turning = 0.0;
        for (const BodyForce& one : forces) scale = std::max(scale, std::hypot(one.fx, one.fy));
        constexpr double step = 1e-6;
        for (BodyIndex b = 0; b < forces.size(); ++b) {
            const BodyState kept = d.cells.world.bodies.state[b];
            const auto energy_at = [&](double x, double y, double turn) {
                BodyState& body = d.cells.world.bodies.state[b];
                body = kept;
                body.x += x, body.y += y, body.angle += turn;
                body.shape[0] = kept.shape[0] * std::cos(turn) - kept.shape[1] * std::sin(turn);
                body.shape[1] = kept.shape[1] * std::cos(turn) + kept.shape[0] * std::sin(turn);
                compute_face_forces(d.cells.world);
                const double energy = face_energy(d.cells.world.faces);
                body = kept;
                return energy;
            };
            const auto slope = [&](double x, double y, double turn) {
                return -(energy_at(step * x, step * y, step * turn) - energy_at(-step * x, -step * y, -step * turn)) /
                       (2.0 * step);
            };
            error = std::max({error, std::abs(forces[b].fx - slope(1, 0, 0)), std::abs(forces[b].fy - slope(0, 1, 0))});
            turning = std::max(turning, std::abs(forces[b].torque - slope(0, 0, 1)));
        }
        EXPECT_TRUE(within("force less the slope of the energy, of the largest force", error / scale, 0.0, 1e-8));
        EXPECT_TRUE(within("moment less the slope, of that force, m", turning / scale, 0.0, 1e-8));
    }
}

TEST(FaceForces, OfLanesHaveTheBytesOfSingleFaces) {
    for (const double damping : {0.0, 0.2}) {
        CellBox box{.columns = 7, .rows = 7, .platens = true};
        CellWorld cells = build_box(box, 3);
        FaceBonding bonding = elastic_rock(cells, box.gap, nu, 1.0 / 1.6);
        bonding.materials[1].moduli.contact *= 2.0;
        bonding.platens = PlatenFaces::bonded;
        for (FaceMaterial& material : bonding.materials) material.law.damping_ratio = damping;
        Faces& faces = cells.world.faces = bond_faces(cells.world, bonding);
        std::mt19937 random(7);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
        for (BodyState& body : cells.world.bodies.state) {
            body.x += 0.01 * number(), body.y += 0.01 * number(), body.angle += 0.1;
            body.shape[0] = std::cos(0.1), body.shape[1] = std::sin(0.1);
            body.vx = number(), body.vy = number(), body.omega = number();
        }
        compute_face_forces(cells.world);
        int unlike = 0;
        for (FaceIndex k = 0; k < faces.size(); ++k) {
            const BodyState &i = cells.world.bodies.state[faces.bodies[k].body_i],
                            &j = cells.world.bodies.state[faces.bodies[k].body_j];
            const BondFaceMotion m = motion_of(faces.place[k], i, j), got = faces.motion[k];
            FaceForces f = intact_forces(faces.springs[k], m, faces.pressure_at(k), faces.skewing_at(k));
            if (faces.damped()) {
                const FaceRates<double> rate = rates_of(faces.place[k], m, i, j);
                const FaceDashpots c = faces.dashpots[k];
                f.normal += c.normal * rate.opening;
                f.shear += c.shear * rate.sliding;
                f.moment += c.moment * rate.turn;
            }
            const PointForce expected = forces_on_bodies(faces.place[k], m, i, j, f), force_got = faces.force[k];
            if (m.opening != got.opening || m.sliding != got.sliding || m.normal != got.normal || m.turn != got.turn ||
                expected.fx != force_got.fx || expected.fy != force_got.fy || expected.torque_i != force_got.torque_i ||
                expected.torque_j != force_got.torque_j)
                ++unlike;
        }
        EXPECT_EQ(unlike, 0) << "of " << faces.size() << " faces";
    }
}

TEST(FaceForces, HaveNoResultantAndNoMoment) {
    for (const bool broken : {false, true}) {
        Disturbed d = disturbed(1.0 / 1.6, broken);
        compute_face_forces(d.cells.world);
        EXPECT_EQ(d.cells.world.faces.broken.size(), broken ? d.cells.world.faces.size() : 0u);
        BodyForce sum{};
        double scale = 0.0;
        for (BodyIndex b = 0; b < d.cells.world.bodies.size(); ++b) {
            const BodyForce& one = d.cells.world.bodies.force[b];
            const BodyState& body = d.cells.world.bodies.state[b];
            scale = std::max(scale, std::hypot(one.fx, one.fy));
            sum.fx += one.fx, sum.fy += one.fy;
            sum.torque += one.torque + body.x * one.fy - body.y * one.fx;
        }
        EXPECT_TRUE(within("resultant of the largest force", std::hypot(sum.fx, sum.fy) / scale, 0.0, 1e-13));
        EXPECT_TRUE(within("moment of that force, m", sum.torque / scale, 0.0, 1e-13));
    }
}

TEST(FaceForces, OfBrokenFacesAreContinuousWhereABodyHasTurnedByHalfATurn) {
    Disturbed d = disturbed(1.0, true);
    World& world = d.cells.world;
    compute_face_forces(world);
    ASSERT_EQ(world.faces.broken.size(), world.faces.size());
    BodyState& body = world.bodies.state[world.faces.bodies[0].body_j];
    const double angle = body.angle - world.faces.motion[0].turn;  // without rotation relative to body i
    const auto motion_at = [&](double turn) {
        body.angle = angle + turn;
        body.shape[0] = std::cos(body.angle), body.shape[1] = std::sin(body.angle);
        compute_face_forces(world);
        return BondFaceMotion{world.faces.motion[0]};
    };
    constexpr double step = 1e-3;
    const BondFaceMotion before = motion_at(std::numbers::pi - step), after = motion_at(std::numbers::pi + step);
    EXPECT_TRUE(within("rotation of the normal, half of that of the body", norm(after.normal - before.normal), step,
                       1e-6 * step));
    EXPECT_LT(std::abs(after.opening - before.opening), 4.0 * step) << "m; cells are about a metre wide";
}

TEST(FaceForces, AreNoneAfterARigidMotionThroughAnyAngle) {
    CellBox box{.columns = 5, .rows = 5};
    CellWorld cells = build_box(box);
    cells.world.faces = bond_faces(cells.world, elastic_rock(cells, box.gap, nu, 1.0 / 1.6));
    for (const double turn : {0.3, 2.5}) {
        for (BodyState& body : cells.world.bodies.state) {
            const double c = std::cos(turn), s = std::sin(turn);
            body.angle += turn;
            const Vec2 place{c * body.x - s * body.y + 0.3, s * body.x + c * body.y - 0.2};
            const Vec2 frame{c * body.shape[0] - s * body.shape[1], s * body.shape[0] + c * body.shape[1]};
            body.x = place.x, body.y = place.y, body.shape[0] = frame.x, body.shape[1] = frame.y;
        }
        compute_face_forces(cells.world);
        double largest = 0.0;
        for (const BodyForce& one : cells.world.bodies.force) largest = std::max(largest, std::hypot(one.fx, one.fy));
        // k_n h is some E L, with E = 1.
        EXPECT_TRUE(within("largest force after a rigid motion, N", largest, 0.0, 1e-13));
    }
}

}  // namespace
}  // namespace crackle::verification
