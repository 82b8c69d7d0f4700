// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/side_bodies.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

namespace crackle {
namespace {

double distance_to_side(const Domain& domain, Wall side, Vec2 at) {
    return side == Wall::left ? at.x - domain.x1 : domain.x2 - at.x;
}

}  // namespace

bool circle_overlaps_side(const Scene& scene, const Body& body, Wall side) {
    const auto circles = std::span(scene.circles).subspan(body.first_circle, body.circle_count);
    return std::any_of(circles.begin(), circles.end(), [&](const CircleElement& circle) {
        return distance_to_side(scene.domain, side, circle.centre) < circle.radius;
    });
}

std::vector<int> polygons_on_side(const Scene& scene, Wall side) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2 v : scene.vertices) nearest = std::min(nearest, distance_to_side(scene.domain, side, v));
    // This tolerance is much smaller than an edge and much larger than round-off in the file.
    const double tolerance = 1e-6 * (scene.domain.x2 - scene.domain.x1);
    std::vector<int> ids;
    for (const Body& body : scene.bodies) {
        const auto corners = std::span(scene.vertices).subspan(body.first_vertex, body.vertex_count);
        const auto on_face = [&](Vec2 v) { return distance_to_side(scene.domain, side, v) <= nearest + tolerance; };
        if (std::count_if(corners.begin(), corners.end(), on_face) >= 2) ids.push_back(body.id);
    }
    return ids;
}

bool cell_on_side(const Cell& cell, Wall side, bool domain_boundary, const std::vector<char>& centre_touches) {
    if (domain_boundary) return side == Wall::left ? cell.on_left() : cell.on_right();
    const auto touches = [&](int seed) { return seed >= 0 && centre_touches[static_cast<std::size_t>(seed)] != 0; };
    return std::count_if(cell.centres.begin(), cell.centres.end(), touches) >= 2;
}

}  // namespace crackle
