// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/axis.hpp"

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <cmath>

namespace crackle {
namespace {

constexpr std::array<unsigned, most_design_axes> primes{2,  3,  5,  7,  11, 13, 17, 19, 23, 29,
                                                        31, 37, 41, 43, 47, 53, 59, 61, 67, 71};

/// Radical inverse of `number`: its digits in `base`, mirrored about the radix point.
double radical_inverse(std::size_t number, unsigned base) {
    double value = 0.0, weight = 1.0;
    for (; number > 0; number /= base) {
        weight /= base;
        value += weight * static_cast<double>(number % base);
    }
    return value;
}

}  // namespace

CaseValue Axis::at(double share) const {
    const double value = spacing == Spacing::linear ? from + share * (to - from) : from * std::pow(to / from, share);
    if (whole) return static_cast<std::int64_t>(std::llround(value));
    return value;
}

std::vector<CaseValue> spaced_values(const Axis& axis, std::int64_t count) {
    std::vector<CaseValue> values;
    for (std::int64_t k = 0; k < count; ++k)
        values.push_back(axis.at(static_cast<double>(k) / static_cast<double>(count - 1)));
    values.erase(std::unique(values.begin(), values.end()), values.end());  // rounding may repeat integers
    return values;
}

std::vector<std::vector<double>> design_points(Sequence sequence, std::size_t points, std::size_t dimensions) {
    std::vector<std::vector<double>> all(points, std::vector<double>(dimensions));
    if (sequence == Sequence::halton) {
        // The sequence begins at 1, since point 0 is a corner of the cube.
        for (std::size_t k = 0; k < points; ++k)
            for (std::size_t d = 0; d < dimensions; ++d) all[k][d] = radical_inverse(k + 1, primes[d]);
        return all;
    }
    boost::random::sobol generator(dimensions);  // the generator skips point 0, a corner of the cube
    const double range = std::ldexp(1.0, 64);
    for (auto& point : all)
        for (double& share : point) share = static_cast<double>(generator()) / range;
    return all;
}

}  // namespace crackle
