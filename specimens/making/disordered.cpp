// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/disordered.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "solver/base/errors.hpp"
#include "specimens/making/materials.hpp"
#include "specimens/statistics/random_numbers.hpp"

namespace crackle {
namespace {

/// Uniform random number in [-1, 1).
double swing(std::mt19937_64& generator) { return 2.0 * uniform_number(generator) - 1.0; }

/// Polygon obtained by moving every edge of the convex, counter-clockwise polygon `corners` inwards by `depth`.
std::vector<Vec2> inset(const std::vector<Vec2>& corners, double depth, int id) {
    const std::size_t n = corners.size();
    const auto direction = [&](std::size_t k) {
        const Vec2 d = corners[(k + 1) % n] - corners[k];
        return (1.0 / norm(d)) * d;
    };
    std::vector<Vec2> moved;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 before = direction((k + n - 1) % n), after = direction(k);
        // The new corner lies `depth` to the left of both edges, along the sum of their inward normals.
        const Vec2 both = perpendicular(before) + perpendicular(after);
        moved.push_back(corners[k] + (depth / (1.0 + dot(before, after))) * both);
    }
    for (std::size_t k = 0; k < n; ++k) {
        if (dot(moved[(k + 1) % n] - moved[k], direction(k)) <= 0.0) {
            throw InputError(
                fmt::format("shaken cell {}: found an edge that disappears with an inset of {} m, expected every edge "
                            "to remain; use a smaller gap or less shaking",
                            id, depth));
        }
    }
    return moved;
}

}  // namespace

Scene disordered_discs(const DisorderedDiscs& request, const Material& material) {
    Scene scene = open_scene(material);
    std::mt19937_64 generator(request.seed);
    const double spacing = 2.0 * request.radius - request.mean_overlap;
    int id = 0;
    for (int row = 0; row < request.rows; ++row) {
        const bool odd = row % 2 == 1;
        for (int column = 0; column < request.columns - (odd ? 1 : 0); ++column) {
            Vec2 centre{spacing * (column + (odd ? 0.5 : 0.0)), spacing * 0.5 * std::sqrt(3.0) * row};
            centre.x += request.shake * swing(generator);
            centre.y += request.shake * swing(generator);
            const double radius =
                request.radius + 0.5 * request.mean_overlap * request.overlap_spread * swing(generator);
            scene.add_circle_body(++id, 0, {centre, radius, 0.0});
        }
    }
    return scene;
}

Scene shaken_cells(const ShakenCells& request, const Material& material) {
    Scene scene = open_scene(material);
    scene.thick = request.gap;
    std::mt19937_64 generator(request.seed);
    const int across = request.columns + 1;
    std::vector<Vec2> nodes;
    for (int row = 0; row <= request.rows; ++row) {
        const bool end = row == 0 || row == request.rows;
        for (int column = 0; column < across; ++column) {
            const double dx = request.shake * swing(generator), dy = request.shake * swing(generator);
            nodes.push_back(
                {request.size * (column + dx), request.size * (row + (end && request.flat_ends ? 0.0 : dy))});
        }
    }
    int id = 0;
    const auto add = [&](const std::vector<Vec2>& corners) {
        ++id;
        scene.add_chain_body(id, 0, inset(corners, 0.5 * request.gap, id), true);
    };
    for (int row = 0; row < request.rows; ++row) {
        for (int column = 0; column < request.columns; ++column) {
            const auto node = [&](int dr, int dc) {
                const int index = (row + dr) * across + column + dc;
                return nodes[static_cast<std::size_t>(index)];
            };
            const Vec2 a = node(0, 0), b = node(0, 1), c = node(1, 1), d = node(1, 0);
            if (uniform_number(generator) < 0.5) {
                add({a, b, c, d});
            } else {
                add({a, b, c});
                add({a, c, d});
            }
        }
    }
    return scene;
}

}  // namespace crackle
