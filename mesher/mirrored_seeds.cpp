// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mirrored_seeds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mesher/place_grid.hpp"

namespace crackle {

double angle_of(double x, double y) {
    const bool steep = std::abs(y) > std::abs(x);
    double t = steep ? std::abs(x / y) : std::abs(y / x);  // at most 1
    for (int halving = 0; halving < 3; ++halving) t /= 1.0 + std::sqrt(1.0 + t * t);
    double sum = 0.0;
    for (int k = 10; k >= 0; --k) sum = 1.0 / (2 * k + 1) - t * t * sum;
    double angle = 8.0 * t * sum;
    if (steep) angle = 0.5 * std::numbers::pi - angle;
    if (x < 0.0) angle = std::numbers::pi - angle;
    return y < 0.0 ? -angle : angle;
}

Point direction_at(double angle) {
    const double part = angle / 64.0, square = part * part;
    double sine = 0.0, lack = 0.0;  // lack is 1 - cosine, stored in this form to keep all digits
    double term = part;
    for (int k = 1; k <= 15; k += 2) {
        sine += term;
        term *= -square / ((k + 1) * (k + 2));
    }
    term = 0.5 * square;
    for (int k = 2; k <= 16; k += 2) {
        lack += term;
        term *= -square / ((k + 1) * (k + 2));
    }
    for (int doubling = 0; doubling < 6; ++doubling) {
        const double twice = 2.0 * sine * (1.0 - lack);
        lack = 2.0 * sine * sine;
        sine = twice;
    }
    return {1.0 - lack, sine};
}

namespace {

constexpr double pi = std::numbers::pi;
// Half the distance between the seeds of a pair, and the distance from other seeds above which a given centre is kept,
// both relative to the spacing.
constexpr double half_width_share = 0.5, kept_share = 0.55;
// Rows are not made narrower than this fraction of the full width. If rows of this width do not cover the trace, the
// trace is refused.
constexpr double narrowest_strip_share = 0.1;
// Largest half-width of a row, relative to the distance from another edge. passage_share: between two traces there are
// two rows of width d, and circles of radius √2 d around points on the traces must not reach the other trace's seeds.
// fork_share: where two traces meet at a node, the angles of the ring around the node determine the positions of the
// seeds. wall_share: at a wall, the row is its own mirror image.
constexpr double passage_share = 0.4, fork_share = 0.5, wall_share = 0.7;
// Largest angle between a seed on the ring around a node and the nearest edge of the graph (arm) at the node. With this
// angle, the end of a trace has three seeds.
constexpr double widest_half_angle = pi / 3.0;
// These distances are relative to the spacing. If no other edge is closer than clear_share, the packing's own seeds on
// one side are mirrored. The mirrored seeds are at least least_offset_share from the trace, and no point on the trace
// is farther than bare_share from the nearest seed.
constexpr double clear_share = 2.0, least_offset_share = 0.3, bare_share = 0.95;
constexpr double shortest_own_share =
    2.0;  // shortest part of an edge along which the packing's own seeds are used, relative to the spacing
// Distance between the points along an edge at which nearby edges are searched for, relative to the spacing.
constexpr double beside_step_share = 1.0;

struct Arm {
    double angle;  // rad, direction away from the node
    int edge;      // index of the edge in the graph
    bool trace;
};

/// Directions of seeds on a ring around a node. Each edge at the node (arm) has a seed on either side, at the same
/// angle for all arms.
struct Ring {
    double half_angle = 0.0;     // angle between a seed and an arm, rad
    std::vector<double> angles;  // rad, directions of all seeds
};

/// Number of equal gaps between the seeds inside a sector. @param rest angle between the seeds next to the sector's two
/// arms, rad
int gaps_of(double rest, double half_angle) {
    return std::max(1, static_cast<int>(std::lround(rest / std::max(2.0 * half_angle, pi / 3.0))));
}
double smallest_gap(const std::vector<double>& sectors, double half_angle) {
    double least = 2.0 * half_angle;
    for (const double sector : sectors) {
        const double rest = sector - 2.0 * half_angle;
        if (rest < -1e-9) return -1.0;
        if (rest > 1e-9) least = std::min(least, rest / gaps_of(rest, half_angle));
    }
    return least;
}

class SeedPlacing {
  public:
    SeedPlacing(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph, double spacing,
                std::span<const double> shrink)
        : centres_(centres),
          domain_(domain),
          graph_(graph),
          spacing_(spacing),
          shrink_(shrink),
          edges_(segments_of(graph), (clear_share + 0.5 * beside_step_share) * spacing),
          seen_from_(graph.edges.size(), graph.edges.size()),
          arms_(graph.nodes.size()) {
        for (std::size_t e = 0; e < graph.edges.size(); ++e) {
            add_arm(graph.edges[e].from, graph.edges[e].to, e);
            add_arm(graph.edges[e].to, graph.edges[e].from, e);
        }
    }

    SeedSet make() {
        for (std::size_t n = 0; n < arms_.size(); ++n) place_ring(n);
        std::vector<OwnStretch> own;
        for (std::size_t e = 0; e < graph_.edges.size(); ++e)
            if (graph_.edges[e].trace >= 0) place_rows(e, own);
        mirror_own(own);
        return with_centres();
    }

  private:
    struct NodeRing {
        double radius = 0.0, half_angle = 0.0;
    };

    static std::vector<Segment> segments_of(const TraceGraph& graph) {
        std::vector<Segment> segments;
        segments.reserve(graph.edges.size());
        for (const TraceGraph::Edge& edge : graph.edges)
            segments.push_back(
                {graph.nodes[static_cast<std::size_t>(edge.from)], graph.nodes[static_cast<std::size_t>(edge.to)]});
        return segments;
    }
    Point node(int n) const { return graph_.nodes[static_cast<std::size_t>(n)]; }
    void add_arm(int at, int to, std::size_t edge) {
        const Point a = node(at), b = node(to);
        arms_[static_cast<std::size_t>(at)].push_back(
            {angle_of(b.x - a.x, b.y - a.y), static_cast<int>(edge), graph_.edges[edge].trace >= 0});
    }

    static Point from(Point at, double radius, double angle) {
        const Point direction = direction_at(angle);
        return {at.x + radius * direction.x, at.y + radius * direction.y};
    }
    bool inside(Point p) const { return p.x > domain_.x1 && p.x < domain_.x2 && p.y > domain_.y1 && p.y < domain_.y2; }

    /// An edge of the graph as a straight line, with coordinates along it and perpendicular to it.
    struct Line {
        Point start, along;
        double length;
        Point at(double s, double off = 0.0) const {
            return {start.x + s * along.x - off * along.y, start.y + s * along.y + off * along.x};
        }
        /// Coordinates of a point: along the line, and perpendicular to it (positive to the left).
        Point seen(Point p) const {
            const Point d{p.x - start.x, p.y - start.y};
            return {d.x * along.x + d.y * along.y, d.y * along.x - d.x * along.y};
        }
    };
    Line line_of(std::size_t e) const {
        const Point a = node(graph_.edges[e].from), b = node(graph_.edges[e].to);
        const double length = distance(a, b);
        return {a, {(b.x - a.x) / length, (b.y - a.y) / length}, length};
    }

    /// A range of positions along a line; empty if from > to.
    struct Stretch {
        double from = std::numeric_limits<double>::infinity(), to = -from;
        bool holds(double s) const { return s >= from && s <= to; }
    };
    /// Part of a line that may be within `reach` of a segment.
    static Stretch stretch_within(const Line& line, const Segment& segment, double reach) {
        const double room = 1.001 * reach;  // includes a margin for round-off
        const Point a = line.seen(segment.a), b = line.seen(segment.b);
        if (std::min(a.y, b.y) > room || std::max(a.y, b.y) < -room) return {};
        const auto at_height = [&](Point end, Point other) {
            const double height = std::clamp(end.y, -room, room);
            return height == end.y ? end.x : end.x + (height - end.y) / (other.y - end.y) * (other.x - end.x);
        };
        const auto [from, to] = std::minmax({at_height(a, b), at_height(b, a)});
        return {from - room, to + room};
    }

    /// Another edge near a given edge, and the largest half-width of a row relative to the distance from this other
    /// edge.
    struct Beside {
        Segment segment;
        double share;
        // Ranges in which the other edge may be closer than clear_share, and in which it may limit the row's width.
        Stretch near, narrow;
    };
    /// All edges closer than clear_share to an edge, except the edge itself and edges that continue it in a straight
    /// line.
    std::vector<Beside> edges_beside(std::size_t edge, const Line& line) {
        std::vector<Beside> beside;
        const auto look_at = [&](std::size_t other) {
            if (seen_from_[other] == edge) return;
            seen_from_[other] = edge;
            if (other == edge || goes_on(edge, other)) return;
            const Segment& segment = edges_.segments()[other];
            const Stretch near = stretch_within(line, segment, clear_share * spacing_);
            if (near.from > line.length || near.to < 0.0) return;
            const double share = graph_.edges[other].trace < 0 ? wall_share
                                 : meet(edge, other)           ? fork_share
                                                               : passage_share;
            beside.push_back({segment, share, near, stretch_within(line, segment, full_half_width(edge) / share)});
        };
        const double step = beside_step_share * spacing_;
        Point last{};
        for (double s = 0.0; s < line.length + step; s += step) {
            const Point at = line.at(std::min(s, line.length));
            if (s == 0.0 || !edges_.same_near(last, at)) edges_.each_near(at, look_at);
            last = at;
        }
        return beside;
    }
    double full_half_width(std::size_t edge) const { return half_width_share * spacing_ * shrink_[edge]; }
    /// Half the width of a row at position s.
    double half_width(std::size_t edge, const std::vector<Beside>& beside, const Line& line, double s) const {
        double least = full_half_width(edge);
        for (const Beside& other : beside)
            if (other.narrow.holds(s)) least = std::min(least, other.share * distance_to(other.segment, line.at(s)));
        return std::max(least, narrowest_strip_share * half_width_share * spacing_);
    }
    bool meet(std::size_t edge, std::size_t other) const {
        const TraceGraph::Edge &s = graph_.edges[edge], &t = graph_.edges[other];
        return s.from == t.from || s.from == t.to || s.to == t.from || s.to == t.to;
    }
    bool goes_on(std::size_t edge, std::size_t other) const {
        const TraceGraph::Edge &s = graph_.edges[edge], &t = graph_.edges[other];
        if (s.trace != t.trace) return false;
        const Point a = node(s.from), b = node(s.to), c = node(t.from), d = node(t.to);
        const double turn = (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
        return std::abs(turn) <= 1e-9 * distance(a, b) * distance(c, d);
    }

    void place_ring(std::size_t n) {
        std::vector<Arm>& arms = arms_[n];
        rings_.resize(arms_.size());
        if (std::none_of(arms.begin(), arms.end(), [](const Arm& arm) { return arm.trace; })) return;
        std::sort(arms.begin(), arms.end(), [](const Arm& a, const Arm& b) { return a.angle < b.angle; });
        const Point at = graph_.nodes[n];
        std::vector<double> sectors;
        std::vector<char> within;  // for each seed, whether it lies inside the domain
        double shortest = std::numeric_limits<double>::infinity(), factor = 1.0;
        for (std::size_t k = 0; k < arms.size(); ++k) {
            const double next = k + 1 < arms.size() ? arms[k + 1].angle : arms[0].angle + 2.0 * pi;
            const double middle = 0.5 * (arms[k].angle + next), step = 1e-6 * spacing_;
            sectors.push_back(next - arms[k].angle);
            within.push_back(inside(from(at, step, middle)) ? 1 : 0);
            const Segment& arm = edges_.segments()[static_cast<std::size_t>(arms[k].edge)];
            shortest = std::min(shortest, distance(arm.a, arm.b));
            factor = std::min(factor, shrink_[static_cast<std::size_t>(arms[k].edge)]);
        }
        std::vector<double> inner;
        for (std::size_t k = 0; k < sectors.size(); ++k)
            if (within[k] != 0) inner.push_back(sectors[k]);
        double best = -1.0, half_angle = 0.0;
        for (const double sector : inner) {
            for (const double candidate : {0.5 * sector, 0.25 * sector, widest_half_angle}) {
                const double gap = smallest_gap(inner, std::min(candidate, widest_half_angle));
                if (gap <= best) continue;
                best = gap;
                half_angle = std::min(candidate, widest_half_angle);
            }
        }
        // The radius matches the width of a row, but is at most one spacing and less than half the length of any arm.
        const double sine = direction_at(half_angle).y;
        double radius = std::min({half_width_share * spacing_ * factor / sine, spacing_ * factor, 0.4 * shortest});
        radius = std::min(radius, 0.5 * room_about(n));
        rings_[n] = {radius, half_angle};
        for (std::size_t k = 0; k < sectors.size(); ++k) {
            if (within[k] == 0) continue;
            const double rest = sectors[k] - 2.0 * half_angle;
            const int gaps = rest > 1e-9 ? gaps_of(rest, half_angle) : 0;
            for (int g = 0; g <= gaps; ++g) {
                const double angle =
                    gaps == 0 ? arms[k].angle + 0.5 * sectors[k] : arms[k].angle + half_angle + rest * g / gaps;
                add(from(at, radius, angle));
            }
        }
    }

    /// Distance between a node and the nearest edge that does not end at it.
    double room_about(std::size_t n) const {
        double least = 2.0 * spacing_;
        edges_.each_near(graph_.nodes[n], [&](std::size_t e) {
            const TraceGraph::Edge& edge = graph_.edges[e];
            if (static_cast<std::size_t>(edge.from) == n || static_cast<std::size_t>(edge.to) == n) return;
            least = std::min(least, distance_to(edges_.segments()[e], graph_.nodes[n]));
        });
        return least;
    }

    /// Part of an edge along which the packing's own seeds are mirrored.
    struct OwnStretch {
        std::size_t edge;
        Line line;
        double from, to;
    };

    /// Places evenly spaced rows between the rings at both ends of an edge, in the parts of the edge with other edges
    /// nearby.
    void place_rows(std::size_t e, std::vector<OwnStretch>& own) {
        const TraceGraph::Edge& edge = graph_.edges[e];
        const NodeRing &first = rings_[static_cast<std::size_t>(edge.from)],
                       &last = rings_[static_cast<std::size_t>(edge.to)];
        const Line line = line_of(e);
        const std::vector<Beside> beside = edges_beside(e, line);
        double from = first.radius * direction_at(first.half_angle).x;
        const double to = line.length - last.radius * direction_at(last.half_angle).x;
        const double step = 0.1 * spacing_;
        double begin = -1.0;
        const auto steps = static_cast<std::size_t>(std::ceil(std::max(1.0, (to - from) / step)));
        const double start = from;
        for (std::size_t k = 0; k <= steps; ++k) {
            const double s = k == steps ? to : start + static_cast<double>(k) * step;
            const bool clear = is_clear(e, beside, line, s);
            if (clear && begin < 0.0) begin = s;
            if (begin < 0.0 || (clear && k < steps)) continue;
            if (s - begin >= shortest_own_share * spacing_) {
                own.push_back({e, line, begin, s});
                if (begin > from) {
                    place_even(e, line, beside, from, begin);
                    place_pair(line, begin, half_width(e, beside, line, begin));
                }
                if (s < to) place_pair(line, s, half_width(e, beside, line, s));
                from = s;
            }
            begin = -1.0;
        }
        if (from < to) place_even(e, line, beside, from, to);
    }
    /// Whether no other edge is near position s, apart from edges that continue this edge in a straight line.
    bool is_clear(std::size_t edge, const std::vector<Beside>& beside, const Line& line, double s) const {
        return shrink_[edge] >= 1.0 && std::ranges::none_of(beside, [&](const Beside& other) {
                   return other.near.holds(s) && distance_to(other.segment, line.at(s)) < clear_share * spacing_;
               });
    }

    void place_even(std::size_t e, const Line& line, const std::vector<Beside>& beside, double from, double to) {
        // Integrates 1/width in steps of a twentieth of the spacing. The integral is scaled to end on an integer, and a
        // pair is placed wherever it reaches an integer.
        const auto steps = static_cast<std::size_t>(std::ceil(std::max(1.0, 20.0 * (to - from) / spacing_)));
        std::vector<double> count{0.0};
        const double step = (to - from) / static_cast<double>(steps);
        for (std::size_t k = 0; k < steps; ++k)
            count.push_back(count.back() +
                            step / (2.0 * half_width(e, beside, line, from + (static_cast<double>(k) + 0.5) * step)));
        const auto pairs = std::max(1L, std::lround(count.back()));  // number of gaps between the pairs
        std::size_t k = 0;
        for (long pair = 1; pair < pairs; ++pair) {
            const double wanted = count.back() * static_cast<double>(pair) / static_cast<double>(pairs);
            while (k + 1 < steps && count[k + 1] < wanted) ++k;
            const double s = from + step * (static_cast<double>(k) + (wanted - count[k]) / (count[k + 1] - count[k]));
            place_pair(line, s, half_width(e, beside, line, s));
        }
    }
    void place_pair(const Line& line, double s, double off) {
        add(line.at(s, off));
        add(line.at(s, -off));
    }

    /// Mirrors the seeds on the left of each range. Seeds too close to the line are moved away from it, and pairs are
    /// added where seeds are missing. As a result, the two seeds nearest to any point on the line are always mirror
    /// images of each other.
    void mirror_own(const std::vector<OwnStretch>& own) {
        if (own.empty()) return;
        std::vector<Segment> stretches;
        stretches.reserve(own.size());
        for (const auto& [edge, line, from, to] : own) stretches.push_back({line.at(from), line.at(to)});
        const double widest = (half_width_share + kept_share) * spacing_;
        const SegmentGrid near_own(std::move(stretches), 1.001 * widest);
        struct Candidate {
            double s, off;
        };
        std::vector<std::vector<Candidate>> candidates(own.size());
        for (const CellCentre& centre : centres_) {
            near_own.each_near(centre, [&](std::size_t k) {
                const auto [s, off] = own[k].line.seen(centre);
                if (s > own[k].from && s < own[k].to && off > 0.0 && off < widest) candidates[k].push_back({s, off});
            });
        }
        PlaceGrid placed(spacing_);
        placed.reserve(added_.size() + centres_.size());
        for (const Point p : added_) placed.add(p);
        const auto place = [&](const Line& line, double s, double off) {
            if (placed.any_within(line.at(s, off), kept_share * spacing_)) return;
            place_pair(line, s, off);
            placed.add(line.at(s, off));
            placed.add(line.at(s, -off));
        };
        const double least = least_offset_share * spacing_;
        for (std::size_t k = 0; k < own.size(); ++k) {
            const Line& line = own[k].line;
            for (const Candidate& c : candidates[k])
                if (c.off >= least) place(line, c.s, c.off);
            for (const Candidate& c : candidates[k])
                if (c.off < least) place(line, c.s, least);
            for (double s = own[k].from; s < own[k].to; s += 0.1 * spacing_)
                if (!placed.any_within(line.at(s), bare_share * spacing_)) place(line, s, half_width_share * spacing_);
        }
    }

    void add(Point p) {
        if (inside(p)) added_.push_back(p);
    }

    SeedSet with_centres() const {
        SeedSet set;
        const double room = kept_share * spacing_;
        PlaceGrid seeds(spacing_), given(spacing_);
        seeds.reserve(added_.size());
        given.reserve(centres_.size());
        set.places.reserve(centres_.size() + added_.size());
        for (const Point p : added_) seeds.add(p);
        for (const CellCentre& centre : centres_) given.add(centre);
        for (std::size_t k = 0; k < centres_.size(); ++k) {
            const bool in_row = edges_.any_near(centres_[k], [&](std::size_t e) {
                if (graph_.edges[e].trace < 0) return false;
                const double least = full_half_width(e) + room;
                const Segment& s = edges_.segments()[e];
                return !surely_beyond(s, centres_[k], least) && distance_to(s, centres_[k]) < least;
            });
            if (in_row || seeds.any_within(centres_[k], room)) {
                ++set.left_out;
                continue;
            }
            set.places.push_back(centres_[k]);
            set.centre.push_back(static_cast<int>(k));
            set.added.push_back(0);
        }
        for (const Point p : added_) {
            set.places.push_back(p);
            set.centre.push_back(given.nearest(p));
            set.added.push_back(1);
        }
        return set;
    }

    std::span<const CellCentre> centres_;
    Rectangle domain_;
    const TraceGraph& graph_;
    double spacing_;
    std::span<const double> shrink_;
    SegmentGrid edges_;
    std::vector<std::size_t> seen_from_;  // for each edge, index of the edge whose search last visited it
    std::vector<std::vector<Arm>> arms_;  // arms of each node
    std::vector<NodeRing> rings_;
    std::vector<Point> added_;
};

}  // namespace

SeedSet mirrored_seeds(std::span<const CellCentre> centres, const Rectangle& domain, const TraceGraph& graph,
                       double spacing, std::span<const double> shrink) {
    return SeedPlacing(centres, domain, graph, spacing, shrink).make();
}

}  // namespace crackle
