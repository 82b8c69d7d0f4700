// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/check_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mesher/partition.hpp"

namespace crackle {
namespace {

// Limits that prevent overflow and underflow of squared lengths.
constexpr double longest_length = 1e100, shortest_length = 1e-100;

void check_lengths(const Rectangle& domain, const MeshRequest& request) {
    for (const double bound : {domain.x1, domain.x2, domain.y1, domain.y2}) {
        if (!std::isfinite(bound))
            throw MeshError(fmt::format("mesh: domain: found {}, expected finite numbers", bound));
    }
    const double width = domain.x2 - domain.x1, height = domain.y2 - domain.y1;
    if (!(width > 0.0 && height > 0.0)) {
        throw MeshError(fmt::format("mesh: domain: found x {} to {}, y {} to {}, expected x1 < x2 and y1 < y2",
                                    domain.x1, domain.x2, domain.y1, domain.y2));
    }
    if (coordinate_scale(domain) > longest_length || std::min(width, height) < shortest_length) {
        throw MeshError(
            fmt::format("mesh: domain: found {} by {}, expected lengths between {} and {}; choose another unit", width,
                        height, shortest_length, longest_length));
    }
    if (!(request.mesh_gap >= 0.0 && std::isfinite(request.mesh_gap))) {
        throw MeshError(fmt::format("mesh: thick: found {}, expected a length >= 0", request.mesh_gap));
    }
    if (request.inset && !(*request.inset >= 0.0 && std::isfinite(*request.inset))) {
        throw MeshError(fmt::format("mesh: inset: found {}, expected a length >= 0", *request.inset));
    }
}

void check_centres(std::span<const CellCentre> centres, const Rectangle& domain) {
    if (centres.empty()) throw MeshError("mesh: found no centres, expected at least one");
    // There are about twice as many triangles as centres. Centres are indexed by int, and corners of triangles by
    // 32-bit integers.
    constexpr std::size_t most = std::numeric_limits<int>::max() / 4;
    if (centres.size() > most)
        throw MeshError(fmt::format("mesh: found {} centres, expected at most {}", centres.size(), most));
    for (std::size_t k = 0; k < centres.size(); ++k) {
        const CellCentre& s = centres[k];
        if (!std::isfinite(s.x) || !std::isfinite(s.y)) {
            throw MeshError(fmt::format("mesh: found centre {} at ({}, {}), expected finite coordinates", k, s.x, s.y),
                            {static_cast<int>(k)});
        }
        if (s.x < domain.x1 || s.x > domain.x2 || s.y < domain.y1 || s.y > domain.y2) {
            throw MeshError(
                fmt::format("mesh: found centre {} at ({:.9g}, {:.9g}), expected it inside the domain, x from {:.9g} "
                            "to {:.9g} and y from {:.9g} to {:.9g}; remove the centre or widen the domain",
                            k, s.x, s.y, domain.x1, domain.x2, domain.y1, domain.y2),
                {static_cast<int>(k)});
        }
    }
}

double twice_area_of(Point a, Point b, Point p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

void check_outline(std::span<const CellCentre> centres, const MeshRequest& request) {
    const std::vector<Point>& outline = request.outline;
    if (outline.empty()) return;
    bool convex = outline.size() >= 3;
    for (std::size_t k = 0; k < outline.size(); ++k)
        convex = convex &&
                 twice_area_of(outline[k], outline[(k + 1) % outline.size()], outline[(k + 2) % outline.size()]) > 0.0;
    if (!convex)
        throw MeshError(
            fmt::format("mesh: outline: found {} corners that do not all turn left, expected a convex polygon of at "
                        "least three corners in counter-clockwise order",
                        outline.size()));
    for (std::size_t k = 0; k < centres.size(); ++k) {
        if (depth_within(outline, centres[k]) >= 0.0) continue;
        throw MeshError(fmt::format("mesh: found centre {} at ({:.9g}, {:.9g}), expected it inside the outline", k,
                                    centres[k].x, centres[k].y),
                        {static_cast<int>(k)});
    }
}

void check_traces(const Rectangle& domain, const MeshRequest& request) {
    if (request.traces.empty()) return;
    if (request.boundary != Boundary::domain || !request.outline.empty()) {
        throw MeshError(fmt::format(
            "mesh: found {} traces together with {}, expected cells that fill the whole domain if there are traces",
            request.traces.size(),
            request.outline.empty() ? "triangles that end at the outermost centres" : "an outline"));
    }
    if (request.kind == MeshKind::voronoi && request.merge_destroyed)
        throw MeshError(
            "mesh: found traces together with merging of Voronoi cells, expected no merging, because it would separate "
            "the pairs of seeds along traces");
    for (std::size_t t = 0; t < request.traces.size(); ++t) {
        const std::vector<Point>& trace = request.traces[t];
        if (trace.size() < 2)
            throw MeshError(fmt::format("mesh: found trace {} with fewer than two points, expected at least two", t));
        for (std::size_t k = 0; k < trace.size(); ++k) {
            const Point p = trace[k];
            const bool inside = p.x >= domain.x1 && p.x <= domain.x2 && p.y >= domain.y1 && p.y <= domain.y2;
            if (inside && (k == 0 || p != trace[k - 1])) continue;
            throw MeshError(fmt::format("mesh: found trace {} with a point at ({:.9g}, {:.9g}), expected points that "
                                        "lie inside the domain and differ from the point before them",
                                        t, p.x, p.y),
                            {}, {static_cast<int>(t)});
        }
    }
}

}  // namespace

double depth_within(std::span<const Point> outline, Point p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        least = std::min(least, twice_area_of(a, b, p) / distance(a, b));
    }
    return least;
}

void check_request(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request) {
    check_lengths(domain, request);
    check_centres(centres, domain);
    check_outline(centres, request);
    check_traces(domain, request);
}

}  // namespace crackle
