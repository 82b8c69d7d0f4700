// SPDX-License-Identifier: GPL-3.0-or-later
// Springs, shares and skews of faces from their reference points.

#include "solver/faces/bond_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/errors.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

using testing::agrees;
using testing::within;

TEST(BondFaces, FindNoOffsetBetweenSeedsOfVoronoiCells) {
    const CellWorld cells = build_box({});
    FaceQuality quality;
    const Faces faces = bond_faces(cells.world, elastic_rock(cells, CellBox{}.gap, 0.26, 1.0), &quality);
    EXPECT_TRUE(within("largest offset over distance", quality.largest_offset, 0.0, 1e-11));
    EXPECT_EQ(quality.raised, 0);
    double error = 0.0;
    for (FaceIndex k = 0; k < faces.size(); ++k)
        error = std::max(error, std::abs(faces.springs[k].share_i + faces.springs[k].share_j - 1.0));
    EXPECT_TRUE(within("sum of both shares", 1.0 + error, 1.0, 1e-14));
    const Faces softer = bond_faces(cells.world, elastic_rock(cells, CellBox{}.gap, 0.26, 0.625));
    double ratio_error = 0.0;
    for (FaceIndex k = 0; k < softer.size(); ++k)
        if (!softer.springs[k].at_rigid())
            ratio_error = std::max(ratio_error, std::abs(softer.springs[k].shear / softer.springs[k].normal - 0.625));
    EXPECT_TRUE(within("k_t/k_n - 0.625", ratio_error, 0.0, 1e-14));
    EXPECT_GT(quality.slowest_lag, 0.7);
}

/// Three squares of side 1 in a row, of which the last is a driven body.
CellWorld squares() {
    CellBox box{.width = 3.0, .height = 1.0, .gap = 0.0};
    CellWorld cells = world_of(box, squares_in_a_row(3), {{0.4, 0.5}, {1.8, 0.5}, {2.5, 0.5}}, 3);
    for (BodyIndex b = 0; b < 3; ++b)
        if (cells.world.bodies.names[b].id == 3) cells.world.bodies.inertia[b] = {0.0, 0.0, 0.0, 1.0};
    return cells;
}

TEST(BondFaces, PutTwoRocksInSeries) {
    const CellWorld cells = squares();
    FaceBonding bonding = elastic_rock(cells, 0.0, 0.2, 1.0);
    bonding.materials[1].moduli.contact *= 3.0;
    bonding.least_distance_share = 1e-3;
    const Faces faces = bond_faces(cells.world, bonding);
    const double one = bonding.materials[0].moduli.contact, other = bonding.materials[1].moduli.contact;
    ASSERT_EQ(faces.size(), 2u);
    const auto of = [&](int id) {
        for (FaceIndex k = 0; k < 2; ++k) {
            const int a = cells.world.bodies.names[faces.bodies[k].body_i].id,
                      b = cells.world.bodies.names[faces.bodies[k].body_j].id;
            if (a == id || b == id) return faces.springs[k];
        }
        return FaceSprings{};
    };
    EXPECT_TRUE(agrees("k_n of two rocks", of(1).normal, 1.0 / (0.6 / other + 0.8 / one), 1e-14));
    const double softer = std::max(of(1).share_i, of(1).share_j);
    EXPECT_TRUE(agrees("share of the softer cell", softer, (0.8 / one) / (0.6 / other + 0.8 / one), 1e-14));
    EXPECT_TRUE(agrees("sum of both shares", of(1).share_i + of(1).share_j, 1.0, 1e-14));
    EXPECT_TRUE(agrees("k_n at a driven body", of(3).normal, one / 0.2, 1e-14));
    EXPECT_EQ(of(3).shear, 0.0);
}

TEST(BondFaces, RefuseAWorldWithoutFacesAndDistancesThatMayBeNothing) {
    const CellWorld cells = build_box({.gap = 0.004});
    EXPECT_THROW(bond_faces(cells.world, elastic_rock(cells, 0.003, 0.26, 1.0)), InputError);
    FaceBonding bonding = elastic_rock(cells, 0.004, 0.26, 1.0);
    bonding.least_distance_share = 0.0;
    EXPECT_THROW(bond_faces(cells.world, bonding), InputError);
}

}  // namespace
}  // namespace crackle::verification
