// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static loading at a rate that is controlled by a tolerance: the platen's speed depends on the measured inertia
// error.
//
// To avoid a shock, loading starts with the velocities of the elastic solution. As long as the specimen is elastic, any
// constant rate then gives the static response. The rate matters once the specimen starts to fail. During the transit
// time T = height/sqrt(E/ρ) of a wave the strain grows by rate·T, so the rate is at most sqrt(tolerance)·ε1/T. ε1 is
// the strain at which, according to the linear solution, one in fifty bonded points has slid or broken, or a joint in
// the shear box slides. Below that limit the rate follows two measured errors, smoothed over one transit:
//       out-of-balance   |σ_top - σ_bottom| divided by the largest stress so far
//       kinetic share    kinetic energy in excess of the steady loading motion, divided by the strain energy
// The larger error, divided by the tolerance, controls ln(rate): loading is slow through bursts of breakages and faster
// in quiet periods.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/base/fields.hpp"

namespace crackle {

/// Constants of the rate rule, fixed during loading.
struct RateRule {
    double tolerance = 0.0;         ///< of the inertia error; 0: the case gives the rate, other members are unused
    double transit_time = 0.0;      // s
    double first_strain = 0.0;      ///< axial strain ε1 at which failure starts according to the linear solution
    double stress_floor = 0.0;      // N/m, stress at the strain ε1
    double energy_floor = 0.0;      // J, strain energy at the strain ε1
    double kinetic_per_rate = 0.0;  // J s2, kinetic energy of the elastic motion at a strain rate of 1/s

    CRACKLE_FIELDS(tolerance, transit_time, first_strain, stress_floor, energy_floor, kinetic_per_rate);
};

/// Current rate, and the values that determine it.
struct RateState {
    double rate = 0.0;                    // 1/s, axial, >= 0
    double out_of_balance = 0.0;          ///< smoothed difference of the platens' stresses, relative and signed
    double largest_stress = 0.0;          // N/m, largest magnitude so far
    double kinetic_share = 0.0;           ///< smoothed, relative to the strain energy
    double next_check = 0.0;              // s, time of the next choice of the rate
    double slowest = 0.0, fastest = 0.0;  // 1/s
    double strain_above = 0.0;            ///< cumulative strain while the error exceeded the tolerance

    CRACKLE_FIELDS(rate, out_of_balance, largest_stress, kinetic_share, next_check, slowest, fastest, strain_above);
};

/// Checks per wave transit; with this number, the rate changes little between checks, and the changes cause no shock.
inline constexpr double checks_per_transit = 20.0;

/// The initial rate, which is never exceeded.
double largest_rate(const RateRule& rule);
/// Lower limit of the rate.
double slowest_rate(const RateRule& rule);

/// Smooths the out-of-balance stress. Called in every step, so that the result does not depend on the rows of the
/// curve.
/// @param top, bottom  axial stress of the specimen at its platens, N/m, with the same sign convention
inline void watch_balance(RateState& state, const RateRule& rule, double top, double bottom, double dt) {
    state.largest_stress = std::max(state.largest_stress, 0.5 * std::abs(top + bottom));
    const double share = std::min(1.0, dt / rule.transit_time);
    const double scale = std::max(state.largest_stress, rule.stress_floor);
    state.out_of_balance += share * ((top - bottom) / scale - state.out_of_balance);
}

/// Chooses the next rate and stores it in the state.
/// @param moving  strain rate currently imposed by the platen, 1/s, signed
/// @param kinetic, stored  kinetic and strain energy of the specimen, J
void choose_rate(RateState& state, const RateRule& rule, double moving, double kinetic, double stored, double time);

}  // namespace crackle
