// SPDX-License-Identifier: GPL-3.0-or-later
// Clipping by Liang & Barsky, ACM Trans. Graph. 3, 1984.
#include "specimens/joints/clipping.hpp"

#include <array>

namespace crackle {

std::optional<std::pair<Vec2, Vec2>> clipped(Vec2 a, Vec2 b, const Domain& box) {
    double from = 0.0, to = 1.0;
    int from_side = -1, to_side = -1;
    const Vec2 d = b - a;
    const std::array<double, 4> along{-d.x, d.x, -d.y, d.y};
    const std::array<double, 4> room{a.x - box.x1, box.x2 - a.x, a.y - box.y1, box.y2 - a.y};
    for (int side = 0; side < 4; ++side) {
        const auto k = static_cast<std::size_t>(side);
        if (along[k] == 0.0) {
            if (room[k] < 0.0) return std::nullopt;
            continue;
        }
        const double share = room[k] / along[k];
        if (along[k] < 0.0 && share > from) from = share, from_side = side;
        if (along[k] > 0.0 && share < to) to = share, to_side = side;
    }
    if (!(from < to)) return std::nullopt;
    const auto at = [&](double share, int side) {
        Vec2 p = a + share * d;
        if (side == 0) p.x = box.x1;
        if (side == 1) p.x = box.x2;
        if (side == 2) p.y = box.y1;
        if (side == 3) p.y = box.y2;
        return p;
    };
    const Vec2 p = from_side < 0 ? a : at(from, from_side), q = to_side < 0 ? b : at(to, to_side);
    if (p == q) return std::nullopt;
    return std::pair{p, q};
}

std::vector<std::vector<Vec2>> clipped(const std::vector<Vec2>& points, const Domain& box) {
    std::vector<std::vector<Vec2>> pieces;
    bool goes_on = false;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        if (points[k] == points[k + 1]) continue;
        const auto part = clipped(points[k], points[k + 1], box);
        if (!part) {
            goes_on = false;
            continue;
        }
        if (!goes_on || pieces.back().back() != part->first) pieces.push_back({part->first});
        pieces.back().push_back(part->second);
        goes_on = part->second == points[k + 1];
    }
    return pieces;
}

}  // namespace crackle
