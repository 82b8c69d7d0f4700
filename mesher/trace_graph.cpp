// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/trace_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "mesher/inset.hpp"
#include "mesher/partition.hpp"

namespace crackle {
namespace {

// Two points are treated as one if they are closer together than this fraction of the largest coordinate. Where three
// lines meet, their pairwise intersections differ by a few rounding errors.
constexpr double same_place_share = 1e-13;
constexpr std::size_t most_pairs = 5'000'000;

Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point along(Point a, Point b, double share) { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }

struct Piece : Segment {
    int trace;            // -1 for a wall
    bool ends_a, ends_b;  // whether a and b are ends of the whole trace
};

/// Position of p along the line through a and b: 0 at a, 1 at b.
double share_at(const Piece& s, Point p) { return dot(p - s.a, s.b - s.a) / dot(s.b - s.a, s.b - s.a); }
double off_line(const Piece& s, Point p) { return std::abs(cross(s.b - s.a, p - s.a)) / distance(s.a, s.b); }

/// Intersection of the lines of two pieces, as positions along both (see share_at()); empty for parallel lines.
std::optional<std::pair<double, double>> lines_meet(const Piece& s, const Piece& t) {
    const Point d = s.b - s.a, e = t.b - t.a;
    const double sine = cross(d, e);
    if (std::abs(sine) <= 64.0 * relative_rounding * std::sqrt(dot(d, d) * dot(e, e))) return std::nullopt;
    const Point between = t.a - s.a;
    return std::pair{cross(between, e) / sine, cross(between, d) / sine};
}

/// Whether two segments are certainly farther apart than `reach`, judged by their extents along the normal of either.
bool lie_apart(const Segment& s, const Segment& t, double reach) {
    const auto beside = [reach](const Segment& line, const Segment& other) {
        const Point d = line.b - line.a;
        const double from = cross(d, other.a - line.a), to = cross(d, other.b - line.a);
        const double room = reach * std::sqrt(dot(d, d));
        return std::min(from, to) > room || std::max(from, to) < -room;
    };
    return beside(s, t) || beside(t, s);
}

/// Direction perpendicular to the mean direction of the segments, weighted by length. The extents of segments parallel
/// to the mean direction are smallest along this direction.
Point across_most(std::span<const Segment> segments) {
    double cosine = 0.0, sine = 0.0;
    for (const Segment& s : segments) {
        const Point d = s.b - s.a;
        const double length = std::sqrt(dot(d, d));
        cosine += (d.x * d.x - d.y * d.y) / length;
        sine += 2.0 * d.x * d.y / length;
    }
    const double size = std::sqrt(cosine * cosine + sine * sine);
    if (!(size > 0.0)) return {1.0, 0.0};
    const double half_cosine = std::sqrt(0.5 * (1.0 + std::min(cosine / size, 1.0)));
    const double half_sine = std::sqrt(0.5 * (1.0 + std::min(-cosine / size, 1.0)));
    return {sine < 0.0 ? half_sine : -half_sine, half_cosine};
}

class GraphMaker {
  public:
    GraphMaker(const Rectangle& box, std::span<const std::vector<Point>> traces, double reach)
        : box_(box), reach_(reach), same_place_(same_place_share * coordinate_scale(box)) {
        const std::array<Point, 4> corners{Point{box.x1, box.y1}, {box.x2, box.y1}, {box.x2, box.y2}, {box.x1, box.y2}};
        for (std::size_t k = 0; k < 4; ++k) pieces_.push_back({{corners[k], corners[(k + 1) % 4]}, -1, false, false});
        for (std::size_t t = 0; t < traces.size(); ++t) {
            const bool loop = traces[t].front() == traces[t].back();
            for (std::size_t k = 0; k + 1 < traces[t].size(); ++k)
                pieces_.push_back({{traces[t][k], traces[t][k + 1]},
                                   static_cast<int>(t),
                                   !loop && k == 0,
                                   !loop && k + 2 == traces[t].size()});
        }
    }

    TraceGraph make() {
        if (reach_ > 0.0) join_ends();
        cut();
        number_nodes();
        return std::move(graph_);
    }

  private:
    /// Calls use(i, j) with i < j for each pair of pieces that are close to each other.
    template <class Use>
    void each_near_pair(double reach, Use use) const {
        const std::vector<Segment> segments(pieces_.begin(), pieces_.end());
        for (const auto& [i, j] : near_pairs(segments, reach)) use(i, j);
    }

    struct Join {
        // m, displacement along the piece's own line, positive outwards.
        double by = std::numeric_limits<double>::infinity();
        Point place;
        int onto = -1;
    };

    /// Updates `best` if the end of piece s can be moved along its line to piece t by a shorter distance.
    void look_for_join(const Piece& s, bool at_a, const Piece& t, Join& best) const {
        if (s.trace == t.trace) return;
        const Point end = at_a ? s.a : s.b;
        const double along_t = std::clamp(share_at(t, end), 0.0, 1.0);
        const double gap = distance(end, along(t.a, t.b, along_t));
        if (gap > reach_) return;
        const auto meet = lines_meet(s, t);
        if (!meet || meet->second < 0.0 || meet->second > 1.0) return;
        const double by = (at_a ? -meet->first : meet->first - 1.0) * distance(s.a, s.b);
        // An end must not be moved back by more than half the length of its piece.
        if (std::abs(by) > 2.0 * reach_ || by < -0.5 * distance(s.a, s.b) || std::abs(by) >= std::abs(best.by)) return;
        best = {by, on_wall(along(t.a, t.b, meet->second), t), t.trace};
    }

    /// If t is a wall, moves the point p exactly onto it.
    Point on_wall(Point p, const Piece& t) const {
        if (t.trace >= 0) return p;
        if (t.a.x == t.b.x) p.x = t.a.x;
        if (t.a.y == t.b.y) p.y = t.a.y;
        return p;
    }

    void join_ends() {
        std::vector<std::array<Join, 2>> joins(pieces_.size());
        each_near_pair(reach_, [&](std::size_t i, std::size_t j) {
            for (const auto& [own, other] : {std::pair{i, j}, {j, i}}) {
                const Piece& s = pieces_[own];
                if (s.ends_a && sides_at(s.a, box_) == 0) look_for_join(s, true, pieces_[other], joins[own][0]);
                if (s.ends_b && sides_at(s.b, box_) == 0) look_for_join(s, false, pieces_[other], joins[own][1]);
            }
        });
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            for (const bool at_a : {true, false}) {
                const Join& join = joins[k][at_a ? 0 : 1];
                if (!std::isfinite(join.by)) continue;
                (at_a ? pieces_[k].a : pieces_[k].b) = join.place;
                if (std::abs(join.by) > same_place_)
                    graph_.moved.push_back({pieces_[k].trace, at_a, join.place, join.onto, join.by});
            }
        }
    }

    void cut() {
        cuts_.resize(pieces_.size());
        for (std::size_t k = 0; k < pieces_.size(); ++k) cuts_[k] = {{0.0, pieces_[k].a}, {1.0, pieces_[k].b}};
        each_near_pair(same_place_, [&](std::size_t i, std::size_t j) { cut(i, j); });
    }

    /// Cuts piece i at the ends of piece j that lie on it. @return whether there are any such ends
    bool cut_at_ends(std::size_t i, std::size_t j) {
        bool any = false;
        const Piece& s = pieces_[i];
        const double slack = same_place_ / distance(s.a, s.b);
        for (const Point end : {pieces_[j].a, pieces_[j].b}) {
            const double share = share_at(s, end);
            if (share < -slack || share > 1.0 + slack || off_line(s, end) > same_place_) continue;
            cuts_[i].emplace_back(share, end);
            any = true;
        }
        return any;
    }

    void cut(std::size_t i, std::size_t j) {
        const bool on_first = cut_at_ends(i, j), on_second = cut_at_ends(j, i);
        if (on_first || on_second) return;  // two straight pieces meet at no other point, unless they coincide
        const auto meet = lines_meet(pieces_[i], pieces_[j]);
        if (!meet) return;
        const auto [s, t] = *meet;
        if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) return;
        // The position along the longer piece is more accurate.
        const bool first =
            pieces_[i].trace < 0 || distance(pieces_[i].a, pieces_[i].b) >= distance(pieces_[j].a, pieces_[j].b);
        const std::size_t own = first ? i : j;
        const Point place = on_wall(along(pieces_[own].a, pieces_[own].b, first ? s : t), pieces_[own]);
        cuts_[i].emplace_back(s, place);
        cuts_[j].emplace_back(t, place);
    }

    int node_at(Point p) {
        const auto index = [&](double x) { return static_cast<std::int64_t>(std::floor(x / (4.0 * same_place_))); };
        const std::int64_t i = index(p.x), j = index(p.y);
        for (std::int64_t u = i - 1; u <= i + 1; ++u) {
            for (std::int64_t v = j - 1; v <= j + 1; ++v) {
                const auto [first, last] = buckets_.equal_range(key(u, v));
                for (auto one = first; one != last; ++one) {
                    const Point q = graph_.nodes[static_cast<std::size_t>(one->second)];
                    if (distance(p, q) <= 4.0 * same_place_) return one->second;
                }
            }
        }
        graph_.nodes.push_back(p);
        const int node = static_cast<int>(graph_.nodes.size()) - 1;
        buckets_.emplace(key(i, j), node);
        return node;
    }
    static std::uint64_t key(std::int64_t i, std::int64_t j) {
        return static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(j);
    }

    /// Numbers the nodes and creates the edges. Walls come first, so that points near a wall are placed on it.
    void number_nodes() {
        std::map<std::pair<int, int>, std::size_t> edge_of;
        std::map<std::pair<int, int>, double> coincident;
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            std::stable_sort(cuts_[k].begin(), cuts_[k].end(),
                             [](const auto& p, const auto& q) { return p.first < q.first; });
            int from = node_at(cuts_[k].front().second);
            for (const auto& [share, place] : cuts_[k]) {
                const int to = node_at(place);
                if (to == from) continue;
                const auto [at, is_new] = edge_of.try_emplace(std::minmax(from, to), graph_.edges.size());
                const int trace = pieces_[k].trace;
                if (is_new)
                    graph_.edges.push_back({from, to, trace});
                else if (graph_.edges[at->second].trace != trace)
                    coincident[{graph_.edges[at->second].trace, trace}] += distance(
                        graph_.nodes[static_cast<std::size_t>(from)], graph_.nodes[static_cast<std::size_t>(to)]);
                from = to;
            }
        }
        for (const auto& [pair, length] : coincident) graph_.coincident.push_back({pair.first, pair.second, length});
    }

    Rectangle box_;
    double reach_, same_place_;
    std::vector<Piece> pieces_;
    std::vector<std::vector<std::pair<double, Point>>>
        cuts_;  // cuts of each piece: position along it (see share_at()), and coordinates
    std::unordered_multimap<std::uint64_t, int> buckets_;  // nodes by position
    TraceGraph graph_;
};

/// Follows the boundaries of the parts into which a graph divides the box, keeping each part on the left.
class PartWalk {
  public:
    explicit PartWalk(const TraceGraph& graph) : graph_(graph), around_(graph.nodes.size()) {
        for (std::size_t e = 0; e < graph.edges.size(); ++e) {
            around_[node(2 * e)].push_back(2 * e);
            around_[node(2 * e + 1)].push_back(2 * e + 1);
        }
        for (auto& leaving : around_)
            std::sort(leaving.begin(), leaving.end(),
                      [this](std::size_t a, std::size_t b) { return turns_before(a, b); });
    }

    struct Round {
        std::vector<Point> corners;
        int component;
        double area;  // m2; negative for the boundary around the outside of a component
    };
    std::vector<Round> rounds() {
        const std::vector<int> component = components();
        std::vector<char> walked(2 * graph_.edges.size());
        std::vector<Round> all;
        for (std::size_t start = 0; start < walked.size(); ++start) {
            if (walked[start] != 0) continue;
            Round round;
            round.component = component[node(start)];
            for (std::size_t h = start; walked[h] == 0; h = next(h)) {
                walked[h] = 1;
                round.corners.push_back(place(h));
            }
            round.area = polygon_area(round.corners);
            all.push_back(std::move(round));
        }
        return all;
    }

  private:
    // Half-edge 2e starts at the first node of edge e, half-edge 2e + 1 at its second node.
    std::size_t node(std::size_t half) const {
        const TraceGraph::Edge& edge = graph_.edges[half / 2];
        return static_cast<std::size_t>(half % 2 == 0 ? edge.from : edge.to);
    }
    Point place(std::size_t half) const { return graph_.nodes[node(half)]; }
    Point direction(std::size_t half) const { return place(half ^ 1U) - place(half); }
    bool turns_before(std::size_t a, std::size_t b) const {
        const Point u = direction(a), v = direction(b);
        const auto lower = [](Point d) { return d.y < 0.0 || (d.y == 0.0 && d.x < 0.0); };
        if (lower(u) != lower(v)) return lower(v);
        return cross(u, v) > 0.0;
    }
    /// Next half-edge of the boundary. Of the half-edges that start at the far node of `half`, it is the first one
    /// clockwise from the reverse of `half`.
    std::size_t next(std::size_t half) const {
        const std::vector<std::size_t>& leaving = around_[node(half ^ 1U)];
        const auto back = std::find(leaving.begin(), leaving.end(), half ^ 1U);
        return back == leaving.begin() ? leaving.back() : *(back - 1);
    }
    std::vector<int> components() const {
        std::vector<int> component(graph_.nodes.size(), -1);
        int count = 0;
        for (std::size_t n = 0; n < component.size(); ++n) {
            if (component[n] >= 0) continue;
            std::vector<std::size_t> waiting{n};
            component[n] = count;
            while (!waiting.empty()) {
                const std::size_t here = waiting.back();
                waiting.pop_back();
                for (const std::size_t half : around_[here]) {
                    const std::size_t there = node(half ^ 1U);
                    if (component[there] >= 0) continue;
                    component[there] = count;
                    waiting.push_back(there);
                }
            }
            ++count;
        }
        return component;
    }

    const TraceGraph& graph_;
    std::vector<std::vector<std::size_t>> around_;  // for each node, half-edges that start there, counter-clockwise
};

bool holds(const std::vector<Point>& corners, Point p) {
    bool inside = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Point a = corners[k], b = corners[k + 1 == corners.size() ? 0 : k + 1];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        const double turn = cross(b - a, p - a);
        if ((b.y > a.y) == (turn > 0.0)) inside = !inside;
    }
    return inside;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> near_pairs(std::span<const Segment> segments, double reach) {
    struct Extent {
        double low, high;
    };
    const auto extents_along = [&](Point axis) {
        std::vector<Extent> extents;
        extents.reserve(segments.size());
        for (const Segment& s : segments) {
            const double from = dot(s.a, axis), to = dot(s.b, axis);
            extents.push_back({std::min(from, to), std::max(from, to)});
        }
        return extents;
    };
    const auto sum_of = [](const std::vector<Extent>& extents) {
        return std::accumulate(extents.begin(), extents.end(), 0.0,
                               [](double sum, Extent e) { return sum + e.high - e.low; });
    };
    const auto order_of = [](const std::vector<Extent>& extents) {
        std::vector<std::uint32_t> order(extents.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t i, std::uint32_t j) { return extents[i].low < extents[j].low; });
        return order;
    };
    const std::vector<Extent> by_x = extents_along({1.0, 0.0}), by_y = extents_along({0.0, 1.0});
    const std::vector<std::uint32_t> from_left = order_of(by_x);
    std::vector<std::uint32_t> place(segments.size());
    for (std::uint32_t k = 0; k < from_left.size(); ++k) place[from_left[k]] = k;

    const double room = 1.001 * reach;  // includes a margin, so that round-off excludes no pair
    const std::vector<Extent> oblique = extents_along(across_most(segments));
    const std::vector<Extent>& swept = sum_of(oblique) < sum_of(by_x) ? oblique : by_x;
    const std::vector<std::uint32_t> order = order_of(swept);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_places;  // pairs of segments, by their ranks from the left
    const auto apart = [room](Extent s, Extent t) { return s.high + room < t.low || t.high + room < s.low; };
    for (std::size_t a = 0; a < order.size(); ++a) {
        const std::uint32_t i = order[a];
        for (std::size_t b = a + 1; b < order.size() && swept[order[b]].low <= swept[i].high + room; ++b) {
            const std::uint32_t j = order[b];
            if (apart(by_x[i], by_x[j]) || apart(by_y[i], by_y[j]) || lie_apart(segments[i], segments[j], room))
                continue;
            if (by_places.size() == most_pairs)
                throw MeshError(
                    fmt::format("found more than {} places where traces meet or come within {:.3g} m of each other, "
                                "expected fewer; reduce the number of traces",
                                most_pairs, reach));
            by_places.emplace_back(std::minmax(place[i], place[j]));
        }
    }
    std::sort(by_places.begin(), by_places.end());
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    pairs.reserve(by_places.size());
    for (const auto& [first, second] : by_places) pairs.emplace_back(std::minmax(from_left[first], from_left[second]));
    return pairs;
}

TraceGraph trace_graph(const Rectangle& box, std::span<const std::vector<Point>> traces, double reach) {
    return GraphMaker(box, traces, reach).make();
}

std::vector<double> parted_areas(const TraceGraph& graph) {
    const std::vector<PartWalk::Round> rounds = PartWalk(graph).rounds();
    double whole = 0.0;
    for (const auto& round : rounds) whole = std::max(whole, round.area);
    // A boundary with at most this area encloses nothing: it follows a tree of traces back and forth.
    const double none = 1e-12 * whole;
    std::vector<double> areas;
    std::vector<std::size_t> parts;
    for (std::size_t k = 0; k < rounds.size(); ++k) {
        if (rounds[k].area <= none) continue;
        parts.push_back(k);
        areas.push_back(rounds[k].area);
    }
    // The area of a part excludes components of the graph that lie inside it (islands). The walls are the first
    // component and lie inside no part.
    for (const auto& island : rounds) {
        if (island.area >= -none || island.component == 0) continue;
        std::size_t within = parts.size();
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const auto& part = rounds[parts[p]];
            if (part.component == island.component || !holds(part.corners, island.corners.front())) continue;
            if (within == parts.size() || part.area < rounds[parts[within]].area) within = p;
        }
        if (within < parts.size()) areas[within] += island.area;
    }
    return areas;
}

}  // namespace crackle
