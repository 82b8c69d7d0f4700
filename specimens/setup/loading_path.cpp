// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/loading_path.hpp"

#include <algorithm>

namespace crackle {

void LoadingPath::change_speed(double wanted, double most_change, double strain) {
    const double before = speed, so_far = travel(strain);
    speed = std::clamp(wanted, before - most_change, before + most_change);
    if (std::signbit(speed) == std::signbit(before)) return;
    travelled = so_far;
    turned_at = strain;
}

double largest_acceleration(const RateRule& rule) {
    return 2.0 * rule.tolerance * rule.first_strain / (rule.transit_time * rule.transit_time);
}

}  // namespace crackle
