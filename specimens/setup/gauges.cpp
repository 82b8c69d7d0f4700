// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace crackle {
namespace {

double mean_x(const World& world, const std::vector<BodyIndex>& bodies) {
    double sum = 0.0;
    for (const BodyIndex b : bodies) sum += world.bodies.state[b].x;
    return sum / static_cast<double>(bodies.size());
}

double mean_y(const World& world, const std::vector<BodyIndex>& bodies) {
    double sum = 0.0;
    for (const BodyIndex b : bodies) sum += world.bodies.state[b].y;
    return sum / static_cast<double>(bodies.size());
}

double lateral_distance(const World& world, const Gauges& gauges) {
    return mean_x(world, gauges.right) - mean_x(world, gauges.left);
}

double axial_distance(const World& world, const Gauges& gauges) {
    return mean_y(world, gauges.top) - mean_y(world, gauges.bottom);
}

/// Side particles with centres in the middle half of the height, away from the platens. For kinds of test that define
/// regions, all particles in these regions.
std::vector<BodyIndex> side_of_gauge(const World& world, const std::vector<int>& ids, bool uniaxial) {
    const Domain& domain = world.settings.domain;
    std::unordered_map<int, BodyIndex> index;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) index[world.bodies.info(b).id] = static_cast<BodyIndex>(b);
    const double middle = 0.5 * (domain.y1 + domain.y2);
    const double quarter = 0.25 * (domain.y2 - domain.y1);
    std::vector<BodyIndex> bodies;
    for (const int id : ids) {
        const BodyIndex b = index.at(id);
        if (!uniaxial || std::abs(world.bodies.state[b].y - middle) <= quarter) bodies.push_back(b);
    }
    return bodies;
}

}  // namespace

void Gauges::find_sides(const World& world, const Specimen& specimen, bool uniaxial) {
    left = side_of_gauge(world, specimen.left_ids, uniaxial);
    right = side_of_gauge(world, specimen.right_ids, uniaxial);
    if (!left.empty() && !right.empty()) lateral_length = lateral_distance(world, *this);
}

void Gauges::find_ends(const World& world, std::span<const BodyIndex> bodies, double low, double high,
                       double particle) {
    for (const BodyIndex b : bodies) {
        if (std::abs(world.bodies.state[b].y - low) <= 0.5 * particle) bottom.push_back(b);
        if (std::abs(world.bodies.state[b].y - high) <= 0.5 * particle) top.push_back(b);
    }
    if (!bottom.empty() && !top.empty()) axial_length = axial_distance(world, *this);
}

double Gauges::lateral_strain(const World& world) const {
    if (lateral_length == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return lateral_distance(world, *this) / lateral_length - 1.0;
}

double Gauges::axial_growth(const World& world) const {
    if (axial_length == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return axial_distance(world, *this) / axial_length - 1.0;
}

double Gauges::median_lateral_strain(const World& world, std::span<const StartPlace> start) const {
    const auto moved = [&](const std::vector<BodyIndex>& side) {
        std::vector<double> ways;
        ways.reserve(side.size());
        for (const BodyIndex b : side) ways.push_back(world.bodies.state[b].x - start[b].x);
        const auto half = ways.begin() + std::ssize(ways) / 2;
        std::ranges::nth_element(ways, half);
        return *half;
    };
    if (lateral_length == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return (moved(right) - moved(left)) / lateral_length;
}

void Gauges::strains_begin_at(const World& world) {
    if (lateral_length > 0.0) lateral_length = lateral_distance(world, *this);
    if (axial_length > 0.0) axial_length = axial_distance(world, *this);
}

}  // namespace crackle
