// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes of polygon particles: areas, gaps, lost cells, duality of Voronoi edges.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "mesher/mesher.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace {

constexpr Rectangle domain{-0.3, 0.4, 0.1, 1.5};
constexpr double seam = 1e-3, scale = 1.5;  // gap between cells, and largest coordinate, m
constexpr int columns = 14, seed_rows = 28;

const char* name_of(MeshKind kind) { return kind == MeshKind::voronoi ? "Voronoi" : "Delaunay"; }

/// A grid of centres, each shifted by up to a third of the spacing.
std::vector<CellCentre> seeds_of(std::uint64_t number) {
    std::mt19937_64 generator(number);
    std::vector<CellCentre> centres;
    for (int row = 0; row < seed_rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double dx = (uniform_number(generator) - 0.5) / 1.5, dy = (uniform_number(generator) - 0.5) / 1.5;
            centres.push_back({domain.x1 + (domain.x2 - domain.x1) * (column + 0.5 + dx) / columns,
                               domain.y1 + (domain.y2 - domain.y1) * (row + 0.5 + dy) / seed_rows});
        }
    }
    return centres;
}

MeshRequest request_of(MeshKind kind, double gap, Boundary boundary = Boundary::domain) {
    MeshRequest request;
    request.kind = kind;
    request.mesh_gap = gap;
    request.boundary = boundary;
    return request;
}

double area_of(std::span<const Point> outline) {
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const Point a = outline[0], b = outline[k], c = outline[k + 1];
        twice += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    }
    return 0.5 * twice;
}

/// Edges of all cells, from corner to corner. Before the inset, facing cells have corners with identical coordinates.
using EdgeKey = std::tuple<double, double, double, double>;
class Edges {
  public:
    explicit Edges(const Mesh& mesh) {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            const auto outline = mesh.outline(mesh.cells[c]);
            for (std::size_t k = 0; k < outline.size(); ++k) {
                const Point a = outline[k], b = outline[(k + 1) % outline.size()];
                cell_[{a.x, a.y, b.x, b.y}] = c;
            }
        }
    }
    /// Calls `visit(cell, other, a, b)` once for every shared edge. @return number of edges without a partner
    template <class Visit>
    int visit_shared(const Visit& visit) const {
        int alone = 0;
        for (const auto& [edge, cell] : cell_) {
            const auto [ax, ay, bx, by] = edge;
            const auto other = cell_.find({bx, by, ax, ay});
            if (other == cell_.end()) {
                ++alone;
            } else if (cell < other->second) {
                visit(cell, other->second, Point{ax, ay}, Point{bx, by});
            }
        }
        return alone;
    }

  private:
    std::map<EdgeKey, std::size_t> cell_;
};

std::vector<ClaimRow> cell_areas_sum_to_the_domains() {
    Rows rows;
    for (const MeshKind kind : {MeshKind::voronoi, MeshKind::delaunay}) {
        for (const std::uint64_t number : {1u, 2u}) {
            const Mesh mesh = make_mesh(seeds_of(number), domain, request_of(kind, 0.0));
            double sum = 0.0;
            for (const Cell& cell : mesh.cells) sum += area_of(mesh.outline(cell));
            rows.relative(fmt::format("{}, seeds {}: sum of areas, m2", name_of(kind), number), sum,
                          (domain.x2 - domain.x1) * (domain.y2 - domain.y1), 1e-12, "reference");
        }
    }
    return rows.take();
}

/// Distance of an outline's nearest edge from the line a-b, and the difference of the distances of its two nearest
/// corners.
struct Nearest {
    double distance, slant;
};
Nearest nearest_edge(std::span<const Point> outline, Point a, Point b) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    std::vector<double> distance;
    for (const Point p : outline)
        distance.push_back(std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length);
    std::partial_sort(distance.begin(), distance.begin() + 2, distance.end());
    return {distance[0], distance[1] - distance[0]};
}

std::vector<ClaimRow> every_gap_equals_the_thickness() {
    Rows rows;
    for (const MeshKind kind : {MeshKind::voronoi, MeshKind::delaunay}) {
        const std::vector<CellCentre> centres = seeds_of(3);
        const Mesh whole = make_mesh(centres, domain, request_of(kind, 0.0));
        const Mesh apart = make_mesh(centres, domain, request_of(kind, seam));
        rows.exactly(fmt::format("{}: cells after the inset", name_of(kind)), static_cast<double>(apart.cells.size()),
                     static_cast<double>(whole.cells.size()));
        if (apart.cells.size() != whole.cells.size()) continue;
        double worst = 0.0;
        int gaps = 0, vanished = 0;
        Edges(whole).visit_shared([&](std::size_t i, std::size_t j, Point a, Point b) {
            const Nearest left = nearest_edge(apart.outline(apart.cells[i]), a, b),
                          right = nearest_edge(apart.outline(apart.cells[j]), a, b);
            // An edge that is shorter than the length the inset removes vanishes on one side or both.
            if (std::max(left.slant, right.slant) > 1e-9) {
                ++vanished;
                return;
            }
            ++gaps;
            worst = std::max(worst, std::abs(left.distance + right.distance - seam));
        });
        rows.at_least(fmt::format("{}: gaps between facing edges", name_of(kind)), gaps, 900.0, "seeds");
        rows.absolute(fmt::format("{}: largest departure of a gap from the thickness, m", name_of(kind)), worst, 0.0,
                      1e-14, "eps × coordinates");
        rows.shown(fmt::format("{}: edges too short to survive the inset", name_of(kind)), vanished);
    }
    return rows.take();
}

std::vector<ClaimRow> no_cell_is_lost() {
    Rows rows;
    for (const double gap : {0.0, seam}) {
        const std::vector<CellCentre> centres = seeds_of(4);
        const Mesh cells = make_mesh(centres, domain, request_of(MeshKind::voronoi, gap));
        int in_place = 0;
        for (std::size_t k = 0; k < cells.cells.size(); ++k)
            in_place += cells.cells[k].centre == static_cast<int>(k) && area_of(cells.outline(cells.cells[k])) > 0.0;
        rows.exactly(fmt::format("Voronoi, gap {} m: cells with the number of their seed", gap), in_place,
                     static_cast<double>(centres.size()));
    }
    const std::vector<CellCentre> centres = seeds_of(4);
    const Mesh triangles = make_mesh(centres, domain, request_of(MeshKind::delaunay, 0.0, Boundary::centres));
    const int outer = Edges(triangles).visit_shared([](std::size_t, std::size_t, Point, Point) {});
    rows.exactly("Delaunay between the seeds: triangles 2n - 2 - h", static_cast<double>(triangles.cells.size()),
                 2.0 * static_cast<double>(centres.size()) - 2.0 - outer);
    return rows.take();
}

std::vector<ClaimRow> voronoi_edges_are_orthogonal_to_their_duals() {
    Rows rows;
    const std::vector<CellCentre> centres = seeds_of(5);
    const Mesh mesh = make_mesh(centres, domain, request_of(MeshKind::voronoi, 0.0));
    double slant = 0.0, off_middle = 0.0;
    int edges = 0;
    Edges(mesh).visit_shared([&](std::size_t i, std::size_t j, Point a, Point b) {
        const CellCentre s = centres[i], t = centres[j];
        const double apart = std::hypot(t.x - s.x, t.y - s.y);
        ++edges;
        slant = std::max(slant, std::abs((b.x - a.x) * (t.x - s.x) + (b.y - a.y) * (t.y - s.y)) / apart);
        for (const Point p : {a, b}) {
            off_middle = std::max(
                off_middle,
                std::abs((p.x - 0.5 * (s.x + t.x)) * (t.x - s.x) + (p.y - 0.5 * (s.y + t.y)) * (t.y - s.y)) / apart);
        }
    });
    rows.at_least("Voronoi edges between seeds", edges, 1000.0, "seeds");
    // In a badly shaped triangle, the round-off of the circumcentre is amplified.
    rows.absolute("rise of an edge along its dual, m", slant, 0.0, 1e-11 * scale, "rounding");
    rows.absolute("distance of its ends from the middle of its dual, m", off_middle, 0.0, 1e-11 * scale, "rounding");
    return rows.take();
}

}  // namespace

std::vector<Claim> mesh_claims() {
    constexpr const char* group = "Meshes";
    return {
        {.name = "cell_areas_sum_to_the_domains",
         .group = group,
         .statement = "the areas of all cells before the inset add up to that of the domain",
         .check = cell_areas_sum_to_the_domains},
        {.name = "every_gap_equals_the_thickness",
         .group = group,
         .statement = "the distance between facing edges of neighbours is `thick`",
         .check = every_gap_equals_the_thickness},
        {.name = "no_cell_is_lost",
         .group = group,
         .statement = "there is one Voronoi cell per seed, and there are 2n - 2 - h triangles for n seeds, h of them "
                      "on the outer chain",
         .check = no_cell_is_lost},
        {.name = "voronoi_edges_are_orthogonal_to_their_duals",
         .group = group,
         .statement = "a Voronoi edge lies on the perpendicular bisector of its two seeds",
         .check = voronoi_edges_are_orthogonal_to_their_duals},
    };
}

}  // namespace crackle::verification
