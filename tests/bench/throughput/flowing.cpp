// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/throughput/flowing.hpp"

#include <algorithm>
#include <cmath>

#include "specimens/making/lattices.hpp"
#include "tests/bench/throughput/timed_test.hpp"
#include "tests/bench/throughput/walls.hpp"

namespace crackle::throughput {
namespace {

constexpr double gravity = 9.81;          // m/s2
constexpr double hexagon_apothem = 0.02;  // m
constexpr double thick = 1e-3;            // m
constexpr double runout = 20.0;           // width of the domain in widths of the column; nothing reaches the far wall

}  // namespace

FlowingColumn flowing_column(std::int64_t count, bool polygons) {
    Scene scene;
    if (polygons) {
        const int columns = std::max(3, static_cast<int>(std::lround(std::sqrt(static_cast<double>(count) / 2.0))));
        const int rows = std::max(3, static_cast<int>(count / columns));
        scene = honeycomb(columns, rows, hexagon_apothem, thick, timed_rock());
        wall_in(scene, thick);
    } else {
        scene = timed_discs(count);
    }
    scene.gravity = {0.0, -gravity};
    scene.domain.x2 = scene.domain.x1 + runout * (scene.domain.x2 - scene.domain.x1);
    const Vec2 corner{scene.domain.x1, scene.domain.y1};
    const double height = scene.domain.y2 - scene.domain.y1, pace = 0.5 * std::sqrt(gravity / height);
    for (Body& body : scene.bodies) {
        const Vec2 place =
            (body.circle_count > 0 ? scene.circles[body.first_circle].centre : scene.vertices[body.first_vertex]) -
            corner;
        body.velocity = {pace * place.x, -pace * place.y};
    }
    scene.domain.y2 += height;
    return {scene, 0.25 / pace};
}

}  // namespace crackle::throughput
