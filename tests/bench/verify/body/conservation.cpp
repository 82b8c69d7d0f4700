// SPDX-License-Identifier: GPL-3.0-or-later
// A free bonded specimen: conserved quantities (momentum, angular momentum, energy, bonds), no forces due to rigid
// motion, and reversibility of leapfrog.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/bonded_bodies.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

struct Drift {
    double momentum = 0.0, energy = 0.0;  // largest relative errors
    std::int64_t broken = 0;
    bool slid = false;
};

Drift shaken_run(Kind kind, double step_share, int steps) {
    World world = free_specimen(kind, 27.0, step_share);
    const double energy = 1e-4 * breaking_energy(world);
    shake(world, energy, 11);
    const Momentum start = momentum_of(world);
    Drift worst;
    for (int n = 0; n < steps; ++n) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        worst.energy = std::max(worst.energy, std::abs(ledger.kinetic + ledger.strain - energy) / energy);
        advance(world);
        worst.momentum = std::max(worst.momentum, momentum_error(start, momentum_of(world)));
    }
    worst.broken = world.bonds.broken;
    for (const PointState point : world.points.state) worst.slid = worst.slid || (point.flags & point_slid) != 0;
    return worst;
}

std::vector<ClaimRow> free_bonded_specimen_keeps_momentum_and_energy() {
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        const Drift coarse = shaken_run(kind, 0.4, 2000), fine = shaken_run(kind, 0.1, 8000);
        const std::string name = name_of(kind);
        rows.absolute(name + ": momentum and angular momentum over their scales",
                      std::max(coarse.momentum, fine.momentum), 0.0, 1e-12, "reference");
        // The error is (ω dt)²/4 of a mode's energy. At 0.4 of the bound, ω dt is at most 0.8 (leapfrog's limit is 2),
        // so the error is at most 0.16, and less for all other modes.
        rows.absolute(name + ": energy over that put in, at 0.4 of the bound", coarse.energy, 0.0, 0.16, "(ω dt)²/4");
        rows.converging({coarse.energy, fine.energy, 4.0, 2.0});
        rows.exactly(name + ": bonds broken", static_cast<double>(coarse.broken + fine.broken), 0.0);
        rows.exactly(name + ": points slid", coarse.slid || fine.slid ? 1.0 : 0.0, 0.0);
    }
    return rows.take();
}

/// Largest spring force, relative to k_n times the mean overlap, after a full rotation about the origin imposed in
/// equal steps.
double force_after_turn(Kind kind, int steps, std::int64_t& broken) {
    World world = free_specimen(kind, 27.0);
    const Array<BodyState> start = world.bodies.state;
    const double by = 2.0 * std::numbers::pi / steps, dt = world.stepping.time_step;
    double worst = 0.0;
    compute_forces(world);
    for (int n = 1; n <= steps; ++n) {
        const double c = std::cos(by * n), s = std::sin(by * n);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            BodyState& body = world.bodies.state[b];
            const double x = c * start[b].x - s * start[b].y, y = s * start[b].x + c * start[b].y;
            body.vx = (x - body.x) / dt;
            body.vy = (y - body.y) / dt;
            body.omega = by / dt;
            body.x = x;
            body.y = y;
            body.angle = start[b].angle + by * n;
            if (!world.bodies.info(b).single_circle) {
                body.shape[0] = c;
                body.shape[1] = s;
            }
        }
        world.stepping.drift = dt;
        world.list.valid = n % 16 != 0;  // the list is rebuilt several times
        world.stepping.forces_current = false;
        compute_forces(world);
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            if ((world.points.state[k].flags & point_bonded) == 0) continue;
            const PointView view = view_point(world, k);
            worst = std::max({worst, std::abs(view.normal_force), std::abs(view.shear_force)});
        }
    }
    broken += world.bonds.broken;
    return worst / (1e7 * 8e-5);
}

std::vector<ClaimRow> rigid_turn_of_360_degrees_gives_no_force() {
    // A step by the angle α moves each centroid along a chord. The slip at a contact due to the chord equals that of
    // the exact rotation up to (sin α - α)·D, where D is the distance of the centroids along the normal. This is α³D/6
    // per step, and πα²D/3 for a full rotation.
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        std::int64_t broken = 0;
        const double coarse = force_after_turn(kind, 1000, broken), fine = force_after_turn(kind, 8000, broken);
        const double by = 2.0 * std::numbers::pi / 8000, reach = 0.08;
        const double estimate = 2.5e6 * std::numbers::pi * by * by * reach / 3.0 / (1e7 * 8e-5);
        const std::string name = name_of(kind);
        rows.absolute(name + ": largest force during the rotation over the mean strength, 8000 steps", fine, 0.0,
                      estimate, "πα²D/3 a turn");
        rows.converging({coarse, fine, 8.0, 2.0});
        rows.exactly(name + ": bonds broken", static_cast<double>(broken), 0.0);
    }
    return rows.take();
}

/// Largest spring force of a specimen that starts to spin freely in its unstrained shape, N.
double spinning_force(Kind kind, double spin, std::int64_t& broken) {
    World world = free_specimen(kind, 27.0, 0.2);
    for (BodyState& body : world.bodies.state) {
        body.vx = -spin * body.y;
        body.vy = spin * body.x;
        body.omega = spin;
    }
    double largest = 0.0;
    for (int n = 0; n < 4000; ++n) {
        step(world);
        compute_forces(world);
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            const PointView view = view_point(world, k);
            largest = std::max({largest, std::abs(view.normal_force), std::abs(view.shear_force)});
        }
    }
    broken += world.bonds.broken;
    return largest;
}

std::vector<ClaimRow> free_slow_spin_feels_the_centripetal_force_alone() {
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        std::int64_t broken = 0;
        const double slow = spinning_force(kind, 0.05, broken), fast = spinning_force(kind, 0.1, broken);
        const std::string name = name_of(kind);
        // Forces grow with ω². Strains are only 1e-8, so the deviation comes from the rotation during the run.
        rows.relative(name + ": largest force at twice the spin over it", fast / slow, 4.0, 5e-3, "turn of the axes");
        // Twice the stress ρω²R²/2 times a disc's width is the largest force after a sudden start if all bonds carry
        // equal loads. Half as much is added, since some bonds carry more.
        const double pull = 2500.0 * 0.01 * 0.17 * 0.17 / 2.0 * 0.04;
        rows.at_most(name + ": largest force over ρω²R²/2 × 0.04 m", fast / pull, 3.0, "sudden start");
        rows.exactly(name + ": bonds broken", static_cast<double>(broken), 0.0);
    }
    return rows.take();
}

std::vector<ClaimRow> frictionless_motion_runs_backwards() {
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        World world = free_specimen(kind, 0.0);
        shake(world, 1e-4 * breaking_energy(world), 12);
        const Array<BodyState> start = world.bodies.state;
        const auto farthest = [&] {
            double off = 0.0;
            for (std::size_t b = 0; b < start.size(); ++b)
                off = std::max(off,
                               std::hypot(world.bodies.state[b].x - start[b].x, world.bodies.state[b].y - start[b].y));
            return off;
        };
        const int steps = 2000;
        for (int n = 0; n < steps; ++n) step(world);
        const double way = farthest();
        compute_forces(world);
        for (std::size_t b = 0; b < start.size(); ++b) {
            BodyState& body = world.bodies.state[b];
            const BodyInertia& inertia = world.bodies.inertia[b];
            body.vx = -(body.vx + world.stepping.time_step * inertia.inverse_mass_x * world.bodies.force[b].fx);
            body.vy = -(body.vy + world.stepping.time_step * inertia.inverse_mass_y * world.bodies.force[b].fy);
            body.omega =
                -(body.omega + world.stepping.time_step * inertia.inverse_moment * world.bodies.force[b].torque);
        }
        for (int n = 0; n < steps; ++n) step(world);
        const std::string name = name_of(kind);
        rows.at_least(name + fmt::format(": way after {} steps, m", steps), way, 1e-6, "it moves");
        rows.absolute(name + ": distance from the start after running back, over 0.04 m", farthest() / 0.04, 0.0, 1e-10,
                      "reference");
        rows.absolute(name + ": the same over the way", farthest() / way, 0.0, 1e-8, "rounding");
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> conservation_claims() {
    constexpr const char* group = "Conservation and symmetry";
    return {
        {.name = "free_bonded_specimen_keeps_momentum_and_energy",
         .group = group,
         .statement = "momentum and angular momentum are kept to 1e-12, energy to second order, and no bond breaks",
         .check = free_bonded_specimen_keeps_momentum_and_energy},
        {.name = "rigid_turn_of_360_degrees_gives_no_force",
         .group = group,
         .statement =
             "an imposed rigid rotation causes no forces, to second order in the angle per step, and no breaks",
         .check = rigid_turn_of_360_degrees_gives_no_force},
        {.name = "free_slow_spin_feels_the_centripetal_force_alone",
         .group = group,
         .statement = "forces of a freely spinning specimen grow with ω² and are those of ρω²R²/2",
         .check = free_slow_spin_feels_the_centripetal_force_alone},
        {.name = "frictionless_motion_runs_backwards",
         .group = group,
         .statement = "n steps, v := -(v + a dt), n steps return to the initial state",
         .check = frictionless_motion_runs_backwards},
    };
}

}  // namespace crackle::verification
