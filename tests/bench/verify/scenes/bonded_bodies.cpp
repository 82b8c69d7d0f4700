// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/bonded_bodies.hpp"

#include <utility>

#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {

const char* name_of(Kind kind) { return kind == Kind::discs ? "discs" : "polygons"; }

World free_specimen(Kind kind, double friction_angle, double step_share, IntactOptions intact) {
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
    // Bonding has changed the bound on the stable step. All specimens use the same fraction of it.
    world.stepping.automatic_step = false;
    world.stepping.time_step = step_share * world.stepping.step_bound;
    return world;
}

World bursting_specimen(Kind kind) {
    World world = free_specimen(kind, 27.0, 0.4);
    shake(world, 0.5 * breaking_energy(world), 3);
    for (BodyState& body : world.bodies.state) {
        body.vx += 4.0 * body.x;
        body.vy += 1.2 * body.y;
    }
    return world;
}

}  // namespace crackle::verification
