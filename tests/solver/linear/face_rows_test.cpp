// SPDX-License-Identifier: GPL-3.0-or-later
// The faces in the sparse solve: the modulus of triangles, and rows that are the forces of small motions. Moduli of
// Voronoi cells, beams and stable steps are claims (tests/bench/verify/faces).

#include "solver/linear/face_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/faces/face_pass.hpp"
#include "solver/linear/elastic.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

using testing::agrees;
using testing::within;

TEST(FacesInTheSolve, GiveTheModulusForTrianglesWhoseDistancesHaveAFloor) {
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

/// Compares the forces of the rows for small motions with those of the force pass. @param moved displacement of all
/// bodies to the right of the middle, m
void expect_the_forces_of_rows(CellWorld& cells, FacesWithRows which, double middle, double moved) {
    const LinearRows rows = face_rows(cells.world, which);
    std::vector<BodyMotion> motion;
    constexpr double small = 1e-8;
    for (BodyIndex b = 0; b < cells.world.bodies.size(); ++b)
        motion.push_back({small * std::sin(3.0 * b) + (cells.world.bodies.state[b].x > middle ? moved : 0.0),
                          small * std::cos(5.0 * b), small * std::sin(7.0 * b)});
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

TEST(FaceRows, AreTheForcesOfSmallMotions) {
    CellBox box{.columns = 5, .rows = 5};
    CellWorld cells = build_box(box);
    cells.world.faces = bond_faces(cells.world, elastic_rock(cells, box.gap, 0.26, 1.0 / 1.6));
    expect_the_forces_of_rows(cells, FacesWithRows::all, 0.0, 0.0);
}

// A cut through the middle, as a notch, whose faces open by ten times the other motions. Without pressures: kappa is
// (1 - 3ν)/(1 + ν).
TEST(FaceRows, LeaveOutFacesThatStartBroken) {
    CellBox box{.columns = 6, .rows = 5};
    CellWorld cells = build_box(box);
    double middle = 0.0;
    for (const BodyState& body : cells.world.bodies.state)
        middle += body.x / static_cast<double>(cells.world.bodies.size());
    FaceBonding bonding = elastic_rock(cells, box.gap, 0.26, (1.0 - 3.0 * 0.26) / 1.26);
    bonding.leaves = [&](BodyIndex i, BodyIndex j) {
        return (cells.world.bodies.state[i].x > middle) != (cells.world.bodies.state[j].x > middle);
    };
    cells.world.faces = bond_faces(cells.world, bonding);
    ASSERT_GT(cells.world.faces.broken.size(), 3U);
    const auto rows_of = [&](FacesWithRows which) { return face_rows(cells.world, which).rows.size(); };
    EXPECT_EQ(rows_of(FacesWithRows::intact) + 3 * cells.world.faces.broken.size(), rows_of(FacesWithRows::all));
    for (BrokenFace& face : cells.world.faces.broken) face.closed_joint = true;  // pressed together by loading
    EXPECT_EQ(rows_of(FacesWithRows::intact), rows_of(FacesWithRows::all));
    for (BrokenFace& face : cells.world.faces.broken) face.closed_joint = false;
    expect_the_forces_of_rows(cells, FacesWithRows::intact, middle, 1e-6);
}

}  // namespace
}  // namespace crackle::verification
