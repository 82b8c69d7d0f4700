// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli and ratios read off a stress-strain curve, by least squares over windows that are defined by the curve's peak.
#pragma once

#include <cstdint>
#include <span>

#include "specimens/observers/curve.hpp"

namespace crackle {

/// Slope of a straight line through rows, with what happened in them. Not a number where fewer than three rows fall in.
struct Tangent {
    double modulus;         // N/m
    double poissons_ratio;  ///< -(lateral strain)/(axial strain), tension positive in both
    std::int64_t rows = 0;
    double strain_to = 0.0;
    std::int64_t bonds_broken = 0;     ///< within the window
    std::int64_t points_sliding = 0;   ///< at its end
    std::int64_t contacts_gained = 0;  ///< touching without a bond, more than at its beginning
};

/// Axial less lateral strain, shortening and widening positive: the share by which the specimen's area has shrunk.
double area_strain(const CurveRow& row, bool compression);

/// Over the first twentieth of the strain at peak: the initial tangent modulus.
Tangent initial_tangent(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// At half the peak: over the rows from where the stress first reaches 40 % of the peak to where it first reaches 60 %.
Tangent tangent_at_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// Of average modulus: over the 30 % of the peak stress, up to it, that a straight line fits best (ISRM's average
/// modulus, Int. J. Rock Mech. Min. Sci. 16, 1979); windows begin at every hundredth of the peak.
Tangent tangent_of_straightest(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// The chord from the first row to where the stress first reaches half the peak: ISRM's secant modulus, and the ratio
/// of the strains.
Tangent secant_to_half_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// How the stress falls beyond the peak: over the rows from where it has first fallen to 90 % of it to where it has to
/// 60 %. Negative of a curve that falls (class I); not a number where it does not.
Tangent tangent_beyond_peak(std::span<const CurveRow> rows, std::int64_t peak_row, bool compression);

/// (M - E)/M, M the modulus beyond the peak: what breaking takes over what was stored, 1 of a curve that drops at once,
/// the larger the more slowly it falls (Tarasov & Potvin, IJRMMS 59, 2013).
double brittleness_index(double youngs_modulus, double modulus_beyond_peak);

/// Largest difference of the two platens' stresses up to the peak, over the peak stress: what inertia and damping still
/// do.
double platen_out_of_balance(std::span<const CurveRow> rows, std::int64_t peak_row);

}  // namespace crackle
