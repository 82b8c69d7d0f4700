// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/throughput/least_step.hpp"

#include <cmath>
#include <iterator>
#include <limits>

#include "solver/gather.hpp"
#include "solver/motion.hpp"

namespace crackle::throughput {
void least_step(World& world, const ContactFeatures& features) {
    contact_pass(world, features);
    gather_forces(world);
    const Speeds speeds =
        move_range<false, false>(world, 0.5 * (world.drift + world.time_step), 0, std::ssize(world.bodies));
    const double squared = speeds.finite() ? speeds.fastest : std::numeric_limits<double>::quiet_NaN();
    world.fastest = std::sqrt(squared);
    world.drift = world.time_step;
    world.step += 1;
    world.time += world.time_step;
    world.travelled += world.fastest * world.time_step;
}

void make_room_for(World& world, const ContactFeatures& features) {
    const std::size_t points = world.points.size();
    if (features.bonds) {
        world.strong_normal.resize(points, 0.0);
        world.strong_shear.resize(points, 0.0);
    }
    if (features.ledger) {
        world.normal_dashpot.resize(points, 0.0);
        world.shear_dashpot.resize(points, 0.0);
    }
    if (features.consistent) {
        world.openings.resize(points);
        world.owed.resize(world.bodies.size(), 0.0);
    }
}

}  // namespace crackle::throughput
