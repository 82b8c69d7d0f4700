// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of pieces: the share of all area in pieces larger than x is exp(-(x/x0)^n) (Rosin & Rammler, J. Inst. Fuel 7,
// 1933), and its parameters by maximum likelihood.
// Tested by tests/specimens/statistics/rosin_rammler_test.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace crackle {

struct RosinRammler {
    double size = std::numeric_limits<double>::quiet_NaN();      ///< x0: 1/e of the area lies in larger pieces
    double exponent = std::numeric_limits<double>::quiet_NaN();  ///< n: the larger, the more alike the pieces
    std::size_t pieces = 0;
};

inline constexpr std::size_t fewest_pieces = 5;

/// Weibull's distribution of size, each piece with the weight of its area (a share of area is what the law states),
/// cut off below `least` (Σ w (log of the density at x) - log of the share above `least` at its maximum). Not a number
/// of fewer than five pieces above, of pieces all alike, or spread so wide that n would be 0 (a power law).
/// @param sizes, areas of as many pieces
RosinRammler fit_rosin_rammler(std::span<const double> sizes, std::span<const double> areas, double least);

/// Half of the area lies in pieces of at most this size, linear between the sizes of two pieces; not a number of none.
double median_size(std::span<const double> sizes, std::span<const double> areas);

}  // namespace crackle
