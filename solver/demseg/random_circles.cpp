// SPDX-License-Identifier: GPL-3.0-or-later
// See random_circles.hpp.

#include "solver/demseg/random_circles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "solver/errors.hpp"

namespace crackle {
namespace {

/// Uniform on [low, high): 53 random bits.
double uniform(std::mt19937_64& generator, double low, double high) {
    constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
    return low + (high - low) * (static_cast<double>(generator() >> 11) * unit);
}

}  // namespace

std::int64_t random_circle_count(const RandomGeometry& geometry) {
    const double r1 = geometry.radius_min, r2 = geometry.radius_max;
    const double area = (geometry.domain.x2 - geometry.domain.x1) * (geometry.domain.y2 - geometry.domain.y1);
    const double mean_square = (r1 * r1 + r1 * r2 + r2 * r2) / 3.0;
    const double count = std::round(area / ((1.0 + geometry.void_ratio) * std::numbers::pi * mean_square));
    if (!(count >= 1.0 && count <= 1e8)) {
        throw InputError(fmt::format(
            "in_gm.dat: random circles: found {} of them by domain, radii and void ratio, expected 1 to 1e8", count));
    }
    return static_cast<std::int64_t>(count);
}

DeckGeometry make_random_circles(const RandomGeometry& geometry, std::uint64_t seed) {
    const Domain& domain = geometry.domain;
    const double room = std::min(domain.x2 - domain.x1, domain.y2 - domain.y1);
    if (2.0 * geometry.radius_max > room) {
        throw InputError(fmt::format("in_gm.dat: rmax: found {}, expected at most half the domain's smaller side, {}",
                                     geometry.radius_max, 0.5 * room));
    }
    DeckGeometry result;
    Scene& scene = result.scene;
    scene.time_step = geometry.time_step;
    scene.gravity = geometry.gravity;
    scene.materials = geometry.materials;
    scene.domain = domain;
    scene.thick = geometry.thick;
    scene.first_kick = FirstKick::full;
    scene.bare_segment_width = deck_bare_segment_width;
    std::mt19937_64 generator(seed);
    const std::int64_t count = random_circle_count(geometry);
    for (std::int64_t k = 1; k <= count; ++k) {
        CircleElement circle;
        circle.radius = uniform(generator, geometry.radius_min, geometry.radius_max);
        circle.centre.x = uniform(generator, domain.x1 + circle.radius, domain.x2 - circle.radius);
        circle.centre.y = uniform(generator, domain.y1 + circle.radius, domain.y2 - circle.radius);
        scene.add_circle_body(static_cast<int>(k), geometry.material, circle);
    }
    validate(scene);
    return result;
}

}  // namespace crackle
