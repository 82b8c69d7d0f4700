// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static loading by tolerance: the platen's speed follows the inertia error.
//
// Loading starts in motion, with the velocities of the elastic solution, so that it sends no shock: while the specimen
// is elastic, any constant rate is as good as rest. What a rate costs comes when the specimen changes: in a transit T =
// height/sqrt(E/ρ) of a wave the strain grows by rate·T, so the rate is at most sqrt(tolerance)·ε1/T, ε1 the strain at
// which one in fifty bonded points has slid or broken by the linear solution, or a joint in the shear box slides. Below
// that it follows two measured errors, smoothed over a transit:
//     out-of-balance   |σ_top - σ_bottom| over the largest stress so far
//     kinetic share    kinetic energy beyond that of the loading itself, over the strain energy
// The larger of the two over the tolerance drives ln(rate): slow through bursts of breaks, faster where nothing
// happens.
#pragma once

#include <algorithm>
#include <cmath>

namespace crackle {

/// What does not change while a specimen is loaded.
struct RateRule {
    double tolerance = 0.0;         ///< 0: the rate is given, and the rest unused
    double transit_time = 0.0;      // s
    double first_strain = 0.0;      ///< axial, where the specimen first gives way by the linear solution
    double stress_floor = 0.0;      // N/m, at that strain
    double energy_floor = 0.0;      // J, stored at that strain
    double kinetic_per_rate = 0.0;  // J s2, of the elastic motion at a rate of 1/s

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("tolerance", s.tolerance);
        visit("transit_time", s.transit_time);
        visit("first_strain", s.first_strain);
        visit("stress_floor", s.stress_floor);
        visit("energy_floor", s.energy_floor);
        visit("kinetic_per_rate", s.kinetic_per_rate);
    }
};

struct RateState {
    double rate = 0.0;                    // 1/s, axial, >= 0
    double out_of_balance = 0.0;          ///< smoothed, signed
    double largest_stress = 0.0;          // N/m, so far, whatever its sign
    double kinetic_share = 0.0;           ///< smoothed
    double next_check = 0.0;              // s
    double slowest = 0.0, fastest = 0.0;  // 1/s
    double strain_above = 0.0;            ///< strain gone through while the error lay above the tolerance

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("rate", s.rate);
        visit("out_of_balance", s.out_of_balance);
        visit("largest_stress", s.largest_stress);
        visit("kinetic_share", s.kinetic_share);
        visit("next_check", s.next_check);
        visit("slowest", s.slowest);
        visit("fastest", s.fastest);
        visit("strain_above", s.strain_above);
    }
};

/// Checks per transit: the rate changes little from one to the next, so that changing it sends no shock.
inline constexpr double checks_per_transit = 20.0;

/// The rate to begin with, never exceeded.
double largest_rate(const RateRule& rule);
/// What the rate never falls below.
double slowest_rate(const RateRule& rule);

/// Smooths the out-of-balance of one step, at every step, so that nothing depends on the rows of the curve.
/// @param top, bottom axial stress of the specimen at its platens, N/m, of the same sign
inline void watch_balance(RateState& state, const RateRule& rule, double top, double bottom, double dt) {
    state.largest_stress = std::max(state.largest_stress, 0.5 * std::abs(top + bottom));
    const double share = std::min(1.0, dt / rule.transit_time);
    const double scale = std::max(state.largest_stress, rule.stress_floor);
    state.out_of_balance += share * ((top - bottom) / scale - state.out_of_balance);
}

/// The coming rate, taken into the state. @param moving 1/s, at which the platen moves now, of either sign
/// @param kinetic, stored energies of the specimen, J
void choose_rate(RateState& state, const RateRule& rule, double moving, double kinetic, double stored, double time);

}  // namespace crackle
