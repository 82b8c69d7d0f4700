// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of lines, which point both ways: angles are taken twice round (Mardia & Jupp, Directional Statistics,
// 2000, 1.1 and 6.3). Tested by tests/specimens/statistics/directions_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace crackle {

inline constexpr std::size_t rose_bins = 18;
inline constexpr double rose_bin_width = 10.0;  // degrees

/// Of a line, to [0, 180). @param angle degrees
double line_direction(double angle);

/// Lines by direction, weighted.
struct Rose {
    std::array<double, rose_bins> weights{};  ///< by bins once round 180 degrees, counter-clockwise from the x axis
    double begins = 0.0;                      ///< degrees, edge of the first bin
    std::size_t count = 0;
    double weight = 0.0;              ///< of all
    double cosine = 0.0, sine = 0.0;  ///< weighted sums at twice the angle
    double squares = 0.0;             ///< of the weights

    /// @param angle rad, any turn of it
    void add(double angle, double line_weight);

    /// Of the mean line, degrees from 0 to 180; not a number without lines.
    double mean_direction() const;
    /// Length of the mean vector at twice the angle: 0 of lines all round, 1 of parallel ones; not a number without.
    double resultant() const;
    /// Probability that lines of no preferred direction have at least this resultant (Rayleigh; z = n R², n the lines
    /// that equal weights would need, (Σw)²/Σw², and the correction to order 1/n of Mardia & Jupp 6.3.5); not a number
    /// without lines. It takes them for independent, which neighbours of one crack are not.
    double rayleigh() const;
};

}  // namespace crackle
