// SPDX-License-Identifier: GPL-3.0-or-later

#include "mesher/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesher/inset.hpp"
#include "mesher/partition.hpp"

namespace crackle {

void MeshBuilder::Sum::add(double value) {
    const double next = total_ + value;
    lost_ += std::abs(total_) >= std::abs(value) ? (total_ - next) + value : (value - next) + total_;
    total_ = next;
}

MeshBuilder::MeshBuilder(const Rectangle& domain, std::size_t cells, std::size_t corners) : domain_(domain) {
    mesh_.cells.reserve(cells);
    mesh_.corners.reserve(corners);
}

Cell& MeshBuilder::add(std::span<const Point> before, std::span<const Point> after) {
    Cell& cell = mesh_.cells.emplace_back();
    cell.first_corner = static_cast<std::uint32_t>(mesh_.corners.size());
    cell.corner_count = static_cast<std::uint32_t>(after.size());
    cell.sides = sides_of(before, domain_);
    mesh_.corners.insert(mesh_.corners.end(), after.begin(), after.end());
    cell.area = polygon_area(before);
    area_before_.add(cell.area);
    area_after_.add(polygon_area(after));
    measure_edges(after);
    return cell;
}

namespace {

/// Index of the edge of the original outline from which an edge of the inset outline comes. A convex outline has only
/// one edge in that direction; with flat corners there may be several, of which the nearest is chosen.
std::size_t edge_of(std::span<const Point> before, Point a, Point b) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    const double length = distance(a, b);
    for (std::size_t k = 0; k < before.size(); ++k) {
        const Point p = before[k], q = before[k + 1 == before.size() ? 0 : k + 1];
        const double along = distance(p, q), x = (q.x - p.x) / along, y = (q.y - p.y) / along;
        const double turn = std::abs(x * (b.y - a.y) - y * (b.x - a.x)) / length;
        if (x * (b.x - a.x) + y * (b.y - a.y) <= 0.0) continue;
        // The distance beyond the edge's ends is added to the deviation in direction, so that the nearest of several
        // collinear edges is chosen.
        const double middle = x * (0.5 * (a.x + b.x) - p.x) + y * (0.5 * (a.y + b.y) - p.y);
        const double off = std::max({0.0, -middle, middle - along}) / (along + length);
        if (turn + 1e-9 * off >= least) continue;
        least = turn + 1e-9 * off;
        best = k;
    }
    return best;
}

}  // namespace

Cell& MeshBuilder::add(std::span<const Point> before, std::span<const Point> after, std::span<const int> traces,
                       bool edges_kept) {
    mesh_.edge_traces.reserve(
        mesh_.corners.capacity());  // there is one entry per corner, so no further allocation is needed
    if (std::ranges::all_of(traces, [](int trace) { return trace < 0; })) {
        mesh_.edge_traces.insert(mesh_.edge_traces.end(), after.size(), -1);
        return add(before, after);
    }
    for (std::size_t k = 0; k < after.size(); ++k) {
        const int trace = traces[edges_kept ? k : edge_of(before, after[k], after[k + 1 == after.size() ? 0 : k + 1])];
        mesh_.edge_traces.push_back(trace);
        if (trace >= 0) ++mesh_.report.trace_edges;
    }
    for (std::size_t k = 0; k < before.size(); ++k)
        if (traces[k] >= 0) trace_length_.add(0.5 * distance(before[k], before[k + 1 == before.size() ? 0 : k + 1]));
    return add(before, after);
}

// Angles are compared by a monotonic function that needs no inverse trigonometric functions: sin up to 90 degrees, 2 -
// sin above.
void MeshBuilder::measure_edges(std::span<const Point> outline) {
    const Point last = outline.back();
    Point in{outline.front().x - last.x, outline.front().y - last.y};
    double in_length = std::sqrt(in.x * in.x + in.y * in.y);
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point here = outline[k], after = outline[k + 1 == outline.size() ? 0 : k + 1];
        const Point out{after.x - here.x, after.y - here.y};
        const double out_length = std::sqrt(out.x * out.x + out.y * out.y);
        const double sine = (in.x * out.y - in.y * out.x) / (in_length * out_length);
        smallest_corner_ = std::min(smallest_corner_, in.x * out.x + in.y * out.y < 0.0 ? sine : 2.0 - sine);
        shortest_edge_ = std::min(shortest_edge_, out_length);
        in = out;
        in_length = out_length;
    }
}

Mesh MeshBuilder::finish() {
    MeshReport& report = mesh_.report;
    report.cells = static_cast<std::int64_t>(mesh_.cells.size());
    report.segments = static_cast<std::int64_t>(mesh_.corners.size());
    report.area_before_inset = area_before_.value();
    report.area_after_inset = area_after_.value();
    report.trace_length = trace_length_.value();
    report.shortest_edge = shortest_edge_;
    const bool acute = smallest_corner_ <= 1.0;
    const double quarter = std::asin(std::clamp(acute ? smallest_corner_ : 2.0 - smallest_corner_, -1.0, 1.0));
    // The last digit of asin() depends on the processor; nine decimal places, in degrees, are sufficient.
    report.smallest_angle =
        1e-9 * std::round(1e9 * (acute ? quarter : std::numbers::pi - quarter) * 180.0 / std::numbers::pi);
    return std::move(mesh_);
}

}  // namespace crackle
