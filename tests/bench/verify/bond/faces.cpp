// SPDX-License-Identifier: GPL-3.0-or-later
// Faces in area units by the sparse solve: the modulus of a column, and the bending stiffness due to points at the ends
// of a face.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "solver/linear/elastic.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace faces_scenes {
namespace {

constexpr double modulus = 3e9, stiffness_ratio = 4.0;  // Pa, -

Scene empty_scene(double thick) {
    Scene scene;
    scene.materials = {rock()};
    scene.materials[0].normal_stiffness = modulus;
    scene.materials[0].shear_stiffness = modulus / stiffness_ratio;
    scene.materials[0].tensile_strength = 5e6;
    scene.materials[0].cohesion = 9e6;
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = thick;
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    return scene;
}

/// Adds a rectangle inset by half the thickness.
void add_cell(Scene& scene, int id, Vec2 low, Vec2 high) {
    const double h = 0.5 * scene.thick;
    scene.add_chain_body(
        id, 0, {{low.x + h, low.y + h}, {high.x - h, low.y + h}, {high.x - h, high.y - h}, {low.x + h, high.y - h}},
        true);
}

World bonded(Scene scene) {
    Bonding bonding;
    bonding.thick = scene.thick;
    bonding.gap = 0.05 * scene.thick;
    World world = build_world(std::move(scene));
    bond_all(world, bonding);
    return world;
}

std::vector<ClaimRow> column_of_cells_has_the_contact_modulus() {
    Rows rows;
    constexpr double width = 0.1, height = 0.4, strain = 1e-6;
    for (const int cells : {1, 2, 5, 16, 64}) {
        Scene scene = empty_scene(1e-4);
        for (int k = 0; k < cells; ++k)
            add_cell(scene, k + 1, {0.0, k * height / cells}, {width, (k + 1) * height / cells});
        const DofControl still{Drive::velocity, 0.0};
        add_cell(scene, 1001, {-width, -height}, {2.0 * width, 0.0});
        add_cell(scene, 1002, {-width, height}, {2.0 * width, 2.0 * height});
        scene.controls = {{cells, still, still, still, 0}, {cells + 1, still, still, still, 0}};
        const World world = bonded(std::move(scene));
        const ElasticSolution solution = solve_elastic(
            world, {{body_of_id(world, 1001), {}}, {body_of_id(world, 1002), {0.0, -strain * height, 0.0}}});
        rows.relative(fmt::format("{} cells: E over the contact modulus", cells),
                      std::abs(solution.reaction[1].y) / width / strain / modulus, 1.0, 1e-6, "shares, floats");
    }
    return rows.take();
}

std::vector<ClaimRow> face_turns_as_its_end_points_do() {
    Rows rows;
    constexpr double thick = 1e-4, height = 0.04, turn = 1e-6;
    for (const double width : {0.02, 0.04, 0.1}) {
        Scene scene = empty_scene(thick);
        add_cell(scene, 1, {-width, -0.5 * height}, {0.0, 0.5 * height});
        add_cell(scene, 2, {0.0, -0.5 * height}, {width, 0.5 * height});
        const World world = bonded(std::move(scene));
        // Each cell rotates by half the angle about the middle of the face.
        const double up = 0.25 * turn * width;
        const ElasticSolution solution = solve_elastic(
            world, {{body_of_id(world, 1), {0.0, up, -0.5 * turn}}, {body_of_id(world, 2), {0.0, up, 0.5 * turn}}});
        const double stiffness = modulus * height / width, span = height - thick;
        const std::string name = fmt::format("cells {} m wide: ", width);
        const double got = solution.reaction[1].rotation / turn;
        rows.relative(name + "moment over the turn, N m", got, 0.25 * stiffness * span * span, 1e-6, "shares, floats");
        rows.absolute(name + "shear force over moment a width",
                      solution.reaction[1].y * width / solution.reaction[1].rotation, 0.0, 1e-6, "shares, floats");
        rows.shown(name + "over that of a uniform face, kL²/12", got / (stiffness * height * height / 12.0));
    }
    return rows.take();
}

}  // namespace
}  // namespace faces_scenes

std::vector<Claim> face_claims() {
    using namespace faces_scenes;
    constexpr const char* group = "Bonds with given strengths";
    return {
        {.name = "column_of_cells_has_the_contact_modulus",
         .group = group,
         .statement = "in area units, a column of cells between platens has E = E_c for any number of cells",
         .check = column_of_cells_has_the_contact_modulus},
        {.name = "face_turns_as_its_end_points_do",
         .group = group,
         .statement = "two cells have the bending stiffness k s²/4, where s is the distance of the points at the ends "
                      "of their face",
         .check = face_turns_as_its_end_points_do,
         .note = "Apart from the inset, this is three times that of a uniform face, because rigid cells touch only at "
                 "corners."},
    };
}

}  // namespace crackle::verification
