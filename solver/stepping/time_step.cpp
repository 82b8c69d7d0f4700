// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/neighbours/neighbours.hpp"

namespace crackle {

void refresh_neighbours(World& world) {
    if (update_neighbour_list(world)) evaluate_step_bound(world);
}

void evaluate_step_bound(World& world) {
    const PhaseTimer timer(world.workers.profile, Phase::step_bound);
    find_step_bound(world);
    keep_step_below_bound(world);
}

void find_exact_step(World& world) {
    const CriticalStep exact = critical_step(world, ClosedPoints::touching);
    world.stepping.exact_step = exact.step;
    world.stepping.exact_step_proved = exact.proved;
    world.stepping.step_goal =
        world.stepping.automatic_step && world.bonds.initial > 0 ? world.stepping.safety_factor * exact.step : 0.0;
}

void count_new_points(World& world) {
    const PhaseTimer timer(world.workers.profile, Phase::step_bound);
    if (!lower_step_bound(world)) evaluate_step_bound(world);
}

void keep_step_below_bound(World& world) {
    if (world.stepping.automatic_step) {
        const bool bonded = world.bonds.made && world.bonds.initial > 0;
        if (bonded && world.stepping.step_goal > 0.0) {
            world.stepping.time_step =
                world.stepping.step_scale * std::min(world.stepping.step_goal, world.stepping.step_bound);
        } else {
            const double share = derived_step_share(world);
            if (world.stepping.time_step > share / world.stepping.safety_factor * world.stepping.step_bound)
                world.stepping.time_step = share * world.stepping.step_bound;
        }
        return;
    }
    if (world.stepping.allow_unstable || world.stepping.time_step <= world.stepping.step_bound) return;
    // In a bonded world, a given step may lie between the guaranteed bound and the exact limit. If the limit for all
    // listed points allows the step, no check is needed until the list is rebuilt. Otherwise the limit for the touching
    // points applies. In a world without bonds, collisions do not tolerate a step above the bound.
    for (const ClosedPoints which : {ClosedPoints::listed, ClosedPoints::touching}) {
        if (!world.bonds.made) break;
        if (!stable_at(world, which, world.stepping.time_step)) continue;
        world.stepping.step_bound = world.stepping.time_step;
        if (which == ClosedPoints::listed) {
            for (PointState& point : world.points.state)
                point.flags = static_cast<std::uint16_t>(point.flags | point_counted);
        }
        return;
    }
    if (world.bonds.made)
        world.stepping.step_bound =
            std::max(world.stepping.step_bound, critical_step(world, ClosedPoints::touching).step);
    throw UnstableRun(world.stepping.steps, world.bodies.info(world.stepping.limiting_body).id,
                      fmt::format("the time step, {:.6g} s, is above the stable bound, which fell to {:.6g} s as this "
                                  "body gained contacts; give a smaller time step, leave it out (0 in a deck) to have "
                                  "it chosen automatically, or run with --allow-unstable",
                                  world.stepping.time_step, world.stepping.step_bound));
}

void set_time_step(World& world, double time_step) {
    world.stepping.automatic_step = false;
    world.stepping.step_goal = 0.0;
    world.stepping.time_step = time_step;
    keep_step_below_bound(world);
}

}  // namespace crackle
