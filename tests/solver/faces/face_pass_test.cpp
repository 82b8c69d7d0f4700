// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of faces: uniform strain balances every cell, forces are the gradient of the energy for any rotation, and they
// conserve momentum.

#include "solver/faces/face_pass.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/geometry/face_motion.hpp"
#include "tests/solver/faces/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::face_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double nu = 0.26;

void force(World& world) {
    std::ranges::fill(world.bodies.force, BodyForce{});
    add_face_forces(world);
}

/// Number of faces between each cell and the nearest cell with less than a full ring of faces.
std::vector<int> depths(const World& world, const Faces& faces) {
    std::vector<double> open(world.bodies.size(), 0.0);
    std::vector<Vec2> closing(world.bodies.size());
    for (FaceIndex k = 0; k < faces.size(); ++k) {
        const Vec2 normal = faces.springs[k].length * faces.place[k].normal_i;
        closing[faces.bodies[k].body_i] = closing[faces.bodies[k].body_i] + normal;
        closing[faces.bodies[k].body_j] = closing[faces.bodies[k].body_j] - normal;
    }
    constexpr int far = 1000;
    std::vector<int> depth(world.bodies.size(), far);
    for (std::size_t b = 0; b < depth.size(); ++b)
        if (norm(closing[b]) > 1e-9) depth[b] = 0;
    for (int round = 0; round < 20; ++round)
        for (const BodyPair& pair : faces.bodies) {
            depth[pair.body_i] = std::min(depth[pair.body_i], depth[pair.body_j] + 1);
            depth[pair.body_j] = std::min(depth[pair.body_j], depth[pair.body_i] + 1);
        }
    return depth;
}

void expect_patch(CellWorld cells, const FaceBonding& bonding) {
    FaceQuality quality;
    Faces& faces = cells.world.faces = bond_faces(cells.world, bonding, &quality);
    EXPECT_LE(quality.raised, 4);                // two right triangles in a corner of the box have one circumcentre
    const double xx = 0.3, yy = -0.1, xy = 0.2;  // no rotation: forces are then linear in the strain
    const auto strain = [&](double by) {
        for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b) {
            BodyState& body = cells.world.bodies.state[b];
            const Vec2 x = cells.seeds[b];
            body.x += by * (xx * x.x + xy * x.y);
            body.y += by * (xy * x.x + yy * x.y);
        }
        force(cells.world);
        return cells.world.bodies.force;
    };
    // Moments are linear and quadratic: forces act in the middle of what has opened.
    const Array<BodyForce> forces = strain(1.0);
    const Array<double> pressures = [&] {
        Array<double> all;
        for (const CellPressure& cell : faces.cells) all.push_back(cell.pressure);
        return all;
    }();
    double largest = 0.0;
    for (const PointForce& one : faces.force) largest = std::max(largest, std::hypot(one.fx, one.fy));
    const Array<BodyForce> opposite = strain(-2.0);
    const FaceModuli& moduli = bonding.materials[0].moduli;
    const std::vector<int> depth = depths(cells.world, faces);
    double residual = 0.0, moment = 0.0, pressure = 0.0;
    int inner = 0;
    for (BodyIndex b = 0; b < depth.size(); ++b) {
        if (depth[b] < 2) continue;
        ++inner;
        residual = std::max(residual, std::hypot(forces[b].fx, forces[b].fy));
        moment = std::max(moment, 0.5 * std::abs(forces[b].torque - opposite[b].torque));
        pressure = std::max(pressure, std::abs(pressures[b] - moduli.pressure * (xx + yy)));
    }
    EXPECT_GT(inner, 20);
    EXPECT_TRUE(within("force on a cell over the largest force of a face", residual / largest, 0.0, 1e-12));
    // The lever is some tenth of the cells, which are some tenth of a metre.
    EXPECT_TRUE(within("moment on a cell over the same, m", moment / largest, 0.0, 1e-12));
    EXPECT_TRUE(within("pressure of a cell, of its modulus", pressure / moduli.pressure, 0.0, 1e-12));
}

TEST(PatchOfFaces, BalancesEveryVoronoiCell) {
    const CellWorld cells = build_box({});
    expect_patch(cells, elastic_rock(cells, CellBox{}.gap, nu, 1.0));
}

TEST(PatchOfFaces, BalancesEveryCircumcentredTriangle) {
    CellBox box{.kind = MeshKind::delaunay};
    std::vector<Point> seeds;  // of nearly equilateral triangles
    std::mt19937 random(2);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    constexpr int rows = 14;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < rows; ++c) {
            const double x = c + (r % 2 == 0 ? 0.25 : 0.75) + 0.15 * number();
            seeds.push_back({x / rows, (r + 0.5 + 0.15 * number()) / rows});
        }
    MeshRequest request;
    request.kind = MeshKind::delaunay;
    request.mesh_gap = box.gap;
    CellWorld cells = world_of(box, make_mesh(seeds, {0.0, 1.0, 0.0, 1.0}, request), seeds);
    FaceBonding bonding = elastic_rock(cells, box.gap, nu, 1.0);
    bonding.reference.clear();  // circumcentres
    bonding.least_distance_share = 1e-3;
    // The circumcentres, by the edges before the inset.
    for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b) {
        const BodyState& body = cells.world.bodies.state[b];
        const BodyInfo info = cells.world.bodies.info(b);
        Vec2 p[3];
        for (std::uint32_t e = 0; e < 3; ++e) {
            const Element& corner = cells.world.bodies.elements[info.first_element + e];
            p[e] = {corner.x, corner.y};
        }
        // The incircle shrinks by the inset, and the triangle about its centre with it.
        const double a = norm(p[2] - p[1]), bb = norm(p[0] - p[2]), c = norm(p[1] - p[0]);
        const Vec2 centre = (1.0 / (a + bb + c)) * (a * p[0] + bb * p[1] + c * p[2]);
        const double inner = std::abs(cross(p[1] - p[0], p[2] - p[0])) / (a + bb + c);
        for (Vec2& corner : p) corner = centre + (1.0 + 0.5 * box.gap / inner) * (corner - centre);
        const Vec2 u = p[1] - p[0], v = p[2] - p[0];
        const double scale = 0.5 / cross(u, v);
        cells.seeds[b] = Vec2{body.x, body.y} + p[0] +
                         scale * Vec2{v.y * dot(u, u) - u.y * dot(v, v), u.x * dot(v, v) - v.x * dot(u, u)};
    }
    expect_patch(cells, bonding);
}

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
        force(d.cells.world);
        for (FaceLaw& law : d.cells.world.faces.laws) law.cohesion = law.tensile_strength = 0.0;
    }
    return d;
}

TEST(FaceForces, AreTheGradientOfTheEnergyForAnyRotation) {
    for (const double ratio : {1.0, 1.0 / 1.6}) {
        Disturbed d = disturbed(ratio, false);
        force(d.cells.world);
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
                force(d.cells.world);
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
        force(cells.world);
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
        force(d.cells.world);
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
        force(cells.world);
        double largest = 0.0;
        for (const BodyForce& one : cells.world.bodies.force) largest = std::max(largest, std::hypot(one.fx, one.fy));
        // k_n h is some E L, with E = 1.
        EXPECT_TRUE(within("largest force after a rigid motion, N", largest, 0.0, 1e-13));
    }
}

}  // namespace
}  // namespace crackle::face_test
