// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/find_faces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/geometry/facing_edges.hpp"

namespace crackle {
namespace {

/// Largest distance between two edges that count as coincident, relative to the square root of the smaller cell's area.
/// It allows for the round-off of the inset and of its reversal, and for jaws whose chords lie slightly closer than
/// half the gap.
constexpr double flush_share = 1e-4;
/// Free sides shorter than this, relative to the square root of the cell's area, are ignored as round-off.
constexpr double shortest_side_share = 1e-6;

struct Box {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    void add(Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    bool meets(const Box& other, double reach) const {
        return low.x <= other.high.x + reach && other.low.x <= high.x + reach && low.y <= other.high.y + reach &&
               other.low.y <= high.y + reach;
    }
};

/// The outline of a polygon before the mesh was inset, and the parts of each edge that faces cover.
struct Cell {
    std::vector<OutsetEdge> edges;
    std::vector<std::vector<FacingPart>> covered;
    Box box;
    double size = 0.0;  // m, square root of the area
};

CellArea area_of(const std::vector<Vec2>& outline) {
    CellArea cell;
    const Vec2 origin = outline.front();
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 a = outline[k] - origin, b = outline[(k + 1) % outline.size()] - origin;
        const double twice = cross(a, b);
        cell.area += 0.5 * twice;
        cell.centroid = cell.centroid + (twice / 6.0) * (a + b);
    }
    cell.centroid = origin + (1.0 / cell.area) * cell.centroid;
    return cell;
}

/// Calls visit(i, j), i < j, for all pairs of bodies whose bounding boxes meet, in the order of the left edges of the
/// boxes.
template <class Visit>
void visit_near(const std::vector<Cell>& cells, double reach, Visit visit) {
    std::vector<BodyIndex> order;
    for (BodyIndex b = 0; b < cells.size(); ++b)
        if (!cells[b].edges.empty()) order.push_back(b);
    std::ranges::sort(order, [&](BodyIndex a, BodyIndex b) {
        return cells[a].box.low.x != cells[b].box.low.x ? cells[a].box.low.x < cells[b].box.low.x : a < b;
    });
    for (std::size_t n = 0; n < order.size(); ++n) {
        const Cell& one = cells[order[n]];
        for (std::size_t m = n + 1; m < order.size() && cells[order[m]].box.low.x <= one.box.high.x + reach; ++m)
            if (one.box.meets(cells[order[m]].box, reach))
                visit(std::min(order[n], order[m]), std::max(order[n], order[m]));
    }
}

/// Adds the faces that two cells share.
void add_faces(FaceNet& net, std::vector<Cell>& cells, BodyIndex i, BodyIndex j) {
    const double size = std::min(cells[i].size, cells[j].size);
    for (std::size_t ea = 0; ea < cells[i].edges.size(); ++ea) {
        for (std::size_t eb = 0; eb < cells[j].edges.size(); ++eb) {
            const OutsetEdge &a = cells[i].edges[ea], &b = cells[j].edges[eb];
            const FacingPart on_a = facing_part(a, b, flush_share * size), on_b = facing_part(b, a, flush_share * size);
            const double length = on_a.to - on_a.from;
            if (!(length > shortest_face_share * size) || !(on_b.to > on_b.from)) continue;
            cells[i].covered[ea].push_back(on_a);
            cells[j].covered[eb].push_back(on_b);
            const auto middle = [](const OutsetEdge& edge, const FacingPart& part) {
                return edge.start + 0.5 * (part.from + part.to) * edge.along;
            };
            net.faces.push_back(
                {i, j, 0.5 * (middle(a, on_a) + middle(b, on_b)), unit(a.outwards() - b.outwards()), length});
        }
    }
}

void add_sides(FaceNet& net, Cell& cell, BodyIndex body) {
    for (std::size_t e = 0; e < cell.edges.size(); ++e) {
        const OutsetEdge& edge = cell.edges[e];
        std::vector<FacingPart>& covered = cell.covered[e];
        std::ranges::sort(covered, {}, &FacingPart::from);
        covered.push_back({edge.length, edge.length});
        double from = 0.0;
        for (const FacingPart& part : covered) {
            if (part.from - from > shortest_side_share * cell.size)
                net.sides.push_back(
                    {body, edge.start + 0.5 * (from + part.from) * edge.along, edge.outwards(), part.from - from});
            from = std::max(from, part.to);
        }
    }
}

}  // namespace

Outlines outlines_before_inset(const World& world, double gap) {
    Outlines outlines(world.bodies.size());
    for (BodyIndex b = 0; b < outlines.size(); ++b) {
        const BodyInfo info = world.bodies.info(b);
        if (info.piece_count == 0 || !info.closed) continue;
        for (const OutsetEdge& edge : outset_edges(corners_of(world, b), 0.5 * gap)) outlines[b].push_back(edge.start);
    }
    return outlines;
}

FaceNet find_faces(const Outlines& outlines) {
    FaceNet net;
    net.cells.resize(outlines.size());
    std::vector<Cell> cells(outlines.size());
    double largest = 0.0;
    for (BodyIndex b = 0; b < cells.size(); ++b) {
        if (outlines[b].empty()) continue;
        Cell& cell = cells[b];
        cell.edges = outset_edges(outlines[b], 0.0);
        cell.covered.resize(cell.edges.size());
        for (const Vec2 corner : outlines[b]) cell.box.add(corner);
        net.cells[b] = area_of(outlines[b]);
        cell.size = std::sqrt(net.cells[b].area);
        largest = std::max(largest, cell.size);
    }
    visit_near(cells, flush_share * largest, [&](BodyIndex i, BodyIndex j) { add_faces(net, cells, i, j); });
    std::ranges::stable_sort(net.faces, {}, [](const SharedFace& face) { return std::pair(face.i, face.j); });
    for (BodyIndex b = 0; b < cells.size(); ++b) add_sides(net, cells[b], b);
    return net;
}

}  // namespace crackle
