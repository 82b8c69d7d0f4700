// SPDX-License-Identifier: GPL-3.0-or-later
// Tests stiffness and strength factors in area units (solver/MODEL.md 4.5) for cells and discs whose faces are known.

#include "solver/geometry/contact_share.hpp"

#include <cmath>
#include <numbers>

#include "solver/linear/elastic.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/claim.hpp"

namespace crackle::contact_share_test {
namespace {

using testing::agrees;

constexpr double modulus = 3e9, tensile = 5e6, cohesion = 9e6;  // Pa

Material rock() {
    Material material = undamped_rock(modulus, 27.0);
    material.tensile_strength = tensile;
    material.cohesion = cohesion;
    return material;
}

/// Sums of the points between two bodies.
struct FaceSum {
    double stiffness = 0.0, tensile = 0.0, cohesion = 0.0;
    int points = 0;
};

FaceSum face_between(const World& world, int id_a, int id_b) {
    FaceSum sum;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        const int i = world.bodies.info(point.body_i).id, j = world.bodies.info(point.body_j).id;
        if ((world.points.state[k].flags & point_bonded) == 0 || std::minmax(i, j) != std::minmax(id_a, id_b)) continue;
        const ContactLaw law = law_of(world, k);
        sum.stiffness += law.normal_stiffness;
        sum.tensile += law.tensile_strength;
        sum.cohesion += law.cohesion;
        ++sum.points;
    }
    return sum;
}

World bonded(Scene scene, double thick, double gap = 0.0) {
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    World world = build_world(scene);
    Bonding bonding;
    bonding.thick = thick;
    bonding.gap = gap;
    bond_all(world, bonding);
    return world;
}

TEST(ContactShare, OfHexagonsIsTheirFaceBeforeTheInsetOverTheDistanceOfCentroids) {
    constexpr double apothem = 0.02, thick = 1e-3;
    const World world = bonded(honeycomb(4, 3, apothem, thick, rock()), thick, 0.05 * thick);
    const double length = 2.0 * apothem / std::sqrt(3.0);
    const FaceSum face = face_between(world, 1, 2);
    EXPECT_EQ(face.points, 4);
    // Factors are stored in single precision, with a relative error of 6e-8.
    EXPECT_TRUE(agrees("k_n = E_c L/l, N/m", face.stiffness, modulus * length / (2.0 * apothem), 1e-6));
    EXPECT_TRUE(agrees("T = s_t L, N", face.tensile, tensile * length, 1e-6));
    EXPECT_TRUE(agrees("C = c L, N", face.cohesion, cohesion * length, 1e-6));
}

TEST(ContactShare, OfAFaceWhoseCornersOverhangAfterTheInsetGoesByTheGapOfTheFaces) {
    // A rectangle below and a trapezoid above share a face of 2 cm, and each is inset by half the thickness. The
    // outline of the trapezoid turns by 45 degrees at the face's ends, so its corners are 0.293 of the thickness beyond
    // those of the rectangle.
    constexpr double length = 0.02, thick = 1e-3, inset = 0.5 * thick;
    const double along = inset * std::tan(std::numbers::pi / 8.0),
                 at_top = inset * std::tan(3.0 * std::numbers::pi / 8.0);
    constexpr double height = 0.01;
    Scene scene;
    scene.materials = {rock()};
    scene.thick = thick;
    scene.domain.wall_present = {false, false, false, false};
    scene.add_chain_body(
        1, 0, {{inset, inset - height}, {length - inset, inset - height}, {length - inset, -inset}, {inset, -inset}},
        true);
    scene.add_chain_body(2, 0,
                         {{along, inset},
                          {length - along, inset},
                          {length + height - at_top, height - inset},
                          {at_top - height, height - inset}},
                         true);
    const World world = bonded(scene, thick, 0.05 * thick);
    const FaceSum face = face_between(world, 1, 2);
    ASSERT_EQ(face.points, 4) << "overhanging ones are bonded too";
    const BodyState &a = world.bodies.state[body_of_id(world, 1)], &b = world.bodies.state[body_of_id(world, 2)];
    const double distance = std::hypot(a.x - b.x, a.y - b.y);
    EXPECT_TRUE(agrees("k_n, N/m", face.stiffness, modulus * length / distance, 1e-6));
    EXPECT_TRUE(agrees("T, N", face.tensile, tensile * length, 1e-6));
}

TEST(ContactShare, OfDiscsIsTwiceTheSmallerRadiusOverTheSumOfBoth) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    scene.add_circle_body(2, 0, {{0.03 - 1e-5, 0.0}, 0.01, 0.0});
    const World world = bonded(scene, 0.0);
    const FaceSum contact = face_between(world, 1, 2);
    EXPECT_TRUE(agrees("k_n, N/m", contact.stiffness, modulus * 2.0 * 0.01 / 0.03, 1e-6));
    EXPECT_TRUE(agrees("T, N", contact.tensile, tensile * 0.02, 1e-6));
}

/// A column of cells at distances of `thick` between two held slabs; the upper slab is last.
Scene column(int cells, double width, double height, double thick) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = thick;
    const double h = height / cells, half = 0.5 * thick;
    for (int k = 0; k < cells; ++k) {
        const double low = k * h + half, high = (k + 1) * h - half;
        scene.add_chain_body(k + 1, 0, {{half, low}, {width - half, low}, {width - half, high}, {half, high}}, true);
    }
    const auto slab = [&](int id, double low, double high) {
        const auto body =
            scene.add_chain_body(id, 0, {{-width, low}, {2.0 * width, low}, {2.0 * width, high}, {-width, high}}, true);
        const DofControl still{Drive::velocity, 0.0};
        scene.controls.push_back({static_cast<int>(body), still, still, still, 0});
    };
    slab(cells + 1, -height - half, -half);
    slab(cells + 2, height + half, 2.0 * height + half);
    return scene;
}

TEST(ContactShare, OfAColumnOfCellsBetweenPlatensGivesTheContactModulusWhateverTheirNumber) {
    constexpr double width = 0.1, height = 0.4, thick = 1e-4, strain = 1e-6;
    for (const int cells : {1, 4, 16}) {
        const World world = bonded(column(cells, width, height, thick), thick, 0.05 * thick);
        const ElasticSolution solution = solve_elastic(
            world, {{body_of_id(world, cells + 1), {}}, {body_of_id(world, cells + 2), {0.0, -strain * height, 0.0}}});
        const double force = solution.reaction[1].y;
        EXPECT_TRUE(agrees("E over the contact modulus", std::abs(force) / width / strain / modulus, 1.0, 1e-6))
            << cells;
    }
}

TEST(ContactShare, OfACornerMetLaterIsHalfTheEdgesThatMeetInIt) {
    constexpr double side = 0.04;
    Scene scene;
    scene.materials = {rock()};
    scene.thick = 1e-3;
    scene.domain.wall_present = {false, false, false, false};
    scene.units = StiffnessUnits::area;
    scene.materials[0].tensile_strength = scene.materials[0].cohesion = 0.0;
    scene.add_chain_body(1, 0, {{0.0, 0.0}, {side, 0.0}, {side, side}, {0.0, side}}, true);
    const double d = side / std::sqrt(2.0), y = side + 1e-3;  // standing on a corner, at a gap equal to the thickness
    scene.add_chain_body(2, 0, {{0.02, y}, {0.02 + d, y + d}, {0.02, y + 2.0 * d}, {0.02 - d, y + d}}, true);
    const World world = build_world(scene);
    ASSERT_EQ(world.points.size(), 1U);
    const double expected = side / (2.0 * side / std::sqrt(std::numbers::pi));
    EXPECT_TRUE(agrees("share", static_cast<double>(world.points.stiffness_share[0]), expected, 1e-6));
}

}  // namespace
}  // namespace crackle::contact_share_test
