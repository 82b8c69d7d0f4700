// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/least_step.hpp"

#include <cmath>

#include "solver/base/chosen_set.hpp"
#include "solver/stepping/motion.hpp"
#include "solver/stepping/sweep.hpp"

namespace crackle::throughput {
void least_step(World& world, const ContactFeatures& features) {
    const double kick = 0.5 * (world.stepping.drift + world.stepping.time_step);
    const MoveListed move = of_chosen_set([]<InstructionSet S>() { return move_listed_of<S>(false, false, true); });
    clear_forces(world);
    chosen_sweep()(world, {world, features}, move, kick);
    world.bodies.forces_clear = true;
    const Speeds speeds = move_the_rest(world, move, kick);
    world.list.fastest = std::sqrt(speeds.checked());
    world.stepping.drift = world.stepping.time_step;
    world.stepping.steps += 1;
    world.stepping.time += world.stepping.time_step;
    world.list.travelled += world.list.fastest * world.stepping.time_step;
}

void make_room_for(World& world, const ContactFeatures& features) {
    const std::size_t points = world.points.size();
    if (features.bonds) {
        world.points.strong_normal.resize(points, 0.0F);
        world.points.strong_shear.resize(points, 0.0F);
    }
    if (features.consistent) {
        world.points.opening.resize(points);
        world.points.last_overlap.resize(points);
        world.points.last_normal.resize(points, 0.0);
        world.account.opening_defects.resize(world.bodies.size(), 0.0);
        world.bodies.last_force.resize(world.bodies.size());
        world.bodies.push_bound.resize(world.bodies.size());
    }
}

}  // namespace crackle::throughput
