// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/walls.hpp"

#include <algorithm>
#include <limits>

namespace crackle::throughput {

void wall_in(Scene& scene, double room) {
    constexpr double distant = std::numeric_limits<double>::infinity();
    Domain domain{distant, -distant, distant, -distant, {true, true, true, true}};
    const auto enclose = [&](Vec2 place, double reach) {
        domain.x1 = std::min(domain.x1, place.x - reach);
        domain.x2 = std::max(domain.x2, place.x + reach);
        domain.y1 = std::min(domain.y1, place.y - reach);
        domain.y2 = std::max(domain.y2, place.y + reach);
    };
    for (const CircleElement& circle : scene.circles) enclose(circle.centre, circle.radius + room);
    for (const Vec2 corner : scene.vertices) enclose(corner, room);
    scene.domain = domain;
}

}  // namespace crackle::throughput
