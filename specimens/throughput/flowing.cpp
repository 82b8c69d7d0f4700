// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/throughput/flowing.hpp"

#include <algorithm>
#include <cmath>

#include "specimens/catalogue/lattices.hpp"
#include "specimens/throughput/timed_test.hpp"

namespace crackle::throughput {
namespace {

constexpr double gravity = 9.81;  // m/s2
constexpr double apothem = 0.02;  // m, of hexagons
constexpr double thick = 1e-3;    // m
constexpr double runout = 20.0;   // times the column's width: nothing reaches the far wall

}  // namespace

Scene flowing_column(std::int64_t count, bool polygons) {
    Scene scene;
    if (polygons) {
        const int columns = std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) / 2.0))));
        const int rows = std::max(3, static_cast<int>(count / columns));
        scene = honeycomb(columns, rows, apothem, thick, timed_rock());
        Domain& domain = scene.domain;
        domain.x1 = domain.y1 = 1e300;
        domain.x2 = domain.y2 = -1e300;
        for (const Vec2& corner : scene.vertices) {
            domain.x1 = std::min(domain.x1, corner.x - thick);
            domain.x2 = std::max(domain.x2, corner.x + thick);
            domain.y1 = std::min(domain.y1, corner.y - thick);
            domain.y2 = std::max(domain.y2, corner.y + thick);
        }
        domain.wall_present = {true, true, true, true};
    } else {
        scene = timed_discs(count);
    }
    scene.gravity = {0.0, -gravity};
    scene.domain.x2 = scene.domain.x1 + runout * (scene.domain.x2 - scene.domain.x1);
    scene.domain.y2 += scene.domain.y2 - scene.domain.y1;
    return scene;
}

}  // namespace crackle::throughput
