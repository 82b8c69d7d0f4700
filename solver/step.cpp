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
#include "solver/lanes.hpp"
#include "solver/world.hpp"

namespace crackle {
namespace {

/// Second pass: every body adds up its own slots, always in the same order; both components of a force at once.
void gather_forces(World& world) {
    static constexpr Pair senses[2] = {{1.0, 1.0}, {-1.0, -1.0}};  // on i, on j
    const auto count = static_cast<std::int64_t>(world.bodies.size());
    const PointForce* const forces = world.point_forces.data();
    const std::uint32_t *const slots = world.body_slots.data(), *const begin = world.body_begin.data();
    BodyForce* const sums = world.forces.data();
#pragma omp for schedule(static)
    for (std::int64_t b = 0; b < count; ++b) {
        Pair sum{};
        double torque = 0.0;
        for (std::uint32_t s = begin[b]; s < begin[b + 1]; ++s) {
            const std::uint32_t side = slots[s] & 1;
            const double* const force = &forces[slots[s] >> 1].fx;
            sum += senses[side] * load_as<Pair>(force);
            torque += force[2 + side];
        }
        sums[b] = {sum[0], sum[1], torque};
    }
}

/// Turns the body frame by a small angle: exact to rounding for |turn| < 0.01, beyond that by the library's functions.
void turn_frame(BodyState& body, double turn) {
    double cosine, sine;
    if (std::abs(turn) < 0.01) {
        const double q = turn * turn;
        cosine = 1.0 - q * (0.5 - q * (1.0 / 24.0 - q / 720.0));
        sine = turn * (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q / 5040.0)));
    } else {
        cosine = std::cos(turn);
        sine = std::sin(turn);
    }
    const double c = body.shape[0] * cosine - body.shape[1] * sine;
    const double s = body.shape[1] * cosine + body.shape[0] * sine;
    const double scale = 1.5 - 0.5 * (c * c + s * s);  // back to unit length, one Newton step
    body.shape[0] = scale * c;
    body.shape[1] = scale * s;
}

/// Largest squared surface speed, m2/s2; not a number if any velocity is not.
struct Speeds {
    double fastest = 0.0;
    bool finite = true;

    void add(double squared) {
        finite = finite && squared < std::numeric_limits<double>::infinity();
        fastest = std::max(fastest, squared);
    }
};

/// Kick and drift.
Speeds move_range(World& world, double kick, std::int64_t begin, std::int64_t end) {
    const double dt = world.time_step;
    const Vec2 g = world.gravity;
    BodyState* const bodies = world.bodies.data();
    const BodyInertia* const inertias = world.inertia.data();
    const BodyForce* const forces = world.forces.data();
    const double* const reaches = world.turning_reach.data();
    Speeds speeds;
    for (std::int64_t n = begin; n < end; ++n) {
        BodyState& body = bodies[n];
        const BodyInertia& inertia = inertias[n];
        const BodyForce& force = forces[n];
        body.vx += kick * (force.fx + inertia.mass * g.x) * inertia.inverse_mass_x;
        body.vy += kick * (force.fy + inertia.mass * g.y) * inertia.inverse_mass_y;
        body.omega += kick * force.torque * inertia.inverse_moment;
        body.x += dt * body.vx;
        body.y += dt * body.vy;
        const double turn = dt * body.omega;
        body.angle += turn;
        double speed = body.vx * body.vx + body.vy * body.vy;
        const double reach = reaches[n];
        if (reach > 0.0) {
            turn_frame(body, turn);
            speed = 2.0 * (speed + reach * reach * body.omega * body.omega);  // (a+b)² <= 2(a²+b²)
        }
        speeds.add(speed);
    }
    return speeds;
}

/// Kick and drift of all bodies. @return largest squared surface speed, m2/s2 (not a number if any velocity is not)
double move_bodies(World& world, double kick) {
    kick_controls(world, kick);
    const auto count = static_cast<std::int64_t>(world.bodies.size());
    Speeds speeds;
    if (world.threads == 1) {
        speeds = move_range(world, kick, 0, count);
    } else {
        constexpr std::int64_t block = 512;
        double fastest = 0.0;
        bool finite = true;
#pragma omp parallel for num_threads(world.threads) schedule(static) reduction(max : fastest) reduction(&& : finite)
        for (std::int64_t begin = 0; begin < count; begin += block) {
            const Speeds here = move_range(world, kick, begin, std::min(begin + block, count));
            finite = finite && here.finite;
            fastest = std::max(fastest, here.fastest);
        }
        speeds = {fastest, finite};
    }
    return speeds.finite ? speeds.fastest : std::numeric_limits<double>::quiet_NaN();
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
