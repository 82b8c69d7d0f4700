// SPDX-License-Identifier: GPL-3.0-or-later
// Stops an unstable run with a message that states the step, the body and the likely cause.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/errors.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/outside.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

bool finite(const BodyState& b) {
    return std::isfinite(b.x) && std::isfinite(b.y) && std::isfinite(b.vx) && std::isfinite(b.vy) &&
           std::isfinite(b.omega) && std::isfinite(b.angle);
}

void check_bodies(const World& world) {
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const int id = world.bodies.info(b).id;
        if (!finite(body)) {
            throw UnstableRun(
                world.stepping.steps, id,
                "its position or velocity is not a number; the time step is likely too large for its contacts");
        }
        const double move = world.stepping.time_step * norm(Vec2{body.vx, body.vy});
        if (move > world.list.fastest_allowed_move && !world.stepping.allow_unstable) {
            throw UnstableRun(
                world.stepping.steps, id,
                fmt::format("it moves {:.3g} m per step, more than half the radius of the smallest body ({:.3g} m), so "
                            "that contacts would be missed; the time step is too large or the impact too fast",
                            move, world.list.fastest_allowed_move));
        }
        if (outside_domain(world, b)) {
            throw UnstableRun(world.stepping.steps, id,
                              fmt::format("it left the domain at ({:.6g}, {:.6g}) through a wall; the time step is too "
                                          "large or the impact too fast",
                                          body.x, body.y));
        }
    }
}

/// Upper estimate of the energy that round-off alone can produce, J. Each spring is assumed strained by 64 units in the
/// last place of the largest coordinate, since an overlap accumulates that much round-off over a few steps. Round-off
/// of the large energies in the account is added. For a bonded specimen at rest there is no other energy to compare
/// with.
double rounding_energy(const World& world, const Ledger& ledger) {
    constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();
    double farthest = 0.0, stiffness = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        farthest = std::max(farthest, std::max(std::abs(world.bodies.state[b].x), std::abs(world.bodies.state[b].y)) +
                                          world.bodies.info(b).reach);
    }
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactLaw law = law_of(world, k);
        stiffness += law.normal_stiffness + law.shear_stiffness;
    }
    const double strain = rounding * farthest;
    return stiffness * strain * strain +
           rounding * (std::abs(world.account.initial_energy) + std::abs(ledger.potential));
}

std::size_t liveliest_body(const World& world) {
    std::size_t fastest = 0;
    double most = -1.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const double energy = world.bodies.inertia[b].mass * (world.bodies.state[b].vx * world.bodies.state[b].vx +
                                                              world.bodies.state[b].vy * world.bodies.state[b].vy);
        if (energy > most) most = energy, fastest = b;
    }
    return fastest;
}

/// Throws if energy has appeared without a source: more than the sum of the initial energy, the work supplied and the
/// energy gained by falling.
void check_energy(World& world) {
    if (world.stepping.allow_unstable || !world.stepping.forces_current) return;
    const Ledger ledger = measure_ledger(world);
    const double mechanical = ledger.kinetic + ledger.strain;
    const double supply =
        world.account.initial_energy - ledger.potential + ledger.displacement_work + ledger.force_work;
    if (!std::isfinite(mechanical) || !std::isfinite(supply)) {
        throw UnstableRun(world.stepping.steps, world.bodies.info(liveliest_body(world)).id,
                          fmt::format("the kinetic and stored energy, {:.4g} J after an input of {:.4g} J, exceeds the "
                                      "largest number that can be represented (this body carries most of the kinetic "
                                      "energy); look for a force, mass or stiffness of unrealistic size",
                                      mechanical, supply));
    }
    world.account.largest_supply = std::max({world.account.largest_supply, std::abs(supply), mechanical * 1e-3});
    if (mechanical <= supply + world.account.largest_supply + rounding_energy(world, ledger)) return;
    throw UnstableRun(
        world.stepping.steps, world.bodies.info(liveliest_body(world)).id,
        fmt::format(
            "runaway energy, with {:.4g} J of kinetic and stored energy after an input of {:.4g} J (this body carries "
            "most of the kinetic energy); the time step ({:.4g} s, stable bound {:.4g} s) is likely too large",
            mechanical, supply, world.stepping.time_step, world.stepping.step_bound));
}

}  // namespace

void check_health(World& world) {
    check_bodies(world);
    check_energy(world);
}

}  // namespace crackle
