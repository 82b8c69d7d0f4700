// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/lateral_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

constexpr double band_share = 0.05;  // half-width of the band, relative to the lateral strain at the strain ε1

}  // namespace

LateralRule lateral_rule_of(const parts::Loading& loading, const Places& places, const RateRule& rate,
                            double poissons_ratio) {
    LateralRule rule;
    if (!loading.by_lateral_strain()) return rule;
    if (!(poissons_ratio > 0.0)) {
        throw InputError(fmt::format(
            "{}: found a specimen whose Poisson's ratio is {:.3g}, expected one that widens; load it by axial strain",
            places.at(CaseKey::loading_control), poissons_ratio));
    }
    rule.ratio = poissons_ratio;
    rule.band = band_share * poissons_ratio * rate.first_strain;
    rule.acceleration = largest_acceleration(rate);
    return rule;
}

void follow_lateral(LoadingPath& path, const LateralRule& rule, double allowed, double strain, double lateral_strain,
                    double since) {
    if (std::isnan(path.lateral)) {
        path.lateral = lateral_strain;
        path.lateral_target = lateral_strain + rule.band;
    }
    path.lateral += (lateral_strain - path.lateral) / checks_per_transit;
    path.lateral_target = std::clamp(path.lateral_target + rule.ratio * allowed * since, path.lateral - rule.band,
                                     path.lateral + rule.band);
    const double ahead = (path.lateral_target - path.lateral) / rule.band;
    path.change_speed(allowed * ahead, rule.acceleration * since, strain);
}

}  // namespace crackle
