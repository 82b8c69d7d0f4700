// SPDX-License-Identifier: GPL-3.0-or-later
// The faces in the sparse solve: E and nu, beams against Timoshenko, the exact stable step and its guaranteed bound.

#include "solver/linear/face_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/faces/face_pass.hpp"
#include "solver/linear/absolute_bound.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/linear/elastic.hpp"
#include "tests/solver/faces/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::face_test {
namespace {

using testing::agrees;
using testing::within;

/// Young's modulus and Poisson's ratio of a box between platens without shear stiffness.
struct Moduli {
    double youngs, poissons;
};

Moduli moduli_of(const CellBox& box, const FaceBonding& bonding, CellWorld cells) {
    cells.world.faces = bond_faces(cells.world, bonding);
    const double shortening = 1e-3 * box.height;
    const ElasticSolution solution =
        solve_elastic(cells.world, {{cells.platens[0], {}}, {cells.platens[1], {0.0, -shortening, 0.0}}});
    // Lateral strain by regression over the reference points.
    double n = 0.0, x = 0.0, u = 0.0, xx = 0.0, xu = 0.0;
    for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b) {
        if (b == cells.platens[0] || b == cells.platens[1]) continue;
        const BodyState& body = cells.world.bodies.state[b];
        const Vec2 at = bonding.reference[b];
        const BodyMotion& m = solution.displacement[b];
        const double moved = m.x - m.rotation * (at.y - body.y);
        n += 1.0, x += at.x, u += moved, xx += at.x * at.x, xu += at.x * moved;
    }
    const double lateral = (n * xu - x * u) / (n * xx - x * x), axial = -shortening / box.height;
    return {solution.reaction[1].y / (box.width * axial), -lateral / axial};
}

TEST(FacesInTheSolve, GiveTheMaterialsModuliForEqualStiffnesses) {
    for (const double nu : {0.0, 0.26, 0.4}) {
        CellBox box{.width = 1.0, .height = 1.6, .columns = 8, .rows = 13, .platens = true};
        CellWorld cells = build_box(box);
        const Moduli got = moduli_of(box, elastic_rock(cells, box.gap, nu, 1.0), cells);
        EXPECT_TRUE(agrees("Young's modulus", got.youngs, 1.0, 1e-9));
        EXPECT_TRUE(within("Poisson's ratio", got.poissons, nu, 1e-9));
    }
}

TEST(FacesInTheSolve, GiveThemWithinAPercentForUnequalStiffnesses) {
    const double nu = 0.26;
    for (const double ratio : {1.0 / 1.6, 0.5}) {
        CellBox box{.columns = 28, .rows = 29, .platens = true};
        CellWorld cells = build_box(box);
        const Moduli got = moduli_of(box, elastic_rock(cells, box.gap, nu, ratio, 0.29), cells);
        EXPECT_TRUE(agrees("Young's modulus", got.youngs, 1.0, 0.01));
        EXPECT_TRUE(within("Poisson's ratio", got.poissons, nu, 0.01));
    }
}

TEST(FacesInTheSolve, GiveThemWithoutAPressureByTheShearRatio) {
    const double nu = 0.2;
    CellBox box{.columns = 28, .rows = 29, .platens = true};
    CellWorld cells = build_box(box);
    FaceBonding bonding = elastic_rock(cells, box.gap, nu, 1.0);
    bonding.materials[0].moduli = face_moduli_without_pressure(1.0, nu, 0.29);
    const Moduli got = moduli_of(box, bonding, cells);
    EXPECT_TRUE(agrees("Young's modulus", got.youngs, 1.0, 0.02));
    EXPECT_TRUE(within("Poisson's ratio", got.poissons, nu, 0.02));
}

TEST(FacesInTheSolve, GiveThemForTrianglesWhoseDistancesHaveAFloor) {
    const double nu = 0.26;
    CellBox box{.kind = MeshKind::delaunay, .columns = 16, .rows = 16, .lloyd = 10, .platens = true};
    CellWorld cells = build_box(box);
    FaceBonding bonding = elastic_rock(cells, box.gap, nu, 1.0);
    bonding.reference.clear();
    cells.world.faces = bond_faces(cells.world, bonding);
    const double shortening = 1e-3;
    const ElasticSolution solution =
        solve_elastic(cells.world, {{cells.platens[0], {}}, {cells.platens[1], {0.0, -shortening, 0.0}}});
    EXPECT_TRUE(agrees("Young's modulus", -solution.reaction[1].y / shortening, 1.0, 0.02));
}

/// Moment of a beam of cells whose ends, free of shear, turn against each other; over that of Timoshenko.
double bending_stiffness(int depth, double ratio, double correction) {
    const double nu = 0.26, span = 3.0;
    CellBox box{
        .width = 1.0, .height = span, .columns = depth, .rows = static_cast<int>(span * depth), .platens = true};
    CellWorld cells = build_box(box);
    cells.world.faces = bond_faces(cells.world, elastic_rock(cells, box.gap, nu, ratio, correction));
    const double turn = 1e-3;
    const BodyIndex low = cells.platens[0], high = cells.platens[1];
    // Each platen turns about the middle of its end of the beam.
    const auto about_end = [&](BodyIndex b, double y, double angle) {
        const BodyState& body = cells.world.bodies.state[b];
        return BodyMotion{-angle * (body.y - y), angle * (body.x - 0.5), angle};
    };
    const ElasticSolution solution = solve_elastic(
        cells.world, {{low, about_end(low, 0.0, -0.5 * turn)}, {high, about_end(high, span, 0.5 * turn)}});
    // Energy ½Mφ, with M = EIφ/span and I = 1/12.
    return solution.energy / (0.5 * turn * turn / (12.0 * span));
}

TEST(BeamOfFaces, BendsAsTimoshenkosForEqualStiffnesses) {
    for (const int depth : {6, 12, 24})
        EXPECT_TRUE(agrees("bending stiffness over E I/l", bending_stiffness(depth, 1.0, 0.0), 1.0, 0.005));
}

TEST(BeamOfFaces, BendsALittleTooStifflyForUnequalOnes) {
    EXPECT_TRUE(agrees("6 cells, kappa = 1/1.6", bending_stiffness(6, 1.0 / 1.6, 0.0), 1.035, 0.03));
    EXPECT_TRUE(agrees("12 cells", bending_stiffness(12, 1.0 / 1.6, 0.0), 1.013, 0.02));
    EXPECT_TRUE(agrees("24 cells", bending_stiffness(24, 1.0 / 1.6, 0.0), 1.0, 0.015));
}

TEST(FacesInTheSolve, HaveAStableStepWithAGuaranteedBoundCloseToIt) {
    for (const int lloyd : {0, 2, 20}) {
        for (const double damping : {0.0, 0.1}) {
            const CellBox box{.columns = 12, .rows = 12, .lloyd = lloyd};
            CellWorld cells = build_box(box);
            FaceBonding bonding = elastic_rock(cells, box.gap, 0.26, 1.0 / 1.6);
            bonding.materials[0].law.damping_ratio = damping;
            cells.world.faces = bond_faces(cells.world, bonding);
            const CriticalStep exact = critical_step(cells.world, ClosedPoints::touching);
            EXPECT_TRUE(exact.proved);
            const double bound = absolute_step_bound(cells.world, ClosedPoints::touching);
            // It is lowest for even cells, and with dashpots, whose largest forces are elsewhere.
            const double least = damping > 0.0 ? 0.88 : 0.9;
            EXPECT_TRUE(within("guaranteed bound over the exact step", bound / exact.root, 0.5 * (1.0 + least),
                               0.5 * (1.0 - least)));
        }
    }
}

TEST(FaceRows, AreTheForcesOfSmallMotions) {
    CellBox box{.columns = 5, .rows = 5};
    CellWorld cells = build_box(box);
    cells.world.faces = bond_faces(cells.world, elastic_rock(cells, box.gap, 0.26, 1.0 / 1.6));
    const LinearRows rows = face_rows(cells.world);
    std::vector<BodyMotion> motion;
    constexpr double small = 1e-8;
    for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b)
        motion.push_back({small * std::sin(3.0 * b), small * std::cos(5.0 * b), small * std::sin(7.0 * b)});
    std::vector<BodyMotion> expected(motion.size());
    for (const LinearRow& row : rows.rows) {
        const double stretch = row.stiffness * rows.times(row, motion);
        for (const RowEntry& entry : rows.of(row))
            component(expected[entry.body], entry.freedom) -= stretch * entry.value;
    }
    for (BodyIndex b = 0; b < motion.size(); ++b) {
        BodyState& body = cells.world.bodies.state[b];
        body.x += motion[b].x, body.y += motion[b].y, body.angle += motion[b].rotation;
        const double c = body.shape[0];
        body.shape[0] -= motion[b].rotation * body.shape[1];
        body.shape[1] += motion[b].rotation * c;
    }
    std::ranges::fill(cells.world.bodies.force, BodyForce{});
    add_face_forces(cells.world);
    double scale = 0.0, error = 0.0;
    for (BodyIndex b = 0; b < motion.size(); ++b) {
        const BodyForce& got = cells.world.bodies.force[b];
        scale = std::max(scale, std::hypot(expected[b].x, expected[b].y));
        error = std::max({error, std::abs(got.fx - expected[b].x), std::abs(got.fy - expected[b].y),
                          std::abs(got.torque - expected[b].rotation)});
    }
    EXPECT_TRUE(within("force less that of the rows, of the largest", error / scale, 0.0, 1e-6));
}

}  // namespace
}  // namespace crackle::face_test
