// SPDX-License-Identifier: GPL-3.0-or-later
// Circles in closely packed rows, with a straight joint trace through them.
#pragma once

#include <cmath>
#include <vector>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/materials.hpp"

namespace crackle::testing {

struct JointedCircles {
    int columns = 12, rows = 12;
    double radius = 0.01;  // m; one of three circles is smaller by a tenth
    double modulus = 5e9;  // Pa
    double damping_ratio = 0.1;
    Vec2 from{-0.02, 0.07}, to{0.26, 0.13};  // m, ends of the trace
    double turn = 0.0;                       // rad, rotation of the rows
    Joint joint;
    int threads = 1;
};

/// The scene; ids start at 1, row by row from the lower left.
inline Scene scene_of(const JointedCircles& circles) {
    Scene scene;
    Material rock = undamped_rock(circles.modulus, 35.0, 0.4);
    rock.residual_friction_angle = 30.0;
    rock.tensile_strength = 20e6;
    rock.cohesion = 60e6;
    rock.damping_ratio = circles.damping_ratio;
    scene.materials = {rock};
    scene.domain.wall_present = {false, false, false, false};
    scene.bond_law = BondLaw::coulomb;
    scene.units = StiffnessUnits::area;
    scene.threads = circles.threads;
    scene.joints = {circles.joint};
    scene.trace_joints = {0};
    scene.trace_pieces = {{0, circles.from, circles.to}};
    const double step = 2.0 * circles.radius;
    const double width = step * (circles.columns + 0.5), height = step * circles.rows * std::sqrt(0.75);
    const Vec2 middle{0.5 * width, 0.5 * height};
    const Vec2 turn{std::cos(circles.turn), std::sin(circles.turn)};
    // For rotated rows, more circles are created, and those outside the box are omitted.
    const int more = circles.turn == 0.0 ? 0 : circles.rows + circles.columns;
    int id = 0;
    for (int row = -more; row < circles.rows + more; ++row) {
        for (int column = -more; column < circles.columns + more; ++column) {
            const Vec2 flat = Vec2{step * (column + (row % 2 == 0 ? 0.0 : 0.5)), step * row * std::sqrt(0.75)} - middle;
            const Vec2 centre = middle + flat.x * turn + flat.y * perpendicular(turn);
            const bool inside =
                std::abs(centre.x - middle.x) <= 0.5 * width && std::abs(centre.y - middle.y) <= 0.5 * height;
            if (more > 0 && !inside) continue;
            const double radius = circles.radius * ((row + column) % 3 == 0 ? 0.9 : 1.0);
            scene.add_circle_body(++id, 0, {centre, radius, 0.0});
        }
    }
    return scene;
}

/// Builds a world and bonds it, also across gaps.
inline World bonded_circles(Scene scene) {
    World world = build_world(std::move(scene));
    Bonding bonding;
    bonding.range = 0.3;
    bond_all(world, bonding);
    return world;
}

}  // namespace crackle::testing
