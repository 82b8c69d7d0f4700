// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the simulation.
//
// compute_forces() updates the neighbour list and computes the forces of bonded faces, of the membrane and of every
// contact point from x(n) and v(n-½). It sums the forces on each body in a fixed order, and records broken bonds.
// Observers may then read the state, since everything is known at time n. advance() is leapfrog: v(n+½) = v(n-½) +
// a(n)Δt, x(n+1) = x(n) + v(n+½)Δt; driven bodies follow their controls. step() does both in one sweep if nothing is
// measured in between (solver/stepping/sweep.hpp).

#include <omp.h>

#include <algorithm>
#include <cmath>

#include "solver/faces/face_pass.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/membrane/press.hpp"
#include "solver/membrane/wrap.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/dilation.hpp"
#include "solver/stepping/motion.hpp"
#include "solver/stepping/record_breaks.hpp"
#include "solver/stepping/record_slips.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/sweep.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

constexpr std::int64_t block_bodies = 512;

/// Length of the kick from the middle of one drift to the middle of the next, s.
double kick_now(const World& world) { return kick_before(world.stepping) + 0.5 * world.stepping.time_step; }

/// Kicks and drifts all bodies. @return the speeds of the bodies
Speeds move_bodies(World& world, double kick) {
    const auto count = static_cast<std::int64_t>(world.bodies.size());
    const MoveRange move = move_range_for(world);
    if (world.workers.threads == 1) return move(world, kick, 0, count);
    double fastest = 0.0, excess = 0.0;
#pragma omp parallel for num_threads(world.workers.threads) schedule(static) reduction(max : fastest) \
    reduction(+ : excess)
    for (std::int64_t begin = 0; begin < count; begin += block_bodies) {
        const Speeds here = move(world, kick, begin, std::min(begin + block_bodies, count));
        excess += here.sum_of_excess;
        fastest = std::max(fastest, here.fastest);
    }
    return {fastest, excess};
}

/// Sums the losses of the blocks of the force pass in index order. @return whether a bond of a point has broken
bool sum_blocks(World& world) {
    std::uint32_t broken = 0, gained = 0;
    for (const LossBlock& block : world.account.blocks) {
        world.account.dashpot_loss += block.dashpot;
        world.account.friction_loss += block.friction;
        world.account.law_loss += block.law;
        broken += block.broken;
        gained += block.gained;
    }
    world.stepping.points_gained = gained > 0;
    return broken > 0;
}

void sample_geometry(World& world) {
    world.workers.profile->force_passes += 1;
    world.workers.profile->point_steps += static_cast<std::int64_t>(world.points.size());
    if (world.stepping.steps % geometry_interval != 0) return;
    const PhaseTimer timer(world.workers.profile, &world.workers.profile->geometry_sampled);
#pragma omp parallel num_threads(world.workers.threads) if (world.workers.threads > 1)
    geometry_pass(world);
}

/// Updates the stable bound if points have begun to carry load, and the neighbour list if bodies have used up the skin.
void update_neighbours(World& world) {
    if (world.stepping.points_gained) {
        count_new_points(world);
        world.stepping.points_gained = false;
    }
    refresh_neighbours(world);
}

/// Divides the points among threads, clears the summed forces, opens joints that slide, and adds the forces of bonded
/// faces, which may break, and of the membrane.
void prepare_forces(World& world) {
    plan_sweep(world);
    clear_forces(world);
    if (world.settings.dilates()) dilate_joints(world);
    if (world.faces.size() > 0) {
        const PhaseTimer timer(world.workers.profile, Phase::force);
        add_face_forces(world);
    }
    if (world.membrane.present()) {
        update_membrane(world);
        press_membrane(world);
    }
    if (world.workers.profile != nullptr) sample_geometry(world);
}

/// Records breaks, losses and the work of driven bodies after the force pass, at time n.
void account_forces(World& world) {
    const PhaseTimer timer(world.workers.profile, Phase::bookkeeping);
    if (sum_blocks(world)) record_breaks(world);
    if (world.bonds.watch_slips) record_slips(world);
    account_controls(world);
}

/// How a sweep moves the bodies whose total force is known.
struct SweepMotion {
    bool clears_forces;
    MoveListed move;
    double kick;  // s
};

SweepMotion motion_of_sweep(const World& world) {
    // The consistent integrator reads the forces of the last pass.
    const bool clears = world.settings.integrator != Integrator::consistent;
    return {clears, move_listed_for(world, world.workers.plan.free_ones_turn, clears), kick_now(world)};
}

/// Moves the bodies that the sweep has left in place: driven bodies and, if a bond has broken, others as well. @return
/// the speeds of all bodies
Speeds move_remaining(World& world, const SweepMotion& motion) {
    Speeds speeds = move_the_rest(world, motion.move, motion.kick);
    kick_controls(world, motion.kick);
    for (const ControlState& control : world.bodies.controls)
        speeds.add(move_listed_for(world, world.bodies.some_turn(), false)(world, motion.kick, &control.body, 1));
    return speeds;
}

/// Completes a step after all bodies have moved. @param speeds the speeds of all bodies
void end_step(World& world, const Speeds& speeds) {
    world.list.fastest = std::sqrt(speeds.checked());
    world.stepping.drift = world.stepping.time_step;
    world.stepping.steps += 1;
    world.stepping.time += world.stepping.time_step;
    world.stepping.kick_share = 1.0;
    world.list.travelled += world.list.fastest * world.stepping.time_step;
    world.stepping.forces_current = false;
    place_controls(world);
    if (!(world.list.fastest * world.stepping.time_step < world.list.fastest_allowed_move)) check_health(world);
}

/// Starts the energy account: measures its initial energy in the first force pass.
void begin_account(World& world) {
    world.account.begun = true;
    world.account.initial_energy = 0.0;
    world.account.initial_energy = measure_ledger(world).closing_error;
}

}  // namespace

void compute_forces(World& world) {
    if (world.stepping.forces_current) return;
    update_neighbours(world);
    prepare_forces(world);
    chosen_sweep()(world, {world, features_of(world)}, nullptr, 0.0);
    world.bodies.forces_clear = false;
    account_forces(world);
    world.stepping.forces_current = true;
    if (!world.account.begun) begin_account(world);
}

void advance(World& world) {
    const PhaseTimer timer(world.workers.profile, Phase::integrate);
    const double kick = kick_now(world);
    kick_controls(world, kick);
    end_step(world, move_bodies(world, kick));
}

void step(World& world) {
    if (world.stepping.forces_current || !world.account.begun) {
        compute_forces(world);
        return advance(world);
    }
    update_neighbours(world);  // updates the list of contact points and the stable bound
    prepare_forces(world);     // clears forces, then adds the forces of bonded faces and of the membrane
    const SweepMotion motion = motion_of_sweep(world);
    // Computes and sums forces, and moves free bodies.
    chosen_sweep()(world, {world, features_of(world)}, motion.move, motion.kick);
    world.bodies.forces_clear = motion.clears_forces;
    account_forces(world);  // records breaks, energy losses and the work done by driven bodies
    const PhaseTimer timer(world.workers.profile, Phase::integrate);
    const Speeds speeds = move_remaining(world, motion);  // moves driven bodies and those left in place
    end_step(world, speeds);                              // updates time and driven bodies, and checks the run
}

}  // namespace crackle
