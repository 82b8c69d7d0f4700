// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/curve_points.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {

CurvePoints strain_and_stress(const NumberTable& table) {
    const std::vector<double>*strain = table.find("axial_strain"), *stress = table.find("axial_stress");
    CurvePoints points;
    for (std::size_t k = 0; strain != nullptr && stress != nullptr && k < strain->size(); ++k)
        if (std::isfinite((*strain)[k]) && std::isfinite((*stress)[k])) points.emplace_back((*strain)[k], (*stress)[k]);
    return points;
}

double stress_at(std::span<const std::pair<double, double>> curve, double strain) {
    const auto after = std::ranges::find_if(curve, [&](const auto& point) { return point.first >= strain; });
    if (after == curve.end()) return std::nan("");
    if (after == curve.begin()) return after->second;
    const auto before = after - 1;
    return std::lerp(before->second, after->second, (strain - before->first) / (after->first - before->first));
}

}  // namespace crackle
