// SPDX-License-Identifier: GPL-3.0-or-later
// Small operations on convex polygons that the partition and the inset share.
// Tested by tests/mesher/voronoi_test.cpp.

#include <algorithm>
#include <cmath>

#include "mesher/partition.hpp"

namespace crackle {

double coordinate_scale(const Rectangle& domain) {
    return std::max({std::abs(domain.x1), std::abs(domain.x2), std::abs(domain.y1), std::abs(domain.y2)});
}

void clip(std::vector<Point>& polygon, double nx, double ny, double offset, std::vector<Point>& scratch) {
    scratch.clear();
    const std::size_t count = polygon.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Point a = polygon[k];
        const Point b = polygon[k + 1 == count ? 0 : k + 1];
        const double height_a = nx * a.x + ny * a.y - offset;
        const double height_b = nx * b.x + ny * b.y - offset;
        if (height_a >= 0.0) scratch.push_back(a);
        if ((height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0)) {
            // From the outer end, whichever way round the edge is walked, so that neighbours get the same point.
            const Point& outer = height_a < 0.0 ? a : b;
            const Point& inner = height_a < 0.0 ? b : a;
            const double low = std::min(height_a, height_b);
            const double share = low / (low - std::max(height_a, height_b));
            scratch.push_back({outer.x + share * (inner.x - outer.x), outer.y + share * (inner.y - outer.y)});
        }
    }
    polygon.swap(scratch);
}

std::uint8_t sides_of(std::span<const Point> polygon, const Rectangle& domain) {
    unsigned sides = 0;
    unsigned before = sides_at(polygon.back(), domain);
    for (const Point& corner : polygon) {
        const unsigned here = sides_at(corner, domain);
        sides |= before & here;
        before = here;
    }
    return static_cast<std::uint8_t>(sides);
}

}  // namespace crackle
