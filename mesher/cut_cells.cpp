// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/cut_cells.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mesher/cell_net.hpp"
#include "mesher/inset.hpp"
#include "mesher/place_grid.hpp"

namespace crackle {
namespace {

// Two distances, relative to the spacing. A corner closer to a trace than the first is moved onto the trace; if a
// corner on the trace is closer than the second, the two corners are merged.
constexpr double onto_trace_share = 0.25, onto_corner_share = 0.08;
// Tolerance for a point to lie on a line, relative to the largest coordinate.
constexpr double on_line_share = 1e-12;
// Shortest part of a cut, on the trace or beyond the trace's end, that becomes a separate face, relative to the length
// of the cut.
constexpr double least_face_share = 0.15;

/// An edge of the graph as a straight line, with coordinates along it and perpendicular to it (positive to the left).
struct Line {
    Point start, along;
    double length;
    int from, to;  // corners at the two nodes of the edge
    std::vector<std::pair<double, double>>
        trace;  // start and end positions, along the line, of the parts that belong to its trace; sorted

    double at(Point p) const { return (p.x - start.x) * along.x + (p.y - start.y) * along.y; }
    double off(Point p) const { return (p.y - start.y) * along.x - (p.x - start.x) * along.y; }
    Point foot(Point p) const {
        const double s = at(p);
        return {start.x + s * along.x, start.y + s * along.y};
    }
    /// Length covered by the trace between two positions along the line.
    double covered(double first, double last) const {
        double sum = 0.0;
        for (const auto& [from_here, to_here] : trace)
            sum += std::max(0.0, std::min(last, to_here) - std::max(first, from_here));
        return sum;
    }
};

class CellCutter {
  public:
    CellCutter(const TracedCells& whole, const Rectangle& domain, const TraceGraph& graph,
               std::span<const std::size_t> cut_by, double spacing, SmallPieces small_pieces, Patience& patience)
        : domain_(domain),
          graph_(graph),
          cut_by_(cut_by.begin(), cut_by.end()),
          patience_(patience),
          spacing_(spacing),
          least_area_(small_pieces.least_share * spacing * spacing),
          divided_again_(small_pieces.divided_again),
          near_(on_line_share * coordinate_scale(domain)),
          net_(spacing, onto_trace_share * spacing, near_),
          nodes_at_(spacing) {
        take(whole);
        for (std::size_t e = 0; e < graph.edges.size(); ++e)
            if (graph.edges[e].trace >= 0) of_trace_[graph.edges[e].trace].push_back(e);
    }

    TracedCells make() {
        for (const std::size_t e : cut_by_) lines_.push_back(line_of(e));
        for (const Line& line : lines_) {
            for (const int node : {line.from, line.to}) {
                nodes_at_.add(nodes_at_.index(net_.place(node).x), nodes_at_.index(net_.place(node).y),
                              static_cast<std::size_t>(node));
                insert_node(node);
            }
        }
        put_corners_onto_traces();
        for (const Line& line : lines_)
            for (const int node : {line.from, line.to}) insert_node(node);
        for (std::size_t k = 0; k < lines_.size(); ++k) mark(lines_[k], graph_.edges[cut_by_[k]].trace);
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            patience_.ask();
            cut(lines_[k], graph_.edges[cut_by_[k]].trace);
        }
        join_small_pieces();
        return result();
    }

  private:
    void take(const TracedCells& whole) {
        for (const VoronoiCells::Range& cell : whole.cells.cells) {
            Loop loop;
            loop.centre = cell.centre;
            const auto outline = whole.cells.outline(cell);
            for (std::size_t k = 0; k < outline.size(); ++k) {
                const int corner = net_.corner_at(outline[k]);
                if (!loop.corners.empty() && loop.corners.back() == corner) continue;
                loop.corners.push_back(corner);
                loop.traces.push_back(whole.traces[cell.first + k]);
            }
            net_.add(std::move(loop));
        }
    }
    static CellNet::Box box_of(Point a, Point b) {
        return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
    }
    /// Cell corner at node p, allowing for round-off; added if it is missing.
    int node_at(Point p) {
        for (const int cell : net_.cells_near({p, p}))
            for (const int corner : net_.loop(cell).corners)
                if (distance(net_.place(corner), p) <= near_) return corner;
        return net_.corner_at(p);
    }
    Line line_of(std::size_t e) {
        const TraceGraph::Edge& edge = graph_.edges[e];
        const Point a = graph_.nodes[static_cast<std::size_t>(edge.from)],
                    b = graph_.nodes[static_cast<std::size_t>(edge.to)];
        const double length = distance(a, b);
        Line line{a, {(b.x - a.x) / length, (b.y - a.y) / length}, length, node_at(a), node_at(b), {}};
        for (const std::size_t other : of_trace_[edge.trace]) {
            const Point c = graph_.nodes[static_cast<std::size_t>(graph_.edges[other].from)],
                        d = graph_.nodes[static_cast<std::size_t>(graph_.edges[other].to)];
            if (std::max(std::abs(line.off(c)), std::abs(line.off(d))) > near_) continue;
            line.trace.push_back(std::minmax(line.at(c), line.at(d)));
        }
        std::sort(line.trace.begin(), line.trace.end());
        return line;
    }

    /// If the node lies on an edge of cells, makes it a corner of these cells.
    void insert_node(int node) {
        if (!net_.around(node).empty()) return;
        const Point p = net_.place(node);
        for (const int cell : net_.cells_near({p, p})) {
            const Loop& l = net_.loop(cell);
            for (std::size_t k = 0; k < l.size(); ++k) {
                if (distance_to({net_.place(l.corners[k]), net_.place(l.corners[l.next(k)])}, p) > near_) continue;
                net_.insert_into(l.corners[k], l.corners[l.next(k)], node);
                return;
            }
        }
    }
    struct Move {
        double away;
        int corner;
        std::size_t line;
        bool operator<(const Move& other) const {
            return std::tie(away, corner, line) < std::tie(other.away, other.corner, other.line);
        }
    };

    /// Moves corners onto traces, starting with the nearest, so that corners moved later can be merged with them.
    void put_corners_onto_traces() {
        std::vector<Segment> segments;
        segments.reserve(lines_.size());
        for (const Line& line : lines_) segments.push_back({net_.place(line.from), net_.place(line.to)});
        const double reach = onto_trace_share * spacing_;
        const SegmentGrid grid(segments, reach);
        std::set<int> fixed;
        for (const Line& line : lines_) fixed.insert({line.from, line.to});
        std::vector<Move> moves;
        for (int corner = 0; corner < static_cast<int>(net_.corners()); ++corner) {
            if (fixed.contains(corner) || net_.around(corner).empty() || net_.on_trace(corner)) continue;
            std::optional<Move> best;
            grid.each_near(net_.place(corner), [&](std::size_t k) {
                const double away = distance_to(segments[k], net_.place(corner));
                const Move move{away, corner, k};
                if (away <= reach && (!best || move < *best)) best = move;
            });
            if (best) moves.push_back(*best);
        }
        std::sort(moves.begin(), moves.end());
        std::vector<std::vector<int>> on(lines_.size());  // for each line, the corners that lie on it
        for (std::size_t k = 0; k < lines_.size(); ++k) on[k] = {lines_[k].from, lines_[k].to};
        for (const Move& move : moves) {
            patience_.piece();
            const Line& line = lines_[move.line];
            const Point p = net_.place(move.corner);
            const double s = std::clamp(line.at(p), 0.0, line.length);
            Point target{line.start.x + s * line.along.x, line.start.y + s * line.along.y};
            const int taken = nearest_of(on[move.line], target);
            if (distance(net_.place(taken), target) < onto_corner_share * spacing_) {
                put_together(move.corner, taken);
                continue;
            }
            const unsigned walls = sides_at(p, domain_);
            if (walls != 0) continue;  // a corner on a wall stays on that wall
            if (net_.move_to(move.corner, target)) on[move.line].push_back(move.corner);
        }
    }
    int nearest_of(const std::vector<int>& corners, Point p) const {
        return *std::min_element(corners.begin(), corners.end(),
                                 [&](int a, int b) { return distance(net_.place(a), p) < distance(net_.place(b), p); });
    }
    /// Merges a corner with another corner; a corner on a wall stays on that wall.
    void put_together(int corner, int onto) {
        const unsigned walls = sides_at(net_.place(corner), domain_);
        if ((walls & ~sides_at(net_.place(onto), domain_)) != 0) return;
        std::map<int, Loop> changed;
        for (const int cell : net_.around(corner)) {
            Loop made = net_.loop(cell);
            std::replace(made.corners.begin(), made.corners.end(), corner, onto);
            for (std::size_t k = 0; k < made.size() && made.size() > 2; ++k) {
                if (made.corners[k] != made.corners[made.next(k)]) continue;
                made.corners.erase(made.corners.begin() + static_cast<std::ptrdiff_t>(k));
                made.traces.erase(made.traces.begin() + static_cast<std::ptrdiff_t>(k));
                --k;
            }
            const std::set<int> distinct(made.corners.begin(), made.corners.end());
            if (made.size() < 3 || distinct.size() != made.size() || !net_.convex(made)) return;
            changed.emplace(cell, std::move(made));
        }
        const bool joined = std::any_of(changed.begin(), changed.end(),
                                        [&](const auto& cell) { return net_.around(onto).contains(cell.first); });
        if (net_.around(onto).empty() ? !surrounded(changed, onto) : !joined) return;
        for (auto& [cell, made] : changed) net_.replace(cell, std::move(made));
    }
    /// Whether the node is at a corner or lies inside one of the changed cells.
    bool surrounded(const std::map<int, Loop>& changed, int onto) {
        for (const int cell : net_.cells_near({net_.place(onto), net_.place(onto)}))
            if (net_.inside(net_.loop(cell), net_.place(onto))) return changed.contains(cell);
        return true;
    }
    /// Cuts the cells that an edge of the graph crosses, along the line of this edge.
    void cut(const Line& line, int trace) {
        for (const int cell : net_.cells_near(box_of(net_.place(line.from), net_.place(line.to)))) {
            patience_.piece();
            const std::optional<std::pair<int, int>> ends = ends_of_cut(cell, line);
            if (!ends) continue;
            split(cell, ends->first, ends->second);
            mark_cut(line, ends->first, ends->second, trace);
        }
    }
    /// The two corners between which the line cuts the cell; corners that do not exist yet are inserted.
    std::optional<std::pair<int, int>> ends_of_cut(int cell, const Line& line) {
        struct End {
            double along;
            int corner;  // -1 if the corner has yet to be inserted
            int u, v;    // the corners between which the new corner is inserted
            Point place;
        };
        std::vector<End> ends;
        const Loop& l = net_.loop(cell);
        double lowest = 0.0, highest = 0.0;
        for (std::size_t k = 0; k < l.size(); ++k) {
            const int u = l.corners[k], v = l.corners[l.next(k)];
            const Point a = net_.place(u), b = net_.place(v);
            const double before = line.off(a), after = line.off(b);
            lowest = std::min(lowest, before);
            highest = std::max(highest, before);
            if (std::abs(before) <= near_) {
                ends.push_back({line.at(a), u, u, u, a});
            } else if (std::abs(after) > near_ && (before < 0.0) != (after < 0.0)) {
                const double share = before / (before - after);
                const Point p = on_wall_of(a, b, line.foot({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}));
                ends.push_back({line.at(p), -1, u, v, p});
            }
        }
        if (lowest >= -near_ || highest <= near_ || ends.size() < 2) return std::nullopt;
        const auto by_along = [](const End& a, const End& b) { return a.along < b.along; };
        const End first = *std::min_element(ends.begin(), ends.end(), by_along),
                  last = *std::max_element(ends.begin(), ends.end(), by_along);
        if (std::min(last.along, line.length) - std::max(first.along, 0.0) <= 4.0 * near_) return std::nullopt;
        if (!enters(l, line, first.along, last.along)) return std::nullopt;
        const auto corner_of = [&](const End& end) {
            if (end.corner >= 0) return end.corner;
            const int corner = net_.corner_at(end.place);
            net_.insert_into(end.u, end.v, corner);
            return corner;
        };
        const int from = corner_of(first), to = corner_of(last);
        return std::pair{from, to};
    }
    /// Whether to cut the cell. If the trace ends in the cell after a short distance, or the cut would leave a small
    /// piece, the cell is not cut. The trace then ends at the cell's outline.
    bool enters(const Loop& l, const Line& line, double first, double last) {
        const double covered = line.covered(first, last), length = last - first;
        if (length - covered <= near_) return true;  // the trace does not end in this cell
        const bool in =
            covered >= least_face_share * length && smaller_part(l, line) >= smallest_piece_share * spacing_ * spacing_;
        if (!in) moved_by(covered);
        return in;
    }
    double smaller_part(const Loop& l, const Line& line) const {
        std::vector<Point> left, scratch;
        left.reserve(l.size());
        for (const int corner : l.corners) left.push_back(net_.place(corner));
        const double nx = -line.along.y, ny = line.along.x;
        clip(left, nx, ny, nx * line.start.x + ny * line.start.y, scratch);
        const double part = polygon_area(left);
        return std::min(part, net_.area(l) - part);
    }
    void moved_by(double length) {
        ++moved_;
        largest_move_ = std::max(largest_move_, length);
    }
    /// If a and b lie on the same wall, moves the point p exactly onto this wall.
    Point on_wall_of(Point a, Point b, Point p) const {
        const unsigned walls = sides_at(a, domain_) & sides_at(b, domain_);
        if ((walls & (side_left | side_right)) != 0) p.x = a.x;
        if ((walls & (side_bottom | side_top)) != 0) p.y = a.y;
        return p;
    }
    void split(int cell, int from, int to) {
        const Loop l = net_.loop(cell);
        const auto index = [&](int corner) {
            return static_cast<std::size_t>(std::find(l.corners.begin(), l.corners.end(), corner) - l.corners.begin());
        };
        Loop one = CellNet::part_of(l, index(from), index(to)), other = CellNet::part_of(l, index(to), index(from));
        net_.replace(cell, std::move(one));
        const int piece = net_.add(std::move(other));
        ++cut_;
        pieces_.insert({cell, piece});
    }
    /// Marks the edges along a cut as lying on the trace. If the cut extends far beyond the trace's end, the end
    /// becomes a corner, and the part beyond it is not marked.
    void mark_cut(const Line& line, int from, int to, int trace) {
        const double first = line.at(net_.place(from)), last = line.at(net_.place(to)), length = last - first;
        std::vector<std::pair<double, double>> parts;  // positions of the parts of the cut that belong to the trace
        for (auto [begin, end] : line.trace) {
            begin = std::max(begin, first);
            end = std::min(end, last);
            if (end - begin <= near_) continue;
            if (parts.empty() || begin - parts.back().second > near_)
                parts.emplace_back(begin, end);
            else
                parts.back().second = std::max(end, parts.back().second);
        }
        if (parts.empty()) return;
        if (const double bare = parts.front().first - first; bare > near_ && bare < least_face_share * length) {
            parts.front().first = first;
            moved_by(bare);
        }
        if (const double bare = last - parts.back().second; bare > near_ && bare < least_face_share * length) {
            parts.back().second = last;
            moved_by(bare);
        }
        net_.each_square(box_of(net_.place(from), net_.place(to)), [&](std::int64_t i, std::int64_t j) {
            nodes_at_.each_at(i, j, [&](std::size_t number) {
                const int node = static_cast<int>(number);
                const Segment cut_line{net_.place(from), net_.place(to)};
                if (net_.around(node).empty() && distance_to(cut_line, net_.place(node)) <= near_)
                    insert_into_cut(from, to, node);
            });
        });
        for (const int cell : net_.cells_near(box_of(net_.place(from), net_.place(to)))) {
            Loop& l = net_.loop(cell);
            for (std::size_t k = 0; k < l.size(); ++k) {
                const Point a = net_.place(l.corners[k]), b = net_.place(l.corners[l.next(k)]);
                if (l.traces[k] >= 0 || std::max(std::abs(line.off(a)), std::abs(line.off(b))) > near_) continue;
                const double middle = 0.5 * (line.at(a) + line.at(b));
                for (const auto& [begin, end] : parts)
                    if (middle > begin && middle < end) l.traces[k] = trace;
            }
        }
    }
    /// Inserts a node into the edge between the two corners of the cut, in the cells on both sides.
    void insert_into_cut(int from, int to, int node) {
        const std::set<int> cells = net_.around(from);
        for (const int cell : cells) {
            const Loop& l = net_.loop(cell);
            for (std::size_t k = 0; k < l.size(); ++k) {
                const int u = l.corners[k], v = l.corners[l.next(k)];
                if (distance_to({net_.place(from), net_.place(to)}, net_.place(u)) > near_ ||
                    distance_to({net_.place(from), net_.place(to)}, net_.place(v)) > near_ ||
                    distance_to({net_.place(u), net_.place(v)}, net_.place(node)) > near_)
                    continue;
                net_.insert_into(u, v, node);
                return;
            }
        }
    }

    /// Marks cell edges that already lie on a trace before anything is cut.
    void mark(const Line& line, int trace) {
        const Segment s{net_.place(line.from), net_.place(line.to)};
        for (const int cell : net_.cells_near(box_of(s.a, s.b))) {
            Loop& l = net_.loop(cell);
            for (std::size_t k = 0; k < l.size(); ++k) {
                const Point a = net_.place(l.corners[k]), b = net_.place(l.corners[l.next(k)]);
                if (l.traces[k] < 0 && distance_to(s, a) <= near_ && distance_to(s, b) <= near_) l.traces[k] = trace;
            }
        }
    }

    void join_small_pieces() {
        const double least = smallest_piece_share * spacing_ * spacing_;
        std::vector<int> small;
        for (const int piece : pieces_)
            if (net_.area(net_.loop(piece)) < least) small.push_back(piece);
        for (int piece : small) {
            while (!net_.loop(piece).corners.empty() && net_.area(net_.loop(piece)) < least) {
                patience_.piece();
                const int into = net_.join(piece);
                if (into < 0) {
                    const double area = net_.area(net_.loop(piece));
                    if (area >= least_area_) break;
                    if (!divided_again_ || !net_.divide_again(piece, least_area_)) refuse(piece, area);
                }
                ++joined_;
                if (into < 0) break;
                piece = into;
            }
        }
    }
    [[noreturn]] void refuse(int piece, double piece_area) {
        std::set<int> named;
        for (const int corner : net_.loop(piece).corners)
            for (const int cell : net_.around(corner))
                for (const int trace : net_.loop(cell).traces)
                    if (trace >= 0) named.insert(trace);
        std::vector<int> traces(named.begin(), named.end());
        const Point at = net_.place(net_.loop(piece).corners[0]);
        const std::string text = fmt::format(
            "mesh: traces {} cut off a sliver with only {:.2g} of the mean cell area at ({:.9g}, {:.9g}), expected at "
            "least {:.2g}; they lie too close to each other or to a wall. Remove or move one of them, or use smaller "
            "particles",
            fmt::join(traces, ", "), piece_area / (spacing_ * spacing_), at.x, at.y,
            least_area_ / (spacing_ * spacing_));
        throw MeshError(text, {}, std::move(traces));
    }
    TracedCells result() {
        TracedCells made;
        for (const Loop& l : net_.loops()) {
            if (l.corners.empty()) continue;
            made.cells.cells.push_back({static_cast<std::uint32_t>(made.cells.corners.size()),
                                        static_cast<std::uint32_t>(l.size()), l.centre});
            for (const int corner : l.corners) made.cells.corners.push_back(net_.place(corner));
            made.traces.insert(made.traces.end(), l.traces.begin(), l.traces.end());
        }
        made.cut = cut_;
        made.joined = joined_;
        made.ends_moved = moved_;
        made.largest_move = largest_move_;
        return made;
    }

    Rectangle domain_;
    const TraceGraph& graph_;
    std::vector<std::size_t> cut_by_;
    Patience& patience_;
    double spacing_, least_area_;
    bool divided_again_;
    double near_;
    CellNet net_;
    std::map<int, std::vector<std::size_t>> of_trace_;  // indices of the graph's edges for each trace
    std::vector<Line> lines_;
    Squares nodes_at_;
    std::set<int> pieces_;
    double largest_move_ = 0.0;
    std::size_t moved_ = 0, cut_ = 0, joined_ = 0;
};

}  // namespace

TracedCells cut_cells(const TracedCells& whole, const Rectangle& domain, const TraceGraph& graph,
                      std::span<const std::size_t> cut_by, double spacing, SmallPieces small_pieces,
                      Patience& patience) {
    return CellCutter(whole, domain, graph, cut_by, spacing, small_pieces, patience).make();
}

}  // namespace crackle
