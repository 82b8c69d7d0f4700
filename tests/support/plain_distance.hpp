// SPDX-License-Identifier: GPL-3.0-or-later
// Reference geometry: distances by exhaustive search in world coordinates, sharing no code with the solver.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::testing {

inline double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
    const double share = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
    return norm(p - (a + share * (b - a)));
}

/// Whether a point is inside a polygon, by the crossing number.
inline bool inside_polygon(Vec2 p, const std::vector<Vec2>& corners) {
    bool inside = false;
    for (std::size_t k = 0, l = corners.size() - 1; k < corners.size(); l = k++) {
        const Vec2 a = corners[k], b = corners[l];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)) inside = !inside;
    }
    return inside;
}

/// Distance to the outline, negative inside a closed one.
inline double distance_to_outline(Vec2 p, const std::vector<Vec2>& corners, bool closed) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t edges = closed ? corners.size() : corners.size() - 1;
    for (std::size_t k = 0; k < edges; ++k) {
        least = std::min(least, distance_to_segment(p, corners[k], corners[(k + 1) % corners.size()]));
    }
    return closed && inside_polygon(p, corners) ? -least : least;
}

}  // namespace crackle::testing
