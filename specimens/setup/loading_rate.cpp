// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/loading_rate.hpp"

#include <cmath>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

// Controller for ln(rate). gain: change per wave transit, per unit of ln(tolerance/error). fastest_rise and
// fastest_fall: largest changes per wave transit. All three are multiplied by sqrt(tolerance).
constexpr double gain = 1.0, fastest_rise = 1.0, fastest_fall = 4.0;
// Lower limit of the rate, as a fraction of its upper limit, because after a breakage a specimen vibrates for a while
// at any rate.
constexpr double slowest_share = 0.15;
// Smallest error that the controller distinguishes, as a fraction of the tolerance.
constexpr double least_error_share = 1e-6;

}  // namespace

double largest_rate(const RateRule& rule) { return std::sqrt(rule.tolerance) * rule.first_strain / rule.transit_time; }

double slowest_rate(const RateRule& rule) { return slowest_share * largest_rate(rule); }

void choose_rate(RateState& state, const RateRule& rule, double moving, double kinetic, double stored, double time) {
    const double loading = moving * moving * rule.kinetic_per_rate;
    const double share = std::max(0.0, kinetic - loading) / std::max(stored, rule.energy_floor);
    state.kinetic_share += (share - state.kinetic_share) / checks_per_transit;
    const double error = std::max(std::abs(state.out_of_balance), state.kinetic_share);
    const double steps = rule.transit_time / checks_per_transit;
    const double push = -correctly_rounded::log(std::max(error / rule.tolerance, least_error_share));
    const double root = std::sqrt(rule.tolerance);
    const double change =
        std::clamp(gain * root * push, -fastest_fall * root, fastest_rise * root) / checks_per_transit;
    const double limit = largest_rate(rule);
    const double before = state.rate;
    state.rate = std::clamp(before * correctly_rounded::exp(change), slowest_rate(rule), limit);
    state.slowest = std::min(state.slowest, state.rate);
    state.fastest = std::max(state.fastest, state.rate);
    if (error > rule.tolerance) state.strain_above += before * steps;
    state.next_check = time + steps;
}

}  // namespace crackle
