// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the simulation, readable from top to bottom.
//
// compute_forces() brings the neighbour list up to date, lets every contact point compute its force from x(n) and
// v(n-½), adds up each body's forces in a fixed order, and records broken bonds. Observers may look now: everything is
// known at time n. advance() is leapfrog: v(n+½) = v(n-½) + a(n)Δt, x(n+1) = x(n) + v(n+½)Δt, driven bodies as their
// controls say.

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "solver/breaks.hpp"
#include "solver/contact_pass.hpp"
#include "solver/controls.hpp"
#include "solver/gather.hpp"
#include "solver/motion.hpp"
#include "solver/world.hpp"

namespace crackle {
namespace {

constexpr std::int64_t block_bodies = 512;

/// Kick and drift of all bodies. @return largest squared surface speed, m2/s2 (not a number if any velocity is not)
double move_bodies(World& world, double kick) {
    kick_controls(world, kick);
    const auto count = static_cast<std::int64_t>(world.bodies.size());
    const auto move = world.gravity == Vec2{} ? (world.some_turn ? &move_range<false, true> : &move_range<false, false>)
                                              : (world.some_turn ? &move_range<true, true> : &move_range<true, false>);
    Speeds speeds;
    if (world.threads == 1) {
        speeds = move(world, kick, 0, count);
    } else {
        double fastest = 0.0, excess = 0.0;
#pragma omp parallel for num_threads(world.threads) schedule(static) reduction(max : fastest) reduction(+ : excess)
        for (std::int64_t begin = 0; begin < count; begin += block_bodies) {
            const Speeds here = move(world, kick, begin, std::min(begin + block_bodies, count));
            excess += here.sum_of_excess;
            fastest = std::max(fastest, here.fastest);
        }
        speeds = {fastest, excess};
    }
    return speeds.finite() ? speeds.fastest : std::numeric_limits<double>::quiet_NaN();
}

/// Adds up what the blocks of the force pass report, in their order.
void sum_blocks(World& world) {
    std::uint32_t broken = 0, gained = 0;
    for (const World::LossBlock& block : world.loss_blocks) {
        world.dashpot_loss += block.dashpot;
        world.friction_loss += block.friction;
        world.law_loss += block.law;
        broken += block.broken;
        gained += block.gained;
    }
    if (broken > 0) record_breaks(world);
    if (gained > 0) count_new_points(world);
}

/// Calls `work` on every thread of the world. One thread needs no team: its barriers would cost a tenth of a small
/// scene's step.
template <class Work>
void as_team(const World& world, Work work) {
    if (world.threads == 1) return work();
#pragma omp parallel num_threads(world.threads)
    work();
}

void sample_geometry(World& world) {
    world.profile->point_steps += static_cast<std::int64_t>(world.points.size());
    if (world.step % geometry_interval != 0) return;
    const PhaseTimer timer(world.profile, &world.profile->geometry_sampled);
    as_team(world, [&] { geometry_pass(world); });
}

}  // namespace

void compute_forces(World& world) {
    if (world.forces_current) return;
    refresh_neighbours(world);
    const ContactFeatures features = features_of(world);
    const auto passes = [&] {
        Profile* const profile = omp_get_thread_num() == 0 ? world.profile : nullptr;
        {
            const PhaseTimer timer(profile, Phase::force);
            contact_pass(world, features);
#pragma omp barrier
        }
        const PhaseTimer timer(profile, Phase::gather);
        gather_forces(world);
    };
    if (world.profile != nullptr) sample_geometry(world);
    as_team(world, passes);
    const PhaseTimer timer(world.profile, Phase::bookkeeping);
    sum_blocks(world);
    account_controls(world);
    world.forces_current = true;
    if (!world.initial_energy_taken) {
        world.initial_energy_taken = true;
        world.initial_energy = 0.0;
        world.initial_energy = measure_ledger(world).closing_error;
    }
}

void advance(World& world) {
    const PhaseTimer timer(world.profile, Phase::integrate);
    world.fastest = std::sqrt(move_bodies(world, kick_before(world) + 0.5 * world.time_step));
    world.drift = world.time_step;
    world.step += 1;
    world.time += world.time_step;
    world.kick_share = 1.0;
    world.travelled += world.fastest * world.time_step;
    world.forces_current = false;
    place_controls(world);
    if (!(world.fastest * world.time_step < world.fastest_allowed_move)) check_health(world);
}

void step(World& world) {
    compute_forces(world);
    advance(world);
}

}  // namespace crackle
