// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/joints/clean_traces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "mesher/trace_graph.hpp"

namespace crackle {
namespace {

// Tolerances for simplifying traces and for merging nodes, relative to the snap distance.
constexpr double simplified_share = 0.25, near_share = 0.5;
// Two traces that run within the distance near_ of each other over at least long_stretch times that distance are
// merged. They separate over parting_stretch times that distance.
constexpr double long_stretch = 10.0, parting_stretch = 5.0;
// Distance, relative to the largest coordinate, within which a trace must pass its nodes to count as unmoved. This is
// half the distance below which the mesher treats two points as one, so the mesher still finds these nodes on the
// trace.
constexpr double same_place_share = 5e-14;
constexpr int most_passes = 100;  // about three passes are needed; every trace stays within snap in each pass

struct Line {
    Vec2 a, b;

    Vec2 at(double share) const { return a + share * (b - a); }
    double length() const { return norm(b - a); }
    /// Parameter, 0 to 1, of the point on the line that is nearest to p.
    double share_at(Vec2 p) const {
        const Vec2 d = b - a;
        const double squared = dot(d, d);
        return squared > 0.0 ? std::clamp(dot(p - a, d) / squared, 0.0, 1.0) : 0.0;
    }
    double distance_to(Vec2 p) const { return norm(at(share_at(p)) - p); }
};

double distance_to(const std::vector<Vec2>& points, Vec2 p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
        least = std::min(least, Line{points[k], points[k + 1]}.distance_to(p));
    return least;
}

/// Simplifies a trace: points within the tolerance of straight lines between the remaining points are removed.
std::vector<Vec2> simplified(const std::vector<Vec2>& points, double tolerance) {
    std::vector<char> kept(points.size(), 0);
    kept.front() = kept.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, points.size() - 1}};
    while (!parts.empty()) {
        const auto [first, last] = parts.back();
        parts.pop_back();
        double furthest = tolerance;
        std::size_t at = first;
        for (std::size_t k = first + 1; k < last; ++k) {
            const double off = Line{points[first], points[last]}.distance_to(points[k]);
            if (off <= furthest) continue;
            furthest = off;
            at = k;
        }
        if (at == first) continue;
        kept[at] = 1;
        parts.emplace_back(first, at);
        parts.emplace_back(at, last);
    }
    std::vector<Vec2> left;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (kept[k] != 0 && (left.empty() || left.back() != points[k])) left.push_back(points[k]);
    return left;
}

class TraceCleaner {
  public:
    TraceCleaner(const std::vector<JointTrace>& traces, const Domain& box, double snap, double reach)
        : given_(traces),
          box_(box),
          simplified_(simplified_share * snap),
          near_(near_share * snap),
          farthest_((1.0 - simplified_share) * snap),
          same_place_(same_place_share *
                      std::max({std::abs(box.x1), std::abs(box.x2), std::abs(box.y1), std::abs(box.y2)})),
          squares_(near_),
          changed_(traces.size(), 0) {
        report_.snap = snap;
        simplify();
        if (reach > 0.0) join_ends(reach);
        place_nodes();
        for (int pass = 0; pass < most_passes && bring_together(); ++pass) {
        }
        keep_joined_ends();
    }

    std::vector<JointTrace> cleaned() {
        std::vector<JointTrace> all;
        std::set<std::pair<int, int>> taken;
        for (std::size_t t = 0; t < given_.size(); ++t) {
            report_.length_before += given_[t].length();
            append(all, t, taken);
        }
        for (const JointTrace& trace : all) report_.length += trace.length();
        return all;
    }
    const Cleaning& report() const { return report_; }

  private:
    /// A straight segment of a trace, or a wall, with the nodes through which it currently runs.
    struct Part {
        std::size_t trace;  // unused for walls
        Line given;
        std::vector<int> nodes;
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Edge {
        std::size_t part, index;  // index of the part, and of the node at which the edge begins
        int from, to;
        Line line;

        bool ends_at(int node) const { return from == node || to == node; }
    };

    void simplify() {
        for (const JointTrace& trace : given_) {
            lines_.push_back(simplified(trace.points, simplified_));
            const std::size_t fewer = trace.points.size() - lines_.back().size();
            report_.points_left_out += fewer;
            if (fewer > 0) changed_[lines_.size() - 1] = 1;
        }
    }

    /// Moves the ends of traces to where the mesher would extend them.
    void join_ends(double reach) {
        std::vector<std::vector<Point>> lines;
        for (const std::vector<Vec2>& points : lines_) {
            std::vector<Point>& line = lines.emplace_back();
            for (const Vec2 p : points) line.push_back({p.x, p.y});
        }
        joined_ = trace_graph({box_.x1, box_.x2, box_.y1, box_.y2}, lines, reach).moved;
        for (const TraceGraph::MovedEnd& end : joined_) {
            std::vector<Vec2>& points = lines_[static_cast<std::size_t>(end.trace)];
            (end.first ? points.front() : points.back()) = {end.place.x, end.place.y};
        }
    }
    /// Marks traces as changed if the mesher would extend their ends to a trace that has changed.
    void keep_joined_ends() {
        for (bool more = true; more;) {
            more = false;
            for (const TraceGraph::MovedEnd& end : joined_) {
                const auto trace = static_cast<std::size_t>(end.trace);
                if (end.onto < 0 || changed_[trace] != 0 || changed_[static_cast<std::size_t>(end.onto)] == 0) continue;
                changed_[trace] = 1;
                more = true;
            }
        }
    }

    unsigned walls_at(Vec2 p) const {
        return (p.x == box_.x1 ? 1U : 0U) | (p.x == box_.x2 ? 2U : 0U) | (p.y == box_.y1 ? 4U : 0U) |
               (p.y == box_.y2 ? 8U : 0U);
    }
    /// Moves a point onto nearby walls.
    Vec2 at_near_walls(Vec2 p) const {
        for (const double wall : {box_.x1, box_.x2})
            if (std::abs(p.x - wall) <= near_) p.x = wall;
        for (const double wall : {box_.y1, box_.y2})
            if (std::abs(p.y - wall) <= near_) p.y = wall;
        return p;
    }

    Vec2 place(int node) const { return nodes_[static_cast<std::size_t>(node)]; }
    int add_node(Vec2 p) {
        squares_.add(squares_.index(p.x), squares_.index(p.y), nodes_.size());
        nodes_.push_back(p);
        return static_cast<int>(nodes_.size()) - 1;
    }
    /// The nearest node within the distance near_ that passes a test; -1 if there is no such node.
    template <class Test>
    int node_near(Vec2 p, Test test) const {
        int best = -1;
        double least = near_;
        const std::int64_t i = squares_.index(p.x), j = squares_.index(p.y);
        for (std::int64_t u = i - 1; u <= i + 1; ++u) {
            for (std::int64_t v = j - 1; v <= j + 1; ++v) {
                squares_.each_at(u, v, [&](std::size_t number) {
                    const int node = static_cast<int>(number);
                    const double away = norm(nodes_[number] - p);
                    if (away > least || (away == least && best >= 0 && best < node) || !test(node)) return;
                    least = away;
                    best = node;
                });
            }
        }
        return best;
    }
    /// Adds a node unless another node is near, so that the number of nodes in the box is bounded.
    /// @return -1 if another node is near
    int new_node(Vec2 p) {
        return node_near(p, [](int) { return true; }) < 0 ? add_node(p) : -1;
    }
    /// The node for a point of a trace: an existing one nearby, or a new one at the point or on a nearby wall. Points
    /// on a wall stay on the wall.
    int node_for(Vec2 p) {
        const unsigned walls = walls_at(p);
        const int near = node_near(p, [&](int node) { return (walls_at(place(node)) & walls) == walls; });
        if (near >= 0) return near;
        const Vec2 there = at_near_walls(p);
        if (there == p) return add_node(p);
        const unsigned these = walls_at(there);
        const int beside = node_near(there, [&](int node) {
            return (walls_at(place(node)) & these) == these && norm(place(node) - p) <= farthest_;
        });
        return beside >= 0 ? beside : add_node(there);
    }

    /// Places nodes for corners first, then for points on walls, then for all others.
    void place_nodes() {
        const std::array<Vec2, 4> corners{Vec2{box_.x1, box_.y1}, Vec2{box_.x2, box_.y1}, Vec2{box_.x2, box_.y2},
                                          Vec2{box_.x1, box_.y2}};
        for (const Vec2 corner : corners) add_node(corner);
        for (int k = 0; k < 4; ++k) {
            const int next = (k + 1) % 4;
            parts_.push_back({none, {place(k), place(next)}, {k, next}});
        }
        std::vector<std::vector<int>> nodes;
        nodes.reserve(lines_.size());
        for (const std::vector<Vec2>& points : lines_) nodes.emplace_back(points.size(), -1);
        for (const bool on_walls : {true, false})
            for (std::size_t t = 0; t < lines_.size(); ++t)
                for (std::size_t k = 0; k < lines_[t].size(); ++k)
                    if ((walls_at(lines_[t][k]) != 0) == on_walls) nodes[t][k] = node_for(lines_[t][k]);
        for (std::size_t t = 0; t < lines_.size(); ++t) {
            for (std::size_t k = 0; k < lines_[t].size(); ++k) {
                note_move(t, norm(place(nodes[t][k]) - lines_[t][k]));
                if (k + 1 < lines_[t].size())
                    parts_.push_back({t, {lines_[t][k], lines_[t][k + 1]}, {nodes[t][k], nodes[t][k + 1]}});
            }
        }
    }
    void note_move(std::size_t trace, double away) {
        if (trace == none || away <= same_place_) return;
        changed_[trace] = 1;
        ++report_.brought_together;
    }

    std::vector<Edge> edges() const {
        std::vector<Edge> all;
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const std::vector<int>& nodes = parts_[p].nodes;
            for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
                if (nodes[k] != nodes[k + 1])
                    all.push_back({p, k, nodes[k], nodes[k + 1], {place(nodes[k]), place(nodes[k + 1])}});
        }
        return all;
    }

    /// Whether an edge may be routed through a node.
    bool may_take(const Edge& edge, int node) const {
        const Part& part = parts_[edge.part];
        if (std::find(part.nodes.begin(), part.nodes.end(), node) != part.nodes.end()) return false;
        const double away = part.given.distance_to(place(node));
        return part.trace == none ? away == 0.0 : away <= farthest_;
    }
    bool has_or_may_take(const Edge& edge, int node) const { return edge.ends_at(node) || may_take(edge, node); }
    void take(const Edge& edge, int node) {
        if (!edge.ends_at(node)) taken_[{edge.part, edge.index}].push_back(node);
    }

    /// Makes one pass over all pairs of edges that are near each other. @return whether anything was changed
    bool bring_together() {
        const std::vector<Edge> all = edges();
        std::vector<Segment> segments;
        segments.reserve(all.size());
        for (const Edge& e : all) segments.push_back({{e.line.a.x, e.line.a.y}, {e.line.b.x, e.line.b.y}});
        auto pairs = near_pairs(segments, near_);
        std::sort(pairs.begin(), pairs.end());
        taken_.clear();
        for (const auto& [i, j] : pairs) attract(all[i], all[j]);
        // Edges that cross or run side by side are joined only in a pass that routes no edge through an end of another.
        if (taken_.empty()) {
            for (const auto& [i, j] : pairs) {
                if (const auto crossing = crossing_of(all[i], all[j]))
                    cross_at(all[i], all[j], *crossing);
                else
                    run_together(all[i], all[j]);
            }
        }
        const bool any = !taken_.empty();
        for (auto& [where, nodes] : taken_) sort_along(where, nodes);
        for (auto where = taken_.rbegin(); where != taken_.rend(); ++where) insert(where->first, where->second);
        return any;
    }
    using Where = std::pair<std::size_t, std::size_t>;  // index of a part, and of an edge within it
    void sort_along(const Where& where, std::vector<int>& nodes) const {
        const std::vector<int>& of = parts_[where.first].nodes;
        const Line line{place(of[where.second]), place(of[where.second + 1])};
        std::stable_sort(nodes.begin(), nodes.end(),
                         [&](int m, int n) { return line.share_at(place(m)) < line.share_at(place(n)); });
    }
    void insert(const Where& where, const std::vector<int>& nodes) {
        Part& part = parts_[where.first];
        const Line line{place(part.nodes[where.second]), place(part.nodes[where.second + 1])};
        std::size_t at = where.second + 1;
        for (const int node : nodes) {
            if (std::find(part.nodes.begin(), part.nodes.end(), node) != part.nodes.end()) continue;
            part.nodes.insert(part.nodes.begin() + static_cast<std::ptrdiff_t>(at++), node);
            note_move(part.trace, line.distance_to(place(node)));
        }
    }

    /// Routes each of two edges through those ends of the other edge that are near it.
    void attract(const Edge& s, const Edge& t) {
        for (const auto& [edge, other] : {std::pair{&s, &t}, {&t, &s}})
            for (const int node : {other->from, other->to})
                if (!edge->ends_at(node) && edge->line.distance_to(place(node)) < near_ && may_take(*edge, node))
                    take(*edge, node);
    }

    /// Point where two edges cross, unless they meet at a common end.
    static std::optional<Vec2> crossing_of(const Edge& s, const Edge& t) {
        if (s.ends_at(t.from) || s.ends_at(t.to)) return std::nullopt;
        const Vec2 d = s.line.b - s.line.a, e = t.line.b - t.line.a, between = t.line.a - s.line.a;
        const double sine = cross(d, e);
        if (sine == 0.0) return std::nullopt;
        const double of_s = cross(between, e) / sine, of_t = cross(between, d) / sine;
        if (!(of_s > 0.0 && of_s < 1.0 && of_t > 0.0 && of_t < 1.0)) return std::nullopt;
        // The longer edge gives the more accurate point.
        return s.line.length() >= t.line.length() ? s.line.at(of_s) : t.line.at(of_t);
    }
    void cross_at(const Edge& s, const Edge& t, Vec2 crossing) {
        int node = node_near(crossing, [&](int n) { return has_or_may_take(s, n) && has_or_may_take(t, n); });
        if (node < 0) node = new_node(crossing);
        if (node < 0) return;  // the mesher will cut both edges at the crossing
        take(s, node);
        take(t, node);
    }

    /// If the later edge t stays near s over a long stretch, it is made to follow s. It leaves s over a short stretch
    /// of its own.
    void run_together(const Edge& s, const Edge& t) {
        if (s.ends_at(t.from) && s.ends_at(t.to)) return;
        const double length = t.line.length();
        if (length < long_stretch * near_ || s.line.length() < long_stretch * near_) return;
        const auto away = [&](double share) { return s.line.distance_to(t.line.at(share)); };
        double nearest = 0.0;
        for (const double share : {1.0, t.line.share_at(s.line.a), t.line.share_at(s.line.b)})
            if (away(share) < away(nearest)) nearest = share;
        if (away(nearest) > near_) return;
        const auto last_near = [&](double end) {
            if (away(end) <= near_) return end;
            double inside = nearest, outside = end;
            for (int halving = 0; halving < 60; ++halving) {
                const double middle = 0.5 * (inside + outside);
                (away(middle) <= near_ ? inside : outside) = middle;
            }
            return inside;
        };
        const double first = last_near(0.0), last = last_near(1.0);
        if ((last - first) * length < long_stretch * near_) return;
        for (const auto& [share, end] : {std::pair{first, 0.0}, {last, 1.0}}) {
            if (share == end) continue;
            Vec2 foot = s.line.at(s.line.share_at(t.line.at(share)));
            if (parts_[s.part].trace == none) foot = on_wall(s.line, foot);
            int node = node_near(foot, [&](int n) { return has_or_may_take(s, n) && has_or_may_take(t, n); });
            if (node < 0 && parts_[t.part].given.distance_to(foot) <= farthest_) node = new_node(foot);
            if (node < 0) continue;
            take(s, node);
            take(t, node);
            const double parted = share + (end > share ? 1.0 : -1.0) * parting_stretch * near_ / length;
            if (std::abs(end - parted) * length < 0.5 * parting_stretch * near_ || parted < 0.0 || parted > 1.0)
                continue;
            const Vec2 own = t.line.at(parted);
            int leaving = node_near(own, [&](int n) { return has_or_may_take(t, n); });
            if (leaving < 0) leaving = new_node(own);
            if (leaving >= 0) take(t, leaving);
        }
    }
    static Vec2 on_wall(const Line& wall, Vec2 p) {
        return wall.a.x == wall.b.x ? Vec2{wall.a.x, p.y} : Vec2{p.x, wall.a.y};
    }

    /// All nodes of a trace; consecutive nodes are distinct.
    std::vector<int> nodes_of(std::size_t trace) {
        std::vector<int> all;
        for (; next_part_ < parts_.size(); ++next_part_) {
            const Part& part = parts_[next_part_];
            if (part.trace == none) continue;
            if (part.trace != trace) break;
            for (const int node : part.nodes)
                if (all.empty() || all.back() != node) all.push_back(node);
        }
        return all;
    }
    /// Appends the pieces of a trace that lie neither on a wall nor on an earlier trace.
    void append(std::vector<JointTrace>& all, std::size_t trace, std::set<std::pair<int, int>>& taken) {
        const std::vector<int> nodes = nodes_of(trace);
        std::vector<std::vector<Vec2>> pieces;
        bool goes_on = false, whole = true;
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
            const Vec2 a = place(nodes[k]), b = place(nodes[k + 1]);
            const bool own =
                (walls_at(a) & walls_at(b)) == 0 && taken.insert(std::minmax(nodes[k], nodes[k + 1])).second;
            if (!own) {
                report_.coincident += norm(b - a);
                goes_on = whole = false;
                continue;
            }
            if (!goes_on) pieces.push_back({a});
            pieces.back().push_back(b);
            goes_on = true;
        }
        if (nodes.size() < 2) {
            report_.coincident += given_[trace].length();
            return;
        }
        const JointTrace& given = given_[trace];
        if (whole && changed_[trace] == 0) {
            all.push_back(given);
            return;
        }
        measure(trace, nodes);
        const auto longest = std::max_element(pieces.begin(), pieces.end(),
                                              [](const auto& p, const auto& q) { return length_of(p) < length_of(q); });
        for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
            all.push_back(given);
            all.back().points = *piece;
            all.back().centred = given.centred && piece == longest;
        }
    }
    /// Measures how far the trace has moved from its original position. Extensions of its ends do not count, nor do end
    /// pieces that are cut off.
    void measure(std::size_t trace, const std::vector<int>& nodes) {
        std::vector<Vec2> was = given_[trace].points, is;
        was.front() = lines_[trace].front();
        was.back() = lines_[trace].back();
        for (const int node : nodes) is.push_back(place(node));
        double& largest = report_.largest_displacement;
        for (const Vec2 p : is) largest = std::max(largest, distance_to(was, p));
        for (const Vec2 p : was)
            if (distance_to(lines_[trace], p) <= simplified_) largest = std::max(largest, distance_to(is, p));
    }

    const std::vector<JointTrace>& given_;
    Domain box_;
    double simplified_, near_, farthest_, same_place_;
    std::vector<std::vector<Vec2>> lines_;  // simplified traces, with ends extended as the mesher would
    std::vector<TraceGraph::MovedEnd> joined_;
    std::vector<Part> parts_;  // walls, then the parts of all traces in order
    std::size_t next_part_ = 0;
    std::vector<Vec2> nodes_;
    Squares squares_;
    std::vector<char> changed_;                // by trace: whether it has changed
    std::map<Where, std::vector<int>> taken_;  // nodes through which edges are to be routed
    Cleaning report_;
};

}  // namespace

std::string cleaning_text(const Cleaning& cleaning) {
    if (!(cleaning.snap > 0.0)) return "";
    const std::string snap = fmt::format(
        "joints: snap = {:.4g} m{}", cleaning.snap,
        cleaning.derived ? fmt::format(" by default, {} times the mean spacing of the grains", snap_share) : "");
    if (!cleaning.changed()) return snap + ": no nodes are close enough to be merged, and no point can be removed";
    std::string text = fmt::format(
        "{}: {} point{} left out, {} node{} brought together, none moved further than {:.3g} m; {:.6g} m of "
        "traces ({:.6g} m before)",
        snap, cleaning.points_left_out, cleaning.points_left_out == 1 ? "" : "s", cleaning.brought_together,
        cleaning.brought_together == 1 ? "" : "s", cleaning.largest_displacement, cleaning.length,
        cleaning.length_before);
    if (cleaning.coincident > 0.0)
        text += fmt::format("; {:.3g} m of traces were removed because they lay on other traces or walls",
                            cleaning.coincident);
    return text;
}

Cleaning clean_traces(std::vector<JointTrace>& traces, const Domain& box, double snap, double reach) {
    if (traces.empty() || !(snap > 0.0)) return {};
    TraceCleaner cleaner(traces, box, snap, reach);
    std::vector<JointTrace> cleaned = cleaner.cleaned();
    traces = std::move(cleaned);
    return cleaner.report();
}

}  // namespace crackle
