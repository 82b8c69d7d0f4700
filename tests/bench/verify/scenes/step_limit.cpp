// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/verify/scenes/step_limit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "solver/linear/critical_step.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

constexpr double distance = 0.01;  // relative distance from the exact step

/// Largest allowed energy relative to the energy of the random velocities.
///
/// H = ½v(M - Δt C/2 - Δt²K/4)v + ½x̄Kx̄, with v at half steps and x̄ the mean of the positions before and after. Under
/// leapfrog with the lagged dashpot H never grows, and it starts below the initial energy. At a relative distance q
/// from the exact step the matrix is at least qM, so the kinetic energy stays below H/q and the strain energy below H(1
/// + 1/√q)².
constexpr double largest_growth_below = 1.0 / distance + (1.0 + 10.0) * (1.0 + 10.0);

/// Gives random velocities to all free bodies.
void shake_free(World& world, double energy, std::uint64_t seed) {
    shake(world, energy, seed);
    for (const ControlState& control : world.bodies.controls) {
        BodyState& body = world.bodies.state[control.body];
        body.vx = body.vy = body.omega = 0.0;
    }
}

/// Largest energy relative to the initial energy. The run stops once largest_growth_below is clearly exceeded.
double energy_growth(World world, double time_step) {
    world.stepping.time_step = time_step;
    const double energy = 1e-15 * breaking_energy(world);  // a hundredth of what the weakest bonds withstand
    shake_free(world, energy, 5);
    double largest = 0.0;
    for (int n = 0; n < 2000 && largest < 1e6; ++n) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        largest = std::max(largest, (ledger.kinetic + ledger.strain) / energy);
        advance(world);
    }
    return largest;
}

/// Amplitude of the unstable mode, from the positions.
class Projection {
  public:
    Projection(const World& rest, std::vector<BodyMotion> mode) : rest_(rest.bodies.state), mode_(std::move(mode)) {}
    double of(const World& world) const {
        double sum = 0.0;
        for (std::size_t b = 0; b < rest_.size(); ++b) {
            const BodyState &now = world.bodies.state[b], &then = rest_[b];
            sum += world.bodies.inertia[b].mass * (mode_[b].x * (now.x - then.x) + mode_[b].y * (now.y - then.y)) +
                   world.bodies.info(b).moment * mode_[b].rotation * (now.angle - then.angle);
        }
        return sum;
    }

  private:
    Array<BodyState> rest_;
    std::vector<BodyMotion> mode_;
};

struct Growth {
    double per_step;
    std::int64_t broken;
};

/// Starts from the mode plus a thousandth of noise and runs until it has grown by 1e6; growth is measured in the second
/// half.
Growth measured_growth(World world, const std::vector<BodyMotion>& mode, double time_step, double predicted) {
    const Projection projection(world, mode);
    world.stepping.time_step = time_step;
    double longest = 0.0;
    for (const BodyMotion& m : mode) longest = std::max({longest, std::abs(m.x), std::abs(m.y)});
    double energy = 0.0;
    // The first step moves by 1e-15 m, a few times the round-off of positions; the final amplitude of 1e-9 m is still
    // far from any limit.
    const double speed = 1e-15 / (time_step * longest);
    for (std::size_t b = 0; b < mode.size(); ++b) {
        const BodyMotion v{speed * mode[b].x, speed * mode[b].y, speed * mode[b].rotation};
        energy += 0.5 * world.bodies.inertia[b].mass * (v.x * v.x + v.y * v.y) +
                  0.5 * world.bodies.info(b).moment * v.rotation * v.rotation;
    }
    shake_free(world, 1e-6 * energy, 7);
    for (std::size_t b = 0; b < mode.size(); ++b) {
        world.bodies.state[b].vx += speed * mode[b].x;
        world.bodies.state[b].vy += speed * mode[b].y;
        world.bodies.state[b].omega += speed * mode[b].rotation;
    }
    const int steps = std::clamp(static_cast<int>(std::log(1e6) / std::log(predicted)), 2, 100000);
    const int first = steps / 2, rest = steps - first;
    for (int n = 0; n < first; ++n) step(world);
    const double half = projection.of(world);
    for (int n = 0; n < rest; ++n) step(world);
    return {std::pow(std::abs(projection.of(world) / half), 1.0 / rest), world.bonds.broken};
}

}  // namespace

World at_rest(World world) {
    for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
    for (ControlState& control : world.bodies.controls) {
        for (DofControl& dof : control.dof) {
            if (dof.drive != Drive::free) dof.value = 0.0;
        }
    }
    world.settings.gravity = {};
    world.stepping.drift = 0.0;
    world.stepping.kick_share = 0.5;
    world.stepping.automatic_step = false;
    world.stepping.allow_unstable = true;
    world.stepping.forces_current = false;
    return world;
}

void check_step_limit(Rows& rows, const std::string& name, const World& rest) {
    const CriticalStep exact = critical_step(rest, ClosedPoints::touching);
    rows.exactly(name + ": proved by Cholesky", exact.proved ? 1.0 : 0.0, 1.0);
    rows.at_most(name + ": the engine's bound over the exact step", rest.stepping.step_bound / exact.root, 1.0 + 1e-9,
                 "a bound");
    rows.at_most(name + ": its bound of all listed points over it", stable_step_bound(rest) / exact.root, 1.0 + 1e-9,
                 "a bound");
    rows.at_most(name + ": energy at 0.99 over that put in", energy_growth(rest, (1.0 - distance) * exact.root),
                 largest_growth_below, "rigorous");
    const double above = (1.0 + distance) * exact.root;
    const double predicted = growth_per_step(rest, ClosedPoints::touching, above);
    const Growth growth = measured_growth(rest, exact.mode, above, predicted);
    // With uneven damping, the modes at the limit and 1 % above it differ by about 1 %. Other modes are therefore
    // excited to about 1 %, which changes the projection by 1 % of 1 %.
    rows.relative(name + ": growth a step at 1.01, less 1", growth.per_step - 1.0, predicted - 1.0, 1e-4,
                  "other modes");
    rows.exactly(name + ": bonds broken during the run", static_cast<double>(growth.broken), 0.0);
}

}  // namespace crackle::verification
