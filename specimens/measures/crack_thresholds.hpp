// SPDX-License-Identifier: GPL-3.0-or-later
// Crack initiation and crack damage stresses of a compressed specimen, at which cracks start to form and start to
// coalesce (Brace, Paulding & Scholz, J. Geophys. Res. 71, 1966; Martin & Chandler, IJRMMS 31, 1994).
//
// Crack damage is where the area strain ε_A = ε_axial - ε_lateral (the 2D counterpart of volumetric strain) is largest
// up to the peak. Its curve is flat there, so the preferred estimate is the middle of the range of stresses in which
// ε_A is within 2 % of its largest value. The error is half the width of this range. The stress at the largest ε_A is
// given as a second value.
//
// Crack initiation has no such distinct feature, so it is determined in six ways:
//   opening             the stress σ_ci beyond which the lateral strain exceeds its elastic value ν(σ-p)/E, with the
//                       exact E and ν, by the parabola c (σ-σ_ci)² that fits best up to the largest ε_A; preferred
//   lateral compliance  the stress beyond which the lateral strain grows at more than 1.2 times its elastic rate
//                       (inverse tangent lateral stiffness: Ghazvinian et al., 46th US Rock Mech. Symp., 2012). It is
//                       found without a window, as the stress up to the largest ε_A at which the lateral strain is
//                       farthest below a line of that slope. Its distance from `opening` is the error of `opening`
//   first percent       the stress at which 1 % of the bonds broken at the peak have broken (usual in PFC)
//   break of counts     the stress at which the slope of the number of broken bonds against stress changes, between 0
//                       and 0.8 of the peak (statistics/broken_stick.hpp), with a 95 % interval
//   crack strain        the stress at which ε_A minus its elastic part, (1-ν)(σ-p)/E, leaves a band of three standard
//                       deviations about its mean below a quarter of the peak, and stays outside to the largest ε_A
//   lateral strain      the stress at which the curve of lateral strain against stress is farthest from its chord up
//                       to the largest ε_A (Nicksiar & Martin, Rock Mech. Rock Eng. 45, 2012)
// tests/benchmarks/results/readings.md compares the scatter and bias of these definitions. The stresses `opening` and
// `lateral compliance` do not depend on the peak.
//
// A value that cannot be determined is NaN. This occurs if there are no side particles, if no bond breaks up to the
// largest ε_A, or if the largest ε_A is among the first nine rows. The break of counts needs ten bursts of breakages.
// Stresses are in N/m, or Pa in area units.
// Tested by tests/specimens/measures/crack_thresholds_test.cpp.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Crack initiation and crack damage stresses, N/m.
struct CrackThresholds {
    double opening = std::numeric_limits<double>::quiet_NaN();
    double lateral_compliance = std::numeric_limits<double>::quiet_NaN();
    double first_percent = std::numeric_limits<double>::quiet_NaN();
    double count_break = std::numeric_limits<double>::quiet_NaN();  ///< low and high are the ends of its 95 % interval
    double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
    double crack_strain = std::numeric_limits<double>::quiet_NaN();
    double lateral_strain = std::numeric_limits<double>::quiet_NaN();
    double damage = std::numeric_limits<double>::quiet_NaN();  ///< crack damage stress (preferred estimate)
    double damage_error = std::numeric_limits<double>::quiet_NaN();
    double damage_strain = std::numeric_limits<double>::quiet_NaN();  ///< axial strain at crack damage
    double reversal = std::numeric_limits<double>::quiet_NaN();       ///< stress at the largest area strain

    double initiation() const { return opening; }  ///< the preferred estimate of the crack initiation stress
    double initiation_error() const;               ///< distance between opening and lateral_compliance
    /// Largest minus smallest of the six initiation stresses; NaN if fewer than two are known.
    double spread() const;
};

/// @param confining_pressure  the pressure on the sides when loading begins; the resulting stresses are axial stresses
/// @param rows  rows of a compression test
/// @param youngs_modulus, poissons_ratio  moduli from the linear solution; if NaN, opening, lateral_compliance and
/// crack_strain are not determined
CrackThresholds find_crack_thresholds(std::span<const CurveRow> rows, std::int64_t peak_row, double youngs_modulus,
                                      double poissons_ratio, double confining_pressure = 0.0);

}  // namespace crackle
