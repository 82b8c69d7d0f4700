// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/faces/two_cells.hpp"

#include <cmath>

#include "tests/bench/verify/scenes/cell_worlds.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

constexpr Vec2 face_middle{1.0, 0.5};  // m

}  // namespace

void TwoCells::place(double opening, double sliding, double turn) {
    const BodyPair pair = world.faces.bodies[0];
    const Vec2 normal = world.faces.place[0].normal_i, along = perpendicular(normal);
    const auto put = [&](BodyIndex b, double side) {
        BodyState& body = world.bodies.state[b];
        body = rest[b];
        const double angle = 0.5 * side * turn, c = std::cos(angle), s = std::sin(angle);
        const Vec2 arm{body.x - face_middle.x, body.y - face_middle.y};
        const Vec2 at = face_middle + 0.5 * side * (opening * normal + sliding * along) +
                        Vec2{c * arm.x - s * arm.y, s * arm.x + c * arm.y};
        body.x = at.x, body.y = at.y;
        turn_body(world, b, angle);
    };
    put(pair.body_i, -1.0);
    put(pair.body_j, 1.0);
    compute_face_forces(world);
}

FaceForces TwoCells::forces() const {
    const BodyIndex i = world.faces.bodies[0].body_i;
    const Vec2 normal = world.faces.place[0].normal_i;
    const BodyForce& on_i = world.bodies.force[i];
    const Vec2 force{on_i.fx, on_i.fy};
    const Vec2 arm = Vec2{world.bodies.state[i].x, world.bodies.state[i].y} - face_middle;
    return {dot(force, normal), dot(force, perpendicular(normal)), on_i.torque + cross(arm, force)};
}

double TwoCells::pressure_per_area() const {
    constexpr double area = 1.0, of_sides = 3.0 * 0.5;  // m², Σ L h_b
    return moduli.pressure / (area + moduli.pressure * of_sides / moduli.contact);
}

double TwoCells::pressure_rate() const { return 0.5 * length * pressure_per_area(); }

TwoCells two_cells(const FaceLaw& law, double poissons_ratio, double shear_ratio) {
    // The closed forms of solver/MODEL.md 5.5, without the function that the engine uses.
    const double contact = 2.0 / ((1.0 + poissons_ratio) * (1.0 + shear_ratio));
    const FaceModuli moduli{contact, 0.5 / (1.0 - poissons_ratio) - 0.5 * contact, shear_ratio};
    const CellBox box{.width = 2.0, .height = 1.0, .gap = 0.0};
    CellWorld cells = world_of(box, squares_in_a_row(2), {{0.5, 0.5}, {1.5, 0.5}});
    FaceBonding bonding = elastic_rock(cells, box.gap, poissons_ratio, shear_ratio);
    bonding.materials[0].law = law;
    cells.world.faces = bond_faces(cells.world, bonding);
    TwoCells two{std::move(cells.world), {}, moduli};
    two.rest = two.world.bodies.state;
    return two;
}

}  // namespace crackle::verification
