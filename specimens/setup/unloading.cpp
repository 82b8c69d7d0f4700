// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/unloading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crackle {
namespace {

constexpr double creep_share = 0.05;  // creeping rate relative to the largest rate
// Fraction of the acceleration used for braking, because the speed is only chosen at intervals.
constexpr double brake_share = 0.7;

/// Strain until the platen must reverse; infinite if it need not reverse.
double way_to_turn(const LoadingPath& path, const UnloadRule& rule, double strain, double stress) {
    if (path.unloading) return (stress - rule.to * path.stress_at_turn) / rule.modulus;
    const auto next = static_cast<std::size_t>(path.unloaded);
    if (next >= rule.at.size()) return std::numeric_limits<double>::infinity();
    return rule.by_strain ? rule.at[next] - strain : (rule.at[next] - stress) / rule.modulus;
}

/// Largest speed at a given distance before a reversal, 1/s.
double speed_before(double way, const UnloadRule& rule, double allowed) {
    const double braking = std::sqrt(2.0 * brake_share * rule.acceleration * std::max(0.0, way));
    return std::min(allowed, std::max(rule.creep, braking));
}

}  // namespace

double UnloadRule::added_travel(double strain) const {
    double sum = 0.0;
    for (const double turn : at) {
        const double way = by_strain ? turn : turn / modulus;
        if (way < strain) sum += 2.0 * (1.0 - to) * way;
    }
    return sum;
}

UnloadRule unload_rule_of(const parts::Unloading& asked, const RateRule& rate, double modulus) {
    UnloadRule rule;
    if (asked.at.empty()) return rule;
    rule.by_strain = asked.by_strain;
    rule.at = asked.at;
    rule.to = asked.to;
    rule.acceleration = largest_acceleration(rate);
    rule.modulus = modulus;
    rule.creep = creep_share * largest_rate(rate);
    return rule;
}

double first_speed(const UnloadRule& rule, double allowed) {
    return speed_before(way_to_turn({}, rule, 0.0, 0.0), rule, allowed);
}

void turn_by_list(LoadingPath& path, const UnloadRule& rule, double allowed, double strain, double stress,
                  double since) {
    const double change = rule.acceleration * since;
    double way = way_to_turn(path, rule, strain, stress);
    if (way <= change * since) {
        if (!path.unloading) {
            ++path.unloaded;
            path.stress_at_turn = stress;
        }
        path.unloading = !path.unloading;
        way = way_to_turn(path, rule, strain, stress);
    }
    const double limit = speed_before(way, rule, allowed);
    path.change_speed(path.unloading ? -limit : limit, change, strain);
}

}  // namespace crackle
