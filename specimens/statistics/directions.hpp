// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of the directions of undirected lines. Angles are doubled (Mardia & Jupp, Directional Statistics, 2000,
// 1.1 and 6.3).
// Tested by tests/specimens/statistics/directions_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace crackle {

inline constexpr std::size_t rose_bins = 18;
inline constexpr double rose_bin_width = 10.0;  // degrees

/// Direction of a line, in [0, 180). @param angle  degrees
double line_direction(double angle);

/// Weighted lines, binned by direction.
struct Rose {
    /// Total weight of the lines in each bin over 180 degrees, counter-clockwise from the x axis.
    std::array<double, rose_bins> weights{};
    double begins = 0.0;  ///< degrees, edge of the first bin
    std::size_t count = 0;
    double weight = 0.0;              ///< sum of the weights
    double cosine = 0.0, sine = 0.0;  ///< weighted sums of cosine and sine of the doubled angle
    double squares = 0.0;             ///< sum of the squared weights

    /// Adds a line. @param angle  rad, in any range
    void add(double angle, double line_weight);

    /// Mean direction of the lines, degrees from 0 to 180; NaN without lines.
    double mean_direction() const;
    /// Length of the mean vector of the doubled angles: 0 for uniform directions, 1 for parallel lines; NaN without
    /// lines.
    double resultant() const;
    /// Rayleigh's test: probability that lines without a preferred direction have at least this resultant; NaN without
    /// lines. It uses z = n R², with the equivalent number of lines n = (Σw)²/Σw², and the correction to order 1/n of
    /// Mardia & Jupp 6.3.5. The lines are assumed to be independent; neighbouring lines of one crack are not.
    double rayleigh() const;
};

}  // namespace crackle
