// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/emission/source.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"

namespace crackle {
namespace {

constexpr double least_isotropic = 30.0;  // percent, positive for opening, negative for closing

double two_thirds_log10(double value) {
    if (!(value > 0.0)) return -std::numeric_limits<double>::infinity();
    return 2.0 / 3.0 * std::numbers::log10e * correctly_rounded::log(value);
}

}  // namespace

PrincipalMoments principal_moments(const MomentTensor& moment) {
    const double mean = 0.5 * (moment.xx + moment.yy), half = 0.5 * (moment.xx - moment.yy);
    const double shear = 0.5 * (moment.xy + moment.yx), radius = std::sqrt(half * half + shear * shear);
    return {mean + radius, mean - radius, 0.5 * correctly_rounded::atan2(shear, half)};
}

double scalar_moment(const MomentTensor& moment) {
    const PrincipalMoments m = principal_moments(moment);
    return std::sqrt(0.5 * (m.largest * m.largest + m.smallest * m.smallest));
}

double isotropic_percent(const MomentTensor& moment) {
    const PrincipalMoments m = principal_moments(moment);
    const double trace = moment.xx + moment.yy;
    return 100.0 * trace / (std::abs(trace) + (m.largest - m.smallest));
}

SourceType source_type(double percent) {
    if (percent > least_isotropic) return SourceType::opening;
    return percent < -least_isotropic ? SourceType::closing : SourceType::shear;
}

double moment_magnitude(double moment) { return two_thirds_log10(moment) - 6.0; }
double energy_magnitude(double energy) { return two_thirds_log10(energy) - 3.2; }

}  // namespace crackle
