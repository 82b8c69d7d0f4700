// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/geometry/flat_faces.hpp"

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {
namespace {

/// Circles within this distance from a trace, in diameters of the largest circle, are assigned to one of its sides. A
/// circle that reaches the trace later from farther away has no flat face there.
constexpr double depth_in_diameters = 2.0;

/// Largest distance of a face's end from the circle's centre, in radii of the circle. Neighbouring circles along a
/// trace are closer together. If the circles end before the trace does, as in a wedge at the edge of the specimen, the
/// last circle's face ends at this distance.
constexpr double farthest_reach = 3.0;

/// A circle with fewer neighbours than this on its side could roll between the two sides. It is moved to the other side
/// if it has enough neighbours there. Circles are neighbours if their gap is less than neighbour_gap times their mean
/// radius.
constexpr int fewest_neighbours = 2;
constexpr double neighbour_gap = 0.3;
/// Largest number of rounds in which circles change sides. After a round, other circles may have too few neighbours.
constexpr int most_rounds = 4;

struct StraightPart {
    Vec2 begin, along;  // m; unit vector
    double length;      // m

    explicit StraightPart(const TracePiece& piece)
        : begin(piece.from), along(piece.to - piece.from), length(norm(along)) {
        along = (1.0 / length) * along;
    }
    double foot(Vec2 p) const { return dot(p - begin, along); }
    double height(Vec2 p) const { return cross(along, p - begin); }  // m, height above the line; positive on the left
};

/// A circle near a straight part of a trace.
struct Neighbour {
    BodyIndex body;
    bool right;
    CircleAtTrace circle;
    bool held = true;
};

/// Assigns circles to the straight parts of traces that they face. A circle on the outer side of a bend that faces
/// neither part directly is assigned to both.
class PartsOfTraces {
  public:
    /// @param depth largest distance of circles beyond an end of a trace that lies outside the specimen, m
    PartsOfTraces(std::span<const TracePiece> pieces, double depth) : pieces_(pieces), depth_(depth) {
        for (const TracePiece& piece : pieces) parts_.emplace_back(piece);
    }
    const StraightPart& operator[](std::size_t k) const { return parts_[k]; }

    bool has_in_front(std::size_t k, Vec2 centre, double radius) const {
        const double foot = parts_[k].foot(centre), beyond = foot - parts_[k].length;
        if (foot >= 0.0 && beyond <= 0.0) return true;
        if (foot < 0.0) {
            if (pieces_[k].from_outside) return foot >= -depth_;
            return foot >= -radius && k > 0 && follows(k) && alike(k, k - 1, centre);
        }
        if (pieces_[k].to_outside) return beyond <= depth_;
        return beyond <= radius && k + 1 < parts_.size() && follows(k + 1) && alike(k, k + 1, centre);
    }

  private:
    bool follows(std::size_t k) const {
        return pieces_[k].trace == pieces_[k - 1].trace && pieces_[k].from == pieces_[k - 1].to;
    }
    bool alike(std::size_t a, std::size_t b, Vec2 centre) const {
        return (parts_[a].height(centre) < 0.0) == (parts_[b].height(centre) < 0.0);
    }

    std::span<const TracePiece> pieces_;
    double depth_;
    std::vector<StraightPart> parts_;
};

std::vector<Neighbour> neighbours_of(const World& world, const PartsOfTraces& parts, std::size_t k, double depth) {
    std::vector<Neighbour> found;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        if (world.bodies.names[b].shape != no_shape) continue;
        const BodyState& body = world.bodies.state[b];
        const Vec2 centre{body.x, body.y};
        const double height = parts[k].height(centre), radius = body.shape[0];
        if (std::abs(height) > depth || !parts.has_in_front(k, centre, radius)) continue;
        found.push_back({b, height < 0.0, {parts[k].foot(centre), std::abs(height), radius}, true});
    }
    return found;
}

/// Pairs of neighbouring circles along a straight part of a trace, as indices into `all`.
std::vector<std::pair<std::size_t, std::size_t>> adjacent(const std::vector<Neighbour>& all) {
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(all[k].circle.foot, k); });
    double largest = 0.0;
    for (const Neighbour& one : all) largest = std::max(largest, one.circle.radius);
    const double farthest = (2.0 + neighbour_gap) * largest;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t n = 0; n < order.size(); ++n) {
        const CircleAtTrace& a = all[order[n]].circle;
        for (std::size_t m = n + 1; m < order.size(); ++m) {
            const CircleAtTrace& b = all[order[m]].circle;
            if (b.foot - a.foot > farthest) break;
            const double above_a = all[order[n]].right ? -a.distance : a.distance,
                         above_b = all[order[m]].right ? -b.distance : b.distance;
            if (norm({a.foot - b.foot, above_a - above_b}) <= (1.0 + 0.5 * neighbour_gap) * (a.radius + b.radius))
                pairs.emplace_back(order[n], order[m]);
        }
    }
    return pairs;
}

/// Moves circles with too few neighbours to the other side of the trace; their `distance` then becomes negative. Sets
/// `held` for circles with enough neighbours.
void take_sides(std::vector<Neighbour>& all) {
    const auto pairs = adjacent(all);
    std::vector<bool> gone_over(all.size(), false);
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<int> own(all.size(), 0), others(all.size(), 0);
        for (const auto& [a, b] : pairs) {
            auto& counts = all[a].right == all[b].right ? own : others;
            ++counts[a];
            ++counts[b];
        }
        bool changed = false;
        for (std::size_t k = 0; k < all.size(); ++k) {
            all[k].held = own[k] >= fewest_neighbours;
            if (gone_over[k] || all[k].held || others[k] < fewest_neighbours) continue;
            gone_over[k] = changed = true;
            all[k].right = !all[k].right;
            all[k].circle.distance = -all[k].circle.distance;
        }
        if (!changed) break;
    }
}

}  // namespace

std::vector<std::optional<TraceShare>> share_trace(std::span<const CircleAtTrace> circles, double length) {
    // |p - x|² - r² of each circle is p² plus a linear function of p, so the minimum over the circles is a lower
    // envelope of lines.
    const auto at_begin = [&](std::size_t k) {
        const CircleAtTrace& c = circles[k];
        return c.foot * c.foot + c.distance * c.distance - c.radius * c.radius;
    };
    const auto meet = [&](std::size_t before, std::size_t after) {
        return 0.5 * (at_begin(after) - at_begin(before)) / (circles[after].foot - circles[before].foot);
    };
    std::vector<std::size_t> order(circles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(circles[k].foot, at_begin(k)); });
    struct Part {
        std::size_t circle;
        double from;
    };
    std::vector<Part> envelope;
    for (const std::size_t k : order) {
        if (!envelope.empty() && circles[envelope.back().circle].foot == circles[k].foot) continue;
        double from = 0.0;
        while (!envelope.empty() && (from = meet(envelope.back().circle, k)) <= envelope.back().from)
            envelope.pop_back();
        if (envelope.empty()) from = 0.0;
        if (from < length) envelope.push_back({k, from});
    }
    std::vector<std::optional<TraceShare>> shares(circles.size());
    for (std::size_t n = 0; n < envelope.size(); ++n)
        shares[envelope[n].circle] = {envelope[n].from, n + 1 < envelope.size() ? envelope[n + 1].from : length};
    return shares;
}

void lay_flat_faces(World& world, std::span<const TracePiece> pieces) {
    Bodies& bodies = world.bodies;
    double largest = 0.0;
    for (BodyIndex b = 0; b < bodies.size(); ++b)
        if (bodies.names[b].shape == no_shape) largest = std::max(largest, bodies.state[b].shape[0]);
    const double depth = depth_in_diameters * 2.0 * largest;
    const PartsOfTraces parts(pieces, depth);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        // A trace that behaves like the rock needs no faces.
        if (world.settings.trace_joints[static_cast<std::size_t>(pieces[k].trace)] < 0) continue;
        std::vector<Neighbour> all = neighbours_of(world, parts, k, depth);
        take_sides(all);
        for (const bool right : {false, true}) {
            std::vector<CircleAtTrace> circles;
            for (const Neighbour& one : all)
                if (one.held && one.right == right) circles.push_back(one.circle);
            const auto shares = share_trace(circles, parts[k].length);
            auto share = shares.begin();
            for (const Neighbour& one : all) {
                if (one.right != right) continue;
                const CircleAtTrace& c = one.circle;
                FlatFace face{one.body,
                              static_cast<std::uint32_t>(k),
                              2 * pieces[k].trace + (right ? 1 : 0),
                              -c.radius,
                              c.radius,
                              std::min(c.radius, c.distance),
                              parts[k].along.x,
                              parts[k].along.y};
                const std::optional<TraceShare> own = one.held ? *share++ : std::nullopt;
                if (own) {
                    const double reach = farthest_reach * c.radius;
                    face.from = std::clamp(own->from - c.foot, -reach, reach);
                    face.to = std::clamp(own->to - c.foot, -reach, reach);
                    face.height = c.distance;
                } else if (!one.held) {
                    face.from = face.to = 0.0;
                } else if (c.foot < 0.0) {  // the circle's centre lies beyond an end of the straight part
                    face.to = -c.foot;
                } else if (c.foot > parts[k].length) {
                    face.from = parts[k].length - c.foot;
                }
                bodies.flat_faces.push_back(face);
            }
        }
    }
    if (bodies.flat_faces.empty()) return;
    std::ranges::sort(bodies.flat_faces, {}, [](const FlatFace& face) { return std::pair(face.body, face.piece); });
    bodies.flat_faces.shrink_to_fit();
    bodies.first_flat_face.assign(bodies.size() + 1, 0);
    for (const FlatFace& face : bodies.flat_faces) ++bodies.first_flat_face[face.body + 1];
    std::partial_sum(bodies.first_flat_face.begin(), bodies.first_flat_face.end(), bodies.first_flat_face.begin());
}

}  // namespace crackle
