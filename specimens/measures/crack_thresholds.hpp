// SPDX-License-Identifier: GPL-3.0-or-later
// Crack initiation and crack damage stresses of a compressed specimen, at which cracks start to form and start to
// coalesce (Brace, Paulding & Scholz, J. Geophys. Res. 71, 1966; Martin & Chandler, IJRMMS 31, 1994).
//
// Crack damage is the axial stress at the largest area strain ε_A = ε_axial - ε_lateral (the 2D counterpart of
// volumetric strain), up to the peak. Crack initiation has no such distinct feature, so it is determined in four ways:
//   first percent     the stress at which 1 % of the bonds broken at the peak have broken (usual in PFC)
//   break of counts   the stress at which the slope of the number of broken bonds against stress changes, between 0 and
//                     0.8 of the peak (statistics/broken_stick.hpp); this is the main value, with a 95 % interval
//   crack strain      the stress at which ε_A minus its elastic part, (1-ν)(σ-p)/E with the exact E and ν, leaves a
//                     band of three standard deviations about its mean below a quarter of the peak, and stays outside
//                     until crack damage
//   lateral strain    the stress at which the curve of lateral strain against stress is farthest from the chord between
//                     the start and crack damage (Nicksiar & Martin, Rock Mech. Rock Eng. 45, 2012)
// A value that cannot be determined is NaN: with fewer than ten bursts of breakages, or without side particles.
// Stresses are in N/m, or Pa in area units.
// Tested by tests/specimens/measures/crack_thresholds_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Stresses at which cracks begin and damage begins; N/m.
struct CrackThresholds {
    double first_percent = std::numeric_limits<double>::quiet_NaN();
    double count_break = std::numeric_limits<double>::quiet_NaN();  ///< low and high bound its 95 % interval
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
    double crack_strain = std::numeric_limits<double>::quiet_NaN();
    double lateral_strain = std::numeric_limits<double>::quiet_NaN();
    double damage = std::numeric_limits<double>::quiet_NaN();
    double damage_strain = std::numeric_limits<double>::quiet_NaN();  ///< axial strain at crack damage

    /// Largest minus smallest of the four initiation stresses; NaN if fewer than two are known.
    double spread() const;
};

/// @param confining_pressure  the pressure on the sides when loading begins; the resulting stresses are axial stresses
/// @param rows  of a compression test @param youngs_modulus, poissons_ratio  of the linear solution; if NaN,
/// crack_strain is not determined
CrackThresholds find_crack_thresholds(std::span<const CurveRow> rows, std::int64_t peak_row, double youngs_modulus,
                                      double poissons_ratio, double confining_pressure = 0.0);

}  // namespace crackle
