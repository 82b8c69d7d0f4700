// SPDX-License-Identifier: GPL-3.0-or-later
// make_mesh(): judges the input, partitions the domain, insets the cells, deals with those that the inset destroys, and
// measures what came out.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "mesher/inset.hpp"
#include "mesher/merge.hpp"
#include "mesher/mesher.hpp"
#include "mesher/partition.hpp"

namespace crackle {
namespace {

// Squares of lengths must neither overflow nor vanish.
constexpr double longest_length = 1e100, shortest_length = 1e-100;

void check_request(const Rectangle& domain, const MeshRequest& request) {
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
    if (!(request.thick >= 0.0 && std::isfinite(request.thick))) {
        throw MeshError(fmt::format("mesh: thick: found {}, expected a length >= 0", request.thick));
    }
    if (request.inset && !(*request.inset >= 0.0 && std::isfinite(*request.inset))) {
        throw MeshError(fmt::format("mesh: inset: found {}, expected a length >= 0", *request.inset));
    }
}

void check_seeds(std::span<const Seed> seeds, const Rectangle& domain) {
    if (seeds.empty()) throw MeshError("mesh: found no seeds, expected at least one");
    // Triangles are about twice as many and are numbered by int; their corners by 32 bits.
    constexpr std::size_t most = std::numeric_limits<int>::max() / 4;
    if (seeds.size() > most)
        throw MeshError(fmt::format("mesh: found {} seeds, expected at most {}", seeds.size(), most));
    for (std::size_t k = 0; k < seeds.size(); ++k) {
        const Seed& s = seeds[k];
        if (!std::isfinite(s.x) || !std::isfinite(s.y)) {
            throw MeshError(fmt::format("mesh: found seed {} at ({}, {}), expected finite coordinates", k, s.x, s.y),
                            {static_cast<int>(k)});
        }
        if (s.x < domain.x1 || s.x > domain.x2 || s.y < domain.y1 || s.y > domain.y2) {
            throw MeshError(
                fmt::format(
                    "mesh: found seed {} at ({:.9g}, {:.9g}), expected it inside the domain x {:.9g} to {:.9g}, y "
                    "{:.9g} to {:.9g}; remove it or widen the domain",
                    k, s.x, s.y, domain.x1, domain.x2, domain.y1, domain.y2),
                {static_cast<int>(k)});
        }
    }
}

std::string place(Point p) { return fmt::format("({:.9g}, {:.9g})", p.x, p.y); }

[[noreturn]] void refuse_destroyed(const std::string& cell, std::span<const Point> outline, double depth, double scale,
                                   std::size_t count, std::vector<int> seeds) {
    throw MeshError(
        fmt::format(
            "mesh: found {} of inscribed radius {:.6g} destroyed by the inset of {:.6g} ({} cell{} in all), expected "
            "every cell to survive; use a smaller thick or inset, or merge the destroyed cells",
            cell, inscribed_radius(outline, scale), depth, count, count == 1 ? "" : "s"),
        std::move(seeds));
}

// Twice the area over the perimeter: grows with the inscribed radius, and finds the cell to be named quickly.
double slenderness(std::span<const Point> outline) {
    double perimeter = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        perimeter += std::hypot(b.x - a.x, b.y - a.y);
    }
    return 2.0 * polygon_area(outline) / perimeter;
}

// Neumaier's compensated sum: a million equal areas would lose the last five digits otherwise.
class Sum {
  public:
    void add(double value) {
        const double next = total_ + value;
        lost_ += std::abs(total_) >= std::abs(value) ? (total_ - next) + value : (value - next) + total_;
        total_ = next;
    }
    double value() const { return total_ + lost_; }

  private:
    double total_ = 0.0, lost_ = 0.0;
};

void add_cell(Mesh& mesh, Sum& area, Cell cell, std::span<const Point> before, std::span<const Point> after,
              const Rectangle& domain) {
    cell.first_corner = static_cast<std::uint32_t>(mesh.corners.size());
    cell.corner_count = static_cast<std::uint32_t>(after.size());
    cell.sides = sides_of(before, domain);
    mesh.corners.insert(mesh.corners.end(), after.begin(), after.end());
    mesh.cells.push_back(cell);
    area.add(polygon_area(before));
}

// One inset pass over the cells. @return seeds whose cells are destroyed.
std::vector<int> inset_voronoi(const VoronoiCells& voronoi, const std::vector<int>& seed_of, const Rectangle& domain,
                               Inset& inset, Mesh& mesh) {
    const std::size_t count = voronoi.cells.size();
    mesh = {};
    mesh.corners.reserve(voronoi.corners.size());
    mesh.cells.reserve(count);
    Sum area;
    std::vector<int> destroyed;
    for (std::size_t k = 0; k < count; ++k) {
        const auto& range = voronoi.cells[k];
        const auto before = std::span(voronoi.corners).subspan(range.first, range.count);
        const auto after = inset.of(before);
        if (after.empty()) {
            destroyed.push_back(static_cast<int>(k));
            continue;
        }
        Cell cell;
        cell.seed = seed_of[k];
        add_cell(mesh, area, cell, before, after, domain);
    }
    mesh.report.area_before_inset = area.value();
    return destroyed;
}

// Of the destroyed cells, some that do not touch each other: where two do, leaving out one may be enough.
std::vector<int> apart(const VoronoiCells& voronoi, const std::vector<int>& destroyed) {
    std::set<std::pair<double, double>> taken;
    std::vector<int> chosen;
    for (const int k : destroyed) {
        const auto& range = voronoi.cells[static_cast<std::size_t>(k)];
        const auto outline = std::span(voronoi.corners).subspan(range.first, range.count);
        if (std::any_of(outline.begin(), outline.end(), [&](Point p) { return taken.contains({p.x, p.y}); })) continue;
        for (const Point& p : outline) taken.insert({p.x, p.y});
        chosen.push_back(k);
    }
    return chosen;
}

Mesh mesh_voronoi(std::span<const Seed> seeds, const Rectangle& domain, const MeshRequest& request, double depth) {
    const double scale = coordinate_scale(domain);
    Inset inset(depth, scale);
    std::vector<Seed> left(seeds.begin(), seeds.end());
    std::vector<int> seed_of(seeds.size());
    std::iota(seed_of.begin(), seed_of.end(), 0);
    std::int64_t merged = 0;
    while (true) {
        const VoronoiCells voronoi = voronoi_cells(left, domain);
        Mesh mesh;
        const std::vector<int> destroyed = inset_voronoi(voronoi, seed_of, domain, inset, mesh);
        if (destroyed.empty()) {
            mesh.report.cells_destroyed = merged;
            return mesh;
        }
        const auto outline = [&](int k) {
            const auto& range = voronoi.cells[static_cast<std::size_t>(k)];
            return std::span(voronoi.corners).subspan(range.first, range.count);
        };
        if (!request.merge_destroyed || left.size() == 1) {
            const int worst = *std::min_element(destroyed.begin(), destroyed.end(), [&](int a, int b) {
                return slenderness(outline(a)) < slenderness(outline(b));
            });
            const int seed = seed_of[static_cast<std::size_t>(worst)];
            refuse_destroyed(
                fmt::format("the cell of seed {} at {}", seed, place(left[static_cast<std::size_t>(worst)])),
                outline(worst), depth, scale, destroyed.size(), {seed});
        }
        const std::vector<int> dropped = apart(voronoi, destroyed);
        merged += static_cast<std::int64_t>(dropped.size());
        std::size_t kept = 0, next = 0;
        for (std::size_t k = 0; k < left.size(); ++k) {
            if (next < dropped.size() && static_cast<std::size_t>(dropped[next]) == k) {
                ++next;
                continue;
            }
            left[kept] = left[k];
            seed_of[kept++] = seed_of[k];
        }
        left.resize(kept);
        seed_of.resize(kept);
    }
}

Mesh mesh_delaunay(std::span<const Seed> seeds, const Rectangle& domain, const MeshRequest& request, double depth) {
    const double scale = coordinate_scale(domain);
    const Triangles triangles = delaunay_triangles(seeds, domain, request.boundary);
    if (triangles.corners.empty()) {
        throw MeshError(fmt::format(
            "mesh: found {} seed{} that form no triangle with a circumcentre in the domain, expected at least three "
            "not on one line; use boundary domain",
            seeds.size(), seeds.size() == 1 ? "" : "s"));
    }
    Inset inset(depth, scale);
    Mesh mesh;
    mesh.corners.reserve(3 * triangles.corners.size());
    mesh.cells.reserve(triangles.corners.size());
    const auto point = [&](int k) { return triangles.points[static_cast<std::size_t>(k)]; };
    const auto outline = [&](std::size_t t) {
        const auto& c = triangles.corners[t];
        return std::array<Point, 3>{point(c[0]), point(c[1]), point(c[2])};
    };
    const auto cell_of = [&](std::size_t t) {
        Cell cell;
        for (std::size_t k = 0; k < 3; ++k) {
            const int corner = triangles.corners[t][k];
            cell.seeds[k] = static_cast<std::size_t>(corner) < seeds.size() ? corner : -1;
        }
        return cell;
    };
    Sum area;
    std::vector<int> destroyed;
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        const auto before = outline(t);
        const auto after = inset.of(before);
        if (after.empty()) {
            destroyed.push_back(static_cast<int>(t));
            continue;
        }
        add_cell(mesh, area, cell_of(t), before, after, domain);
    }
    mesh.report.area_before_inset = area.value();
    if (destroyed.empty()) return mesh;
    if (!request.merge_destroyed) {
        const int worst = *std::min_element(destroyed.begin(), destroyed.end(), [&](int a, int b) {
            return slenderness(outline(static_cast<std::size_t>(a))) <
                   slenderness(outline(static_cast<std::size_t>(b)));
        });
        const auto corners = outline(static_cast<std::size_t>(worst));
        std::vector<int> named;
        std::string numbers;
        for (const int seed : cell_of(static_cast<std::size_t>(worst)).seeds) {
            numbers += (numbers.empty() ? "" : ", ") + (seed < 0 ? std::string("wall") : std::to_string(seed));
            if (seed >= 0) named.push_back(seed);
        }
        refuse_destroyed(fmt::format("triangle {} of seeds {} at {}, {}, {}", worst, numbers, place(corners[0]),
                                     place(corners[1]), place(corners[2])),
                         corners, depth, scale, destroyed.size(), std::move(named));
    }
    const JoinedTriangles joined = join_destroyed(triangles, destroyed, depth, scale);
    mesh = {};
    area = {};
    auto next = joined.outlines.begin();
    std::vector<Point> before;
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        before.clear();
        if (!joined.joined[t]) {
            for (const Point& p : outline(t)) before.push_back(p);
        } else if (next != joined.outlines.end() && static_cast<std::size_t>(next->triangle) == t) {
            for (const int corner : next->corners) before.push_back(point(corner));
            ++next;
        } else {
            continue;
        }
        add_cell(mesh, area, cell_of(t), before, inset.of(before), domain);
    }
    mesh.report.area_before_inset = area.value();
    mesh.report.cells_destroyed = static_cast<std::int64_t>(destroyed.size());
    return mesh;
}

void measure(Mesh& mesh) {
    MeshReport& report = mesh.report;
    report.cells = static_cast<std::int64_t>(mesh.cells.size());
    report.segments = static_cast<std::int64_t>(mesh.corners.size());
    Sum area;
    double shortest = std::numeric_limits<double>::infinity();
    // Angles are compared by a measure that grows with them and needs no arc function: sin up to 90 degrees, 2 - sin
    // beyond.
    double smallest = 2.0;
    for (const Cell& cell : mesh.cells) {
        const auto corners = mesh.outline(cell);
        Point before = corners.back();
        Point in{corners.front().x - before.x, corners.front().y - before.y};
        double in_length = std::sqrt(in.x * in.x + in.y * in.y);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Point here = corners[k], after = corners[k + 1 == corners.size() ? 0 : k + 1];
            const Point out{after.x - here.x, after.y - here.y};
            const double out_length = std::sqrt(out.x * out.x + out.y * out.y);
            const double sine = (in.x * out.y - in.y * out.x) / (in_length * out_length);
            smallest = std::min(smallest, in.x * out.x + in.y * out.y < 0.0 ? sine : 2.0 - sine);
            shortest = std::min(shortest, out_length);
            in = out;
            in_length = out_length;
        }
        area.add(polygon_area(corners));
    }
    const double quarter = std::asin(std::clamp(smallest <= 1.0 ? smallest : 2.0 - smallest, -1.0, 1.0));
    report.smallest_angle = (smallest <= 1.0 ? quarter : std::numbers::pi - quarter) * 180.0 / std::numbers::pi;
    report.shortest_edge = shortest;
    report.area_after_inset = area.value();
}

}  // namespace

Mesh make_mesh(std::span<const Seed> seeds, const Rectangle& domain, const MeshRequest& request) {
    check_request(domain, request);
    check_seeds(seeds, domain);
    const double depth = request.inset.value_or(0.5 * request.thick);
    Mesh mesh = request.kind == MeshKind::voronoi ? mesh_voronoi(seeds, domain, request, depth)
                                                  : mesh_delaunay(seeds, domain, request, depth);
    measure(mesh);
    return mesh;
}

}  // namespace crackle
