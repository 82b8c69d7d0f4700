// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli and ratios of a stress-strain curve, by least squares over windows defined relative to the curve's peak.
#pragma once

#include <cstdint>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Slope of a straight line fitted to the rows in a window, with counts of events in this window. The slope is NaN for
/// fewer than three rows.
struct Tangent {
    double modulus;         // N/m
    double poissons_ratio;  ///< -(lateral strain)/(axial strain), extension positive in both
    std::int64_t rows = 0;
    double strain_to = 0.0;
    std::int64_t bonds_broken = 0;     ///< number of bonds that broke within the window
    std::int64_t points_sliding = 0;   ///< number of points that slide at the end of the window
    std::int64_t contacts_gained = 0;  ///< increase in the number of unbonded points that touch, over the window
};

/// Axial minus lateral strain, with shortening and widening positive: relative decrease of the specimen's area.
double area_strain(const CurveRow& row, bool compression);

/// Initial tangent modulus, over the first twentieth of the strain at the peak.
Tangent initial_tangent(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// Tangent modulus at half the peak, over the rows from where the stress first reaches 40 % of the peak to where it
/// first reaches 60 %.
Tangent tangent_at_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// Tangent over the window below the peak in which a straight line fits best. The window spans 30 % of the peak stress
/// and may start at any whole percent of it (ISRM's average modulus, Int. J. Rock Mech. Min. Sci. 16, 1979).
Tangent tangent_of_straightest(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// ISRM's secant modulus, and the ratio of the strains, from the first row to where the stress first reaches half the
/// peak.
Tangent secant_to_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// Slope after the peak, from where the stress has first fallen to 90 % of the peak to where it has fallen to 60 %. It
/// is NaN if the stress does not fall that far, or if the slope is not negative.
Tangent tangent_beyond_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// Brittleness index (M - E)/M, where M is the post-peak modulus: rupture energy divided by stored energy. It is 1 for
/// a vertical drop, and larger if the curve falls more gently (Tarasov & Potvin, IJRMMS 59, 2013).
double brittleness_index(double youngs_modulus, double modulus_beyond_peak);

/// Largest difference between the stresses of the two platens up to the peak, divided by the peak stress. It shows the
/// effect of inertia and damping.
double platen_out_of_balance(std::span<const CurveRow> rows, std::int64_t peak_row);

}  // namespace crackle
