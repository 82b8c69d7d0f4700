// SPDX-License-Identifier: GPL-3.0-or-later
// Size distribution of fragments: the fraction of the area in pieces larger than x is exp(-(x/x0)^n) (Rosin & Rammler,
// J. Inst. Fuel 7, 1933). Its parameters are found by maximum likelihood.
// Tested by tests/specimens/statistics/rosin_rammler_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

/// Size distribution: a fraction exp(-(x/x0)^n) of the area lies in pieces larger than x.
struct RosinRammler {
    double size = std::numeric_limits<double>::quiet_NaN();      ///< x0, m: 1/e of the area lies in larger pieces
    double exponent = std::numeric_limits<double>::quiet_NaN();  ///< n; larger if the sizes are more uniform
    std::size_t pieces = 0;
};

inline constexpr std::size_t fewest_pieces = 5;

/// Fits a Weibull distribution of sizes, truncated below `least`, by maximum likelihood. Each piece has its area w as
/// weight, since the law gives fractions of area. The fit maximises Σ w (log of the density at x - log of the fraction
/// above `least`). The parameters are NaN for fewer than five pieces above `least` and for pieces of equal size. They
/// are also NaN if the sizes spread so widely that n would be 0 (a power law).
/// @param sizes, areas  sizes and areas of the pieces, in the same order
RosinRammler fit_rosin_rammler(std::span<const double> sizes, std::span<const double> areas, double least);

/// Size that divides the area in half, interpolated linearly between the sizes of two pieces; NaN if there are no
/// pieces.
double median_size(std::span<const double> sizes, std::span<const double> areas);

}  // namespace crackle
