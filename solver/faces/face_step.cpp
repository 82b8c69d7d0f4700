// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/face_step.hpp"

#include <algorithm>

#include "solver/faces/face_pass.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/motion.hpp"

namespace crackle {

void compute_face_forces(World& world, Faces& faces) {
    std::ranges::fill(world.bodies.force, BodyForce{});
    add_face_forces(world, faces);
    account_controls(world);
    if (world.account.begun) return;
    world.account.begun = true;
    world.account.initial_energy = 0.0;
    world.account.initial_energy = measure_ledger(world, faces).closing_error;
}

void advance_with_faces(World& world) {
    StepControl& clock = world.stepping;
    const double kick = kick_before(clock) + 0.5 * clock.time_step;
    kick_controls(world, kick);
    move_range_for(world)(world, kick, 0, static_cast<std::int64_t>(world.bodies.size()));
    clock.drift = clock.time_step;
    clock.steps += 1;
    clock.time += clock.time_step;
    clock.kick_share = 1.0;
    place_controls(world);
}

void step_with_faces(World& world, Faces& faces) {
    compute_face_forces(world, faces);
    advance_with_faces(world);
}

Ledger measure_ledger(const World& world, const Faces& faces) {
    Ledger ledger = measure_ledger(world);
    const double energy = face_energy(faces);
    ledger.strain += energy;
    ledger.closing_error += energy;
    return ledger;
}

}  // namespace crackle
