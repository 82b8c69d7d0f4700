// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/statistics/directions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double line_direction(double angle) {
    const double within = angle - 180.0 * std::floor(angle / 180.0);
    return within < 180.0 ? within : 0.0;
}

void Rose::add(double angle, double line_weight) {
    const auto bin = static_cast<std::size_t>(line_direction(angle * degrees - begins) / rose_bin_width);
    weights[std::min(bin, rose_bins - 1)] += line_weight;
    ++count;
    weight += line_weight;
    squares += line_weight * line_weight;
    cosine += line_weight * correctly_rounded::cos(2.0 * angle);
    sine += line_weight * correctly_rounded::sin(2.0 * angle);
}

double Rose::mean_direction() const {
    return count == 0 ? none : line_direction(0.5 * degrees * correctly_rounded::atan2(sine, cosine));
}

double Rose::resultant() const { return count == 0 ? none : std::sqrt(cosine * cosine + sine * sine) / weight; }

double Rose::rayleigh() const {
    if (count == 0) return none;
    const double n = weight * weight / squares, z = n * resultant() * resultant();
    const double corrected = 1.0 + (2.0 * z - z * z) / (4.0 * n);
    return corrected > 0.0 ? std::min(correctly_rounded::exp(-z) * corrected, 1.0) : 0.0;
}

}  // namespace crackle
