// SPDX-License-Identifier: GPL-3.0-or-later
// Crack initiation and crack damage of a compressed specimen: the stresses at which cracks begin, and at which they
// begin to join (Brace, Paulding & Scholz, J. Geophys. Res. 71, 1966; Martin & Chandler, IJRMMS 31, 1994).
//
// Damage is the axial stress at the largest area strain ε_A = ε_axial - ε_lateral (in two dimensions what volume strain
// is to a core), up to the peak. Initiation has no such mark, so it is read in four ways:
//   first percent   the stress at which 1 % of the bonds broken at the peak are broken (PFC's custom)
//   break of counts where the cumulative number of broken bonds over stress changes its slope, from 0 to 0.8 of the
//                   peak (statistics/broken_stick.hpp); the headline, with its interval
//   crack strain    where ε_A less its elastic part, (1-ν)(σ-p)/E with the exact E and ν, leaves the band of three
//   standard
//                   deviations about what it was below a quarter of the peak, for good up to crack damage
//   lateral strain  where the lateral strain lies farthest from the chord from the start to crack damage over stress
//                   (Nicksiar & Martin, Rock Mech. Rock Eng. 45, 2012)
// What one cannot be read from is not a number: counts of fewer than ten bursts, strains of a specimen without side
// particles. Stresses in N/m, in area units Pa.
// Tested by tests/specimens/measures/crack_thresholds_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

struct CrackThresholds {
    double first_percent = std::numeric_limits<double>::quiet_NaN();
    double count_break = std::numeric_limits<double>::quiet_NaN();  ///< 95 % interval: low to high
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
    double crack_strain = std::numeric_limits<double>::quiet_NaN();
    double lateral_strain = std::numeric_limits<double>::quiet_NaN();
    double damage = std::numeric_limits<double>::quiet_NaN();
    double damage_strain = std::numeric_limits<double>::quiet_NaN();  ///< axial

    /// Largest less smallest of the four; not a number of fewer than two.
    double spread() const;
};

/// @param confining_pressure of the sides, from which loading began; stresses found are axial ones
/// @param rows of a compression  @param youngs_modulus, poissons_ratio  of the solve; not a number: no crack strain
CrackThresholds find_crack_thresholds(std::span<const CurveRow> rows, std::int64_t peak_row, double youngs_modulus,
                                      double poissons_ratio, double confining_pressure = 0.0);

}  // namespace crackle
