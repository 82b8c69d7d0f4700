// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/bench/throughput/least_step.hpp"

#include <cmath>

#include "solver/stepping/motion.hpp"
#include "solver/stepping/sweep.hpp"

namespace crackle::throughput {
void least_step(World& world, const ContactFeatures& features) {
    const double kick = 0.5 * (world.drift + world.time_step);
    const MoveListed move = &move_listed<false, false, true>;
    clear_forces(world);
    sweep(world, features, move, kick);
    world.forces_clear = true;
    const Speeds speeds = move_the_rest(world, move, kick);
    world.fastest = std::sqrt(speeds.checked());
    world.drift = world.time_step;
    world.step += 1;
    world.time += world.time_step;
    world.travelled += world.fastest * world.time_step;
}

void make_room_for(World& world, const ContactFeatures& features) {
    const std::size_t points = world.points.size();
    if (features.bonds) {
        world.strong_normal.resize(points, 0.0F);
        world.strong_shear.resize(points, 0.0F);
    }
    if (features.ledger) {
        world.normal_dashpot.resize(points, 0.0F);
        world.shear_dashpot.resize(points, 0.0F);
    }
    if (features.consistent) {
        world.openings.resize(points);
        world.owed.resize(world.bodies.size(), 0.0);
        world.last_forces.resize(world.bodies.size());
    }
}

}  // namespace crackle::throughput
