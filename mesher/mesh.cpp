// SPDX-License-Identifier: GPL-3.0-or-later
// make_mesh(): checks the input, partitions the domain, insets the cells, and merges or refuses cells that the inset
// destroys.
// Tested by tests/mesher/voronoi_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "mesher/check_request.hpp"
#include "mesher/conforming.hpp"
#include "mesher/inset.hpp"
#include "mesher/jointed_cells.hpp"
#include "mesher/merge.hpp"
#include "mesher/mesh_builder.hpp"
#include "mesher/mesher.hpp"
#include "mesher/partition.hpp"
#include "mesher/trace_graph.hpp"

namespace crackle {
namespace {

/// Clips cells to an outline.
class Cutter {
  public:
    explicit Cutter(std::span<const Point> outline) : outline_(outline) {}

    std::span<const Point> of(std::span<const Point> cell) {
        if (outline_.empty()) return cell;
        cell_.assign(cell.begin(), cell.end());
        for (std::size_t k = 0; k < outline_.size(); ++k) {
            const Point a = outline_[k], b = outline_[k + 1 == outline_.size() ? 0 : k + 1];
            const double length = distance(a, b), nx = -(b.y - a.y) / length, ny = (b.x - a.x) / length;
            clip(cell_, nx, ny, nx * a.x + ny * a.y, scratch_);
        }
        return cell_;
    }

  private:
    std::span<const Point> outline_;
    std::vector<Point> cell_, scratch_;
};

std::string place(Point p) { return fmt::format("({:.9g}, {:.9g})", p.x, p.y); }

/// Thrown if the inset destroys cells. make_mesh() catches it, adds advice and throws a MeshError.
struct DestroyedCells {
    std::string found;    // description of the worst cell
    double least_radius;  // m, smallest inscribed radius of these cells
    std::vector<int> centres, traces;
};

[[noreturn]] void refuse_destroyed(const std::string& cell, double radius, double depth, std::size_t count,
                                   std::vector<int> centres, std::vector<int> traces = {}) {
    throw DestroyedCells{fmt::format("mesh: found {} with an inscribed radius of {:.6g} destroyed by the inset of "
                                     "{:.6g} ({} cell{} in all), expected every cell to survive",
                                     cell, radius, depth, count, count == 1 ? "" : "s"),
                         radius, std::move(centres), std::move(traces)};
}

// Twice the area divided by the perimeter. It grows with the inscribed radius, and is a fast way to find the worst
// cell.
double slenderness(std::span<const Point> outline) {
    double perimeter = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        perimeter += distance(a, b);
    }
    return 2.0 * polygon_area(outline) / perimeter;
}

// Selects destroyed cells that do not touch each other; if two touch, it may be sufficient to omit one of them.
// @param destroyed destroyed cells, in the order of their centres @return indices of the centres of the selected cells
std::vector<int> apart(const VoronoiCells& voronoi, const std::vector<VoronoiCells::Range>& destroyed) {
    std::set<std::pair<double, double>> taken;
    std::vector<int> chosen;
    for (const VoronoiCells::Range& cell : destroyed) {
        const auto outline = voronoi.outline(cell);
        if (std::any_of(outline.begin(), outline.end(), [&](Point p) { return taken.contains({p.x, p.y}); })) continue;
        for (const Point& p : outline) taken.insert({p.x, p.y});
        chosen.push_back(cell.centre);
    }
    return chosen;
}

// Sorts cells by centre. This is a separate loop, because its random memory access would slow down the insets.
// @param cells cells of the remaining centres @param centre_of original index of each remaining centre
std::vector<Cell> in_order_of_centres(const std::vector<Cell>& cells, const std::vector<int>& centre_of) {
    std::vector<Cell> ordered(cells.size());
    for (const Cell& cell : cells) ordered[static_cast<std::size_t>(cell.centre)] = cell;
    for (std::size_t k = 0; k < ordered.size(); ++k) ordered[k].centre = centre_of[k];
    return ordered;
}

Mesh mesh_voronoi(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request,
                  double depth) {
    const double scale = coordinate_scale(domain);
    Patience patience(request.interrupted);
    Inset inset(depth, scale);
    std::vector<CellCentre> left(centres.begin(), centres.end());
    std::vector<int> centre_of(centres.size());
    std::iota(centre_of.begin(), centre_of.end(), 0);
    std::int64_t merged = 0;
    while (true) {
        const VoronoiCells voronoi = voronoi_cells(left, domain, patience);
        MeshBuilder builder(domain, voronoi.cells.size(), voronoi.corners.size());
        std::vector<VoronoiCells::Range> destroyed;
        Cutter cutter(request.outline);
        for (const VoronoiCells::Range& range : voronoi.cells) {
            patience.piece();
            const auto before = cutter.of(voronoi.outline(range)), after = inset.of(before);
            if (after.empty()) {
                destroyed.push_back(range);
                continue;
            }
            builder.add(before, after).centre = range.centre;
        }
        if (destroyed.empty()) {
            Mesh mesh = builder.finish();
            mesh.cells = in_order_of_centres(mesh.cells, centre_of);
            mesh.report.cells_destroyed = merged;
            return mesh;
        }
        std::ranges::sort(destroyed, {}, &VoronoiCells::Range::centre);
        if (!request.merge_destroyed || left.size() == 1) {
            const auto worst = std::ranges::min_element(
                destroyed, {}, [&](const VoronoiCells::Range& cell) { return slenderness(voronoi.outline(cell)); });
            const auto number = static_cast<std::size_t>(worst->centre);
            refuse_destroyed(fmt::format("the cell of centre {} at {}", centre_of[number], place(left[number])),
                             inscribed_radius(voronoi.outline(*worst), scale), depth, destroyed.size(),
                             {centre_of[number]});
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
            centre_of[kept++] = centre_of[k];
        }
        left.resize(kept);
        centre_of.resize(kept);
    }
}

/// Triangles that fill a convex outline. The walls are placed far away, so that there are no mirror images near the
/// outline.
Triangles triangles_within(std::span<const CellCentre> centres, const Rectangle& domain, std::span<const Point> outline,
                           Patience& patience) {
    constexpr double wall_distance = 10.0;  // distance of the walls, relative to the size of the domain
    // Smallest distance of centres from the outline, relative to the mean spacing.
    constexpr double left_out_share = 1.0 / 3.0;
    const double spacing = std::sqrt(polygon_area(outline) / static_cast<double>(centres.size()));
    std::vector<CellCentre> points;
    std::vector<int> number;
    for (std::size_t k = 0; k < centres.size(); ++k) {
        if (depth_within(outline, centres[k]) < left_out_share * spacing) continue;
        points.push_back(centres[k]);
        number.push_back(static_cast<int>(k));
    }
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        const auto parts = std::max(1, static_cast<int>(std::lround(distance(a, b) / spacing)));
        for (int part = 0; part < parts; ++part) {
            const double along = static_cast<double>(part) / parts;
            points.push_back({a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)});
            number.push_back(-1);
        }
    }
    const double far = wall_distance * std::max(domain.x2 - domain.x1, domain.y2 - domain.y1);
    Triangles triangles = delaunay_triangles(
        points, {domain.x1 - far, domain.x2 + far, domain.y1 - far, domain.y2 + far}, Boundary::centres, patience);
    for (int& of : triangles.centre_of) of = number[static_cast<std::size_t>(of)];
    return triangles;
}

double mean_spacing(std::span<const CellCentre> centres, const Rectangle& domain) {
    return std::sqrt((domain.x2 - domain.x1) * (domain.y2 - domain.y1) / static_cast<double>(centres.size()));
}

TraceGraph graph_of(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request) {
    return trace_graph(domain, request.traces, trace_reach_share * mean_spacing(centres, domain));
}

/// Reports the effects of traces on a mesh.
void report_traces(MeshReport& report, const TraceGraph& graph, std::size_t left_out, std::size_t added) {
    report.ends_moved = static_cast<std::int64_t>(graph.moved.size());
    for (const TraceGraph::MovedEnd& end : graph.moved)
        report.largest_move = std::max(report.largest_move, std::abs(end.by));
    for (const TraceGraph::Coincidence& both : graph.coincident) report.coincident += both.length;
    report.centres_left = static_cast<std::int64_t>(left_out);
    report.points_added = static_cast<std::int64_t>(added);
}

/// Flags the corners at which a trace ends: their two edges lie on different traces, or only one edge lies on a trace.
std::span<const char> ends_of_traces(std::span<const int> traces, std::vector<char>& kept) {
    kept.resize(traces.size());
    for (std::size_t k = 0; k < traces.size(); ++k)
        kept[k] = traces[k] != traces[k == 0 ? traces.size() - 1 : k - 1] ? 1 : 0;
    return kept;
}

Mesh mesh_jointed_voronoi(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request,
                          double depth) {
    const double scale = coordinate_scale(domain);
    Patience patience(request.interrupted);
    const TraceGraph graph = graph_of(centres, domain, request);
    const JointedCells made = jointed_cells(centres, domain, graph, mean_spacing(centres, domain), patience);
    Inset inset(depth, scale);
    std::vector<char> kept;
    MeshBuilder builder(domain, made.traced.cells.cells.size(), made.traced.cells.corners.size());
    std::vector<VoronoiCells::Range> destroyed;
    for (const VoronoiCells::Range& range : made.traced.cells.cells) {
        patience.piece();
        const auto before = made.traced.cells.outline(range);
        const auto traces = std::span(made.traced.traces).subspan(range.first, range.count);
        const auto after = inset.of(before, ends_of_traces(traces, kept));
        if (after.empty()) {
            destroyed.push_back(range);
            continue;
        }
        builder.add(before, after, traces, inset.edges_kept()).centre = range.centre;
    }
    if (!destroyed.empty()) {
        const auto worst = *std::ranges::min_element(destroyed, {}, [&](const VoronoiCells::Range& cell) {
            return slenderness(made.traced.cells.outline(cell));
        });
        const auto number = static_cast<std::size_t>(worst.centre);
        std::set<int> named;
        for (std::size_t k = 0; k < worst.count; ++k)
            if (const int trace = made.traced.traces[worst.first + k]; trace >= 0) named.insert(trace);
        const std::vector<int> traces(named.begin(), named.end());
        refuse_destroyed(fmt::format("the cell at {}{}", place(made.seeds.places[number]), in_words(traces)),
                         inscribed_radius(made.traced.cells.outline(worst), scale), depth, destroyed.size(),
                         {made.seeds.centre[number]}, traces);
    }
    Mesh mesh = builder.finish();
    mesh.cells = in_order_of_centres(mesh.cells, made.seeds.centre);
    report_traces(mesh.report, graph, made.seeds.left_out,
                  static_cast<std::size_t>(std::count(made.seeds.added.begin(), made.seeds.added.end(), 1)));
    mesh.report.ends_moved += static_cast<std::int64_t>(made.traced.ends_moved);
    mesh.report.largest_move = std::max(mesh.report.largest_move, made.traced.largest_move);
    mesh.report.cells_cut = static_cast<std::int64_t>(made.traced.cut);
    mesh.report.pieces_joined = static_cast<std::int64_t>(made.traced.joined);
    return mesh;
}

/// For each corner of a triangle, the trace on the edge to the next corner.
std::array<int, 3> traces_along(const Triangles& triangles, std::size_t t) {
    const std::array<int, 3>& opposite = triangles.traces[t];
    return {opposite[2], opposite[0], opposite[1]};
}

std::array<Point, 3> outline_of(const Triangles& triangles, std::size_t t) {
    const auto point = [&](int k) { return triangles.points[static_cast<std::size_t>(k)]; };
    const auto& c = triangles.corners[t];
    return {point(c[0]), point(c[1]), point(c[2])};
}

/// Indices of the centres at the corners of a triangle; -1 for a point that is not a centre.
std::array<int, 3> centres_about(const Triangles& triangles, std::size_t t) {
    std::array<int, 3> numbers{};
    for (std::size_t k = 0; k < 3; ++k)
        numbers[k] = triangles.centre_of[static_cast<std::size_t>(triangles.corners[t][k])];
    return numbers;
}

/// Throws an error that names the most slender of the triangles that the inset destroys.
[[noreturn]] void refuse_destroyed_triangles(const Triangles& triangles, const std::vector<int>& destroyed, bool traced,
                                             double depth, double scale) {
    const auto outline = [&](std::size_t t) { return outline_of(triangles, t); };
    const int worst = *std::min_element(destroyed.begin(), destroyed.end(), [&](int a, int b) {
        return slenderness(outline(static_cast<std::size_t>(a))) < slenderness(outline(static_cast<std::size_t>(b)));
    });
    const auto corners = outline(static_cast<std::size_t>(worst));
    std::vector<int> named;
    std::string numbers;
    for (const int centre : centres_about(triangles, static_cast<std::size_t>(worst))) {
        numbers += (numbers.empty() ? "" : ", ") + (centre >= 0 ? std::to_string(centre)
                                                    : !traced   ? std::string("wall")
                                                                : std::string("wall or trace"));
        if (centre >= 0) named.push_back(centre);
    }
    std::vector<int> traces = traces_about(triangles, static_cast<std::size_t>(worst));
    const std::string by = in_words(traces);
    refuse_destroyed(fmt::format("triangle {} of centres {} with corners at {}, {}, {}{}", worst, numbers,
                                 place(corners[0]), place(corners[1]), place(corners[2]), by),
                     inscribed_radius(corners, scale), depth, destroyed.size(), std::move(named), std::move(traces));
}

/// Merges destroyed triangles with their neighbours. @throws DestroyedCells if one cannot be merged
JoinedTriangles join_or_refuse(const Triangles& triangles, const std::vector<int>& destroyed, double depth,
                               double scale) {
    try {
        return join_destroyed(triangles, destroyed, depth, scale);
    } catch (const MeshError& error) {
        double least = depth;
        for (const int t : destroyed)
            least = std::min(least, inscribed_radius(outline_of(triangles, static_cast<std::size_t>(t)), scale));
        throw DestroyedCells{error.what(), least, error.centres, error.traces};
    }
}

Mesh mesh_delaunay(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request,
                   double depth) {
    const double scale = coordinate_scale(domain);
    const bool traced = !request.traces.empty();
    Patience patience(request.interrupted);
    TraceGraph graph;
    ConformingTriangles made;
    if (traced) {
        graph = graph_of(centres, domain, request);
        made = conforming_triangles(centres, domain, graph, mean_spacing(centres, domain), patience);
    }
    const Triangles triangles = traced ? std::move(made.triangles)
                                : request.outline.empty()
                                    ? delaunay_triangles(centres, domain, request.boundary, patience)
                                    : triangles_within(centres, domain, request.outline, patience);
    if (triangles.corners.empty()) {
        throw MeshError(
            fmt::format("mesh: found {} centre{} that form no triangle with a circumcentre in the domain, expected at "
                        "least three that do not lie on one line; use the boundary \"domain\"",
                        centres.size(), centres.size() == 1 ? "" : "s"));
    }
    Inset inset(depth, scale);
    // Outlines are inset twice: first to find the destroyed ones, then to add the others. This is faster than storing
    // them.
    std::vector<int> destroyed;
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        patience.piece();
        if (inset.of(outline_of(triangles, t)).empty()) destroyed.push_back(static_cast<int>(t));
    }
    if (!destroyed.empty() && !request.merge_destroyed)
        refuse_destroyed_triangles(triangles, destroyed, traced, depth, scale);
    const JoinedTriangles joined = join_or_refuse(triangles, destroyed, depth, scale);
    MeshBuilder builder(domain, triangles.corners.size(), 3 * triangles.corners.size());
    auto next = joined.outlines.begin();
    const auto add = [&](std::size_t t, std::span<const Point> before, std::span<const int> traces) {
        const auto after = inset.of(before);
        Cell& cell = traced ? builder.add(before, after, traces, inset.edges_kept()) : builder.add(before, after);
        cell.centres = centres_about(triangles, t);
    };
    std::vector<Point> before;
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        patience.piece();
        if (!joined.joined[t]) {
            add(t, outline_of(triangles, t), traced ? traces_along(triangles, t) : std::array<int, 3>{});
        } else if (next != joined.outlines.end() && static_cast<std::size_t>(next->triangle) == t) {
            before.clear();
            for (const int corner : next->corners) before.push_back(triangles.points[static_cast<std::size_t>(corner)]);
            add(t, before, next->traces);
            ++next;
        }
    }
    Mesh mesh = builder.finish();
    mesh.report.cells_destroyed = static_cast<std::int64_t>(destroyed.size());
    if (traced) report_traces(mesh.report, graph, made.left_out, made.added);
    return mesh;
}

Mesh mesh_as_asked(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request) {
    const double depth = request.inset.value_or(0.5 * request.mesh_gap);
    const bool voronoi = request.kind == MeshKind::voronoi;
    return voronoi && !request.traces.empty() ? mesh_jointed_voronoi(centres, domain, request, depth)
           : voronoi                          ? mesh_voronoi(centres, domain, request, depth)
                                              : mesh_delaunay(centres, domain, request, depth);
}

bool can_be_meshed(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request) {
    try {
        mesh_as_asked(centres, domain, request);
        return true;
    } catch (const DestroyedCells&) {
        return false;
    } catch (const MeshError&) {
        return false;
    }
}

/// Rounds a value down to two significant digits.
double rounded_down(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return unit * std::floor(value / unit);
}

/// Text that suggests changes to the request with which a mesh can be made. Each change has been tried.
/// @param least_radius smallest inscribed radius of the cells that the inset destroys, m
std::string advice(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request,
                   std::optional<double> least_radius) {
    std::vector<std::string> helps;
    const auto attempt = [&](const MeshRequest& other, const std::string& words) {
        if (can_be_meshed(centres, domain, other)) helps.push_back(words);
    };
    const bool voronoi = request.kind == MeshKind::voronoi, traced = !request.traces.empty();
    constexpr double least_share = 1e-6;  // smallest inset that is useful as advice, relative to the requested one
    if (least_radius && *least_radius > least_share * request.inset.value_or(0.5 * request.mesh_gap)) {
        MeshRequest thinner = request;
        const double depth = rounded_down(0.99 * *least_radius);
        if (request.inset) {
            thinner.inset = depth;
            attempt(thinner, fmt::format("use an inset of {:.2g} or less", depth));
        } else {
            thinner.mesh_gap = rounded_down(2.0 * depth);
            attempt(thinner, fmt::format("set thick to {:.2g} or less", thinner.mesh_gap));
        }
    }
    if (least_radius && !request.merge_destroyed && !(voronoi && traced)) {
        MeshRequest merging = request;
        merging.merge_destroyed = true;
        attempt(merging, "merge the destroyed cells");
    }
    if (request.boundary == Boundary::domain && !(traced && !voronoi && request.merge_destroyed)) {
        MeshRequest other = request;
        other.kind = voronoi ? MeshKind::delaunay : MeshKind::voronoi;
        attempt(other, voronoi ? "use Delaunay triangles" : "use Voronoi cells");
    }
    if (helps.empty()) return "";
    std::string text = "; ";
    for (std::size_t k = 0; k < helps.size(); ++k)
        text += (k == 0 ? "" : k + 1 == helps.size() ? ", or " : ", ") + helps[k];
    return text;
}

}  // namespace

MeshQuality quality_of(const Mesh& mesh) {
    MeshQuality quality;
    quality.smallest_angle = mesh.report.smallest_angle;
    double least = std::numeric_limits<double>::infinity(), edges = 0.0;
    for (const Cell& cell : mesh.cells) {
        least = std::min(least, cell.area);
        const auto outline = mesh.outline(cell);
        for (std::size_t k = 0; k < outline.size(); ++k)
            edges += distance(outline[k], outline[k + 1 == outline.size() ? 0 : k + 1]);
    }
    quality.smallest_area = least * static_cast<double>(mesh.cells.size()) / mesh.report.area_before_inset;
    quality.shortest_edge = mesh.report.shortest_edge * static_cast<double>(mesh.report.segments) / edges;
    return quality;
}

Mesh make_mesh(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request) {
    check_request(centres, domain, request);
    try {
        Mesh mesh = mesh_as_asked(centres, domain, request);
        mesh.report.centres = static_cast<std::int64_t>(centres.size());
        return mesh;
    } catch (const DestroyedCells& cells) {
        throw MeshError(cells.found + advice(centres, domain, request, cells.least_radius), cells.centres,
                        cells.traces);
    } catch (const MeshError& error) {
        if (error.traces.empty()) throw;
        throw MeshError(error.what() + advice(centres, domain, request, std::nullopt), error.centres, error.traces);
    }
}

}  // namespace crackle
