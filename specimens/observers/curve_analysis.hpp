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

/// Largest difference of the two platens' stresses up to the peak, over the peak stress: what inertia and damping still
/// do.
double platen_out_of_balance(std::span<const CurveRow> rows, std::int64_t peak_row);

}  // namespace crackle
