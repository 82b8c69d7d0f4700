// SPDX-License-Identifier: GPL-3.0-or-later
// Neighbour list: every contact point that could close before something has moved half the skin.
//
// Bodies lie in a uniform grid by their centroids. A pair is found by its larger body, which searches its own bounding
// box widened by the reach of the next smaller body: any mixture of sizes, platens and containers included, needs no
// user hint. In a bonded world the skin is as narrow as the motion allows, so that points which nothing brings together
// cost nothing: a mesh has many corners that face each other over a gap. A body that is fast beyond that has a wider
// skin of its own: a few fragments in flight, or a flow, would have the list rebuilt every few steps. Pairs are sorted,
// their points emitted in that order, and what a point remembers (shear spring, bond, flags) is carried over by one
// linear merge of the old list with the new one. Everything depends on positions and steps alone, never on the number
// of threads.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/contact/geometry.hpp"
#include "solver/contact/pass.hpp"
#include "solver/neighbours/pierced.hpp"
#include "solver/world/point_order.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

/// Steps that a list of a bonded world is to last. Building it, with the bound on the step, costs what some 30 steps
/// do: at 200 that was 8 % of a test of 300 discs. Longer, polygons list corners that nothing brings together.
constexpr double list_lasts = 1000.0;
/// Steps between two looks whether a narrower skin would do.
constexpr std::int64_t look_interval = 64;
constexpr double narrowest_share = 0.01;  // of the widest skin
// A body that moves by p reaches a step and has a half skin of h reaches lasts h/p steps and lists about as many
// points more by the share of h (discs in a dense packing: 0.8 to 1 of those that touch a reach). With a rebuild worth
// R steps the sum h + R p/h is least at h = √(R p).
constexpr double rebuild_steps = 45.0;
constexpr double widest_own = 0.5;  // of the median reach: half skins of fast bodies

struct Box {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    void add(Vec2 p, double margin) {
        low = {std::min(low.x, p.x - margin), std::min(low.y, p.y - margin)};
        high = {std::max(high.x, p.x + margin), std::max(high.y, p.y + margin)};
    }
};

/// How far the surfaces of a listed pair may be apart beyond what they touch at, m.
double skin_between(const World& world, BodyIndex i, BodyIndex j) { return world.half_skins[i] + world.half_skins[j]; }

Vec2 centre_of(const BodyState& body) { return {body.x, body.y}; }

Box bounding_box(const World& world, std::size_t b) {
    const BodyState& body = world.bodies[b];
    const BodyInfo& info = world.info[b];
    Box box;
    for (std::uint32_t e = 0; e < info.element_count; ++e) {
        const Element& element = world.elements[info.first_element + e];
        box.add(centre_of(body) + turned(body, element), info.piece_count > 0 ? 0.0 : element.radius);
    }
    return box;
}

/// Uniform grid over the centroids: body numbers sorted by cell.
class Grid {
  public:
    explicit Grid(const World& world) {
        Box box;
        double mean_reach = 0.0;
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            box.add(centre_of(world.bodies[b]), 0.0);
            mean_reach += world.info[b].reach;
        }
        const auto n = static_cast<double>(world.bodies.size());
        low_ = box.low;
        const double width = box.high.x - box.low.x, height = box.high.y - box.low.y;
        // Cells of about a body; larger where few bodies are spread over a wide area, so that memory stays linear.
        size_ = std::max({2.0 * mean_reach / n, std::sqrt(width * height / (2.0 * n + 64.0)),
                          std::max(width, height) / (2.0 * n + 64.0)});
        columns_ = static_cast<std::int64_t>(width / size_) + 1;
        rows_ = static_cast<std::int64_t>(height / size_) + 1;
        begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        members_.resize(world.bodies.size());
        for (const BodyState& body : world.bodies) ++begin_[cell_of(centre_of(body)) + 1];
        for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            members_[next[cell_of(centre_of(world.bodies[b]))]++] = static_cast<BodyIndex>(b);
        }
    }

    template <typename Visit>
    void visit(const Box& box, Visit&& visit_body) const {
        const std::int64_t x0 = column(box.low.x), x1 = column(box.high.x), y0 = row(box.low.y), y1 = row(box.high.y);
        for (std::int64_t y = y0; y <= y1; ++y) {
            const std::uint32_t end = begin_[static_cast<std::size_t>(y * columns_ + x1) + 1];
            for (std::uint32_t m = begin_[static_cast<std::size_t>(y * columns_ + x0)]; m < end; ++m)
                visit_body(members_[m]);
        }
    }

  private:
    std::int64_t column(double x) const {
        return std::clamp(static_cast<std::int64_t>(std::floor((x - low_.x) / size_)), std::int64_t{0}, columns_ - 1);
    }
    std::int64_t row(double y) const {
        return std::clamp(static_cast<std::int64_t>(std::floor((y - low_.y) / size_)), std::int64_t{0}, rows_ - 1);
    }
    std::size_t cell_of(Vec2 p) const { return static_cast<std::size_t>(row(p.y) * columns_ + column(p.x)); }

    Vec2 low_;
    double size_ = 0.0;
    std::int64_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> begin_;
    std::vector<BodyIndex> members_;
};

/// Pairs of bodies whose bounding boxes and circles come within thick + skin, as i << 32 | j with i < j, sorted.
std::vector<std::uint64_t> near_pairs(const World& world) {
    const PhaseTimer timer(world.profile, Phase::broad_phase);
    const Grid grid(world);
    const double widest = world.half_skins.empty() ? 0.0 : *std::ranges::max_element(world.half_skins);
    std::vector<std::uint64_t> pairs;
    pairs.reserve(4 * world.bodies.size());
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const Box own = bounding_box(world, b);
        const double margin = world.largest_smaller[b] + world.thick + world.half_skins[b] + widest;
        Box search;
        search.add(own.low, margin);
        search.add(own.high, margin);
        const BodyState& body = world.bodies[b];
        grid.visit(search, [&](BodyIndex other) {
            if (world.size_rank[other] <= world.size_rank[b]) return;
            const BodyState& partner = world.bodies[other];
            const double reach =
                world.info[other].reach + world.thick + skin_between(world, static_cast<BodyIndex>(b), other);
            const double dx = partner.x - body.x, dy = partner.y - body.y;
            const double limit = world.info[b].reach + reach;
            if (dx * dx + dy * dy > limit * limit) return;
            const double bx = std::max({own.low.x - partner.x, partner.x - own.high.x, 0.0});
            const double by = std::max({own.low.y - partner.y, partner.y - own.high.y, 0.0});
            if (bx * bx + by * by > reach * reach) return;
            const auto self = static_cast<std::uint64_t>(b);
            pairs.push_back(self < other ? (self << 32) | other : (static_cast<std::uint64_t>(other) << 32) | self);
        });
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

using PointLists = std::array<std::vector<ContactPoint>, point_kinds>;

/// sqrt of m_i m_j/(m_i + m_j); a partner held in translation counts as infinitely heavy.
double root_effective_mass(const World& world, BodyIndex i, BodyIndex j) {
    const auto inverse = [&](BodyIndex b) {
        const BodyInertia& inertia = world.inertia[b];
        return inertia.inverse_mass_x > 0.0 || inertia.inverse_mass_y > 0.0 ? 1.0 / inertia.mass : 0.0;
    };
    const double sum = inverse(i) + inverse(j);
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : 0.0;
}

ContactPoint new_point(BodyIndex i, BodyIndex j, std::uint32_t element, std::uint32_t feature) {
    ContactPoint point{};
    point.body_i = i;
    point.body_j = j;
    point.element_i = element;
    point.feature_j = feature;
    return point;
}

void add_circle_pairs(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo &a = world.info[i], &b = world.info[j];
    const bool single = a.single_circle && b.single_circle;
    const double skin = skin_between(world, i, j);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Vec2 centre = centre_of(world.bodies[i]) + turned(world.bodies[i], world.elements[p]);
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            const Vec2 other = centre_of(world.bodies[j]) + turned(world.bodies[j], world.elements[q]);
            if (norm(other - centre) > world.elements[p].radius + world.elements[q].radius + skin) continue;
            lists[static_cast<std::size_t>(single ? PointKind::circle_circle : PointKind::element_element)].push_back(
                new_point(i, j, p, q));
        }
    }
}

/// Elements of i against the outline of j.
void add_outline_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo &a = world.info[i], &b = world.info[j];
    const BodyState& target = world.bodies[j];
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Element& element = world.elements[p];
        const Vec2 w = centre_of(world.bodies[i]) + turned(world.bodies[i], element) - centre_of(target);
        const double limit = element.radius + element.target_reach + skin_between(world, i, j);
        if (dot(w, w) > (b.reach + limit) * (b.reach + limit)) continue;
        const double c = target.shape[0], s = target.shape[1];
        const OutlineFacing facing = face_outline(world, b, b.first_piece, c * w.x + s * w.y, c * w.y - s * w.x);
        if (facing.distance > limit) continue;
        lists[static_cast<std::size_t>(PointKind::element_outline)].push_back(new_point(i, j, p, facing.edge));
    }
}

/// Circles of i against the segments of j, by the guide's law.
void add_circle_segment_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo &a = world.info[i], &b = world.info[j];
    const BodyState& own = world.bodies[i];
    const Vec2 to_j = centre_of(world.bodies[j]) - centre_of(own);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Vec2 centre = turned(own, world.elements[p]);
        const double limit = world.elements[p].radius + world.thick + skin_between(world, i, j);
        if (norm(centre - to_j) > b.reach + limit) continue;
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            if (world.segments[q].length == 0.0) continue;
            const DiscCase found = disc_case(bar_of(world, world.bodies[j], q, to_j), centre, limit);
            if (found.rule == DiscRule::none) continue;
            lists[static_cast<std::size_t>(PointKind::disc_segment)].push_back(new_point(i, j, p, q));
        }
    }
}

/// Segments of i against those of j, by the guide's law: where an end of one comes near the other.
void add_segment_pairs(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo &a = world.info[i], &b = world.info[j];
    const Vec2 to_j = centre_of(world.bodies[j]) - centre_of(world.bodies[i]);
    const double limit = world.thick + skin_between(world, i, j);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        if (world.segments[p].length == 0.0) continue;
        const Bar own = bar_of(world, world.bodies[i], p, {});
        if (std::sqrt(disc_case(own, to_j, 0.0).squared_distance) > b.reach + limit) continue;
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            if (world.segments[q].length == 0.0) continue;
            const Bar other = bar_of(world, world.bodies[j], q, to_j);
            const auto near = [&](const Bar& bar, Vec2 end) {
                return disc_case(bar, end, 0.0).squared_distance < limit * limit;
            };
            if (near(other, own.start) || near(other, own.start + own.length * own.along) || near(own, other.start) ||
                near(own, other.start + other.length * other.along))
                lists[static_cast<std::size_t>(PointKind::segment_segment)].push_back(new_point(i, j, p, q));
        }
    }
}

/// @param i, j two bodies at least one of which is a chain
void add_guide_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const bool chain_i = world.info[i].piece_count > 0, chain_j = world.info[j].piece_count > 0;
    if (chain_i && chain_j) {
        add_segment_pairs(world, i, j, lists);
    } else if (chain_j) {
        add_circle_segment_points(world, i, j, lists);
    } else {
        add_circle_segment_points(world, j, i, lists);
    }
}

void add_wall_points(const World& world, BodyIndex i, PointLists& lists) {
    const BodyInfo& info = world.info[i];
    const BodyState& body = world.bodies[i];
    const Domain& d = world.domain;
    const bool chain = info.piece_count > 0;
    const double skin = skin_between(world, i, i);
    for (std::uint32_t wall = 0; wall < 4; ++wall) {
        if (!d.wall_present[wall]) continue;
        const double whole = wall == 0   ? body.x - d.x1
                             : wall == 1 ? d.x2 - body.x
                             : wall == 2 ? body.y - d.y1
                                         : d.y2 - body.y;
        if (whole > info.reach + skin) continue;
        for (std::uint32_t p = info.first_element; p < info.first_element + info.element_count; ++p) {
            const Vec2 o = turned(body, world.elements[p]);
            const double distance = whole + (wall == 0 ? o.x : wall == 1 ? -o.x : wall == 2 ? o.y : -o.y);
            if (distance > (chain ? 0.0 : world.elements[p].radius) + skin) continue;
            ContactPoint point{};
            point.body_i = i;
            point.body_j = wall;
            point.element_i = p;
            point.feature_j = chain ? 1 : 0;
            lists[static_cast<std::size_t>(PointKind::element_wall)].push_back(point);
        }
    }
}

/// Two bodies none of whose degrees of freedom can answer need no points.
bool both_held(const World& world, BodyIndex i, BodyIndex j) {
    const auto held = [&](BodyIndex b) {
        const BodyInertia& inertia = world.inertia[b];
        return inertia.inverse_mass_x == 0.0 && inertia.inverse_mass_y == 0.0 && inertia.inverse_moment == 0.0;
    };
    return held(i) && held(j);
}

PointLists emit_points(const World& world, const std::vector<std::uint64_t>& pairs) {
    PointLists lists;
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        const PointIndex listed = world.kind_begin[kind + 1] - world.kind_begin[kind];
        lists[kind].reserve(listed + listed / 64);  // few more than before
    }
    for (const std::uint64_t pair : pairs) {
        const auto i = static_cast<BodyIndex>(pair >> 32), j = static_cast<BodyIndex>(pair & 0xffffffffu);
        if (both_held(world, i, j)) continue;
        const bool chain_i = world.info[i].piece_count > 0, chain_j = world.info[j].piece_count > 0;
        if (!chain_i && !chain_j) add_circle_pairs(world, i, j, lists);
        if (world.segment_law != SegmentLaw::rounded) {
            if (chain_i || chain_j) add_guide_points(world, i, j, lists);
            continue;
        }
        if (chain_j) add_outline_points(world, i, j, lists);
        if (chain_i) add_outline_points(world, j, i, lists);
    }
    for (std::size_t b = 0; b < world.bodies.size(); ++b) add_wall_points(world, static_cast<BodyIndex>(b), lists);
    return lists;
}

constexpr PointIndex no_point = std::numeric_limits<PointIndex>::max();

/// Walks the listed points of a kind in the order of their keys; those of element_outline lie in two runs.
class OldPoints {
  public:
    OldPoints(const World& world, PointKind kind) : world_(world), kind_(kind) {
        const auto number = static_cast<std::size_t>(kind);
        first_ = world.kind_begin[number];
        second_end_ = world.kind_begin[number + 1];
        first_end_ = second_ = kind == PointKind::element_outline ? world.fours_end : second_end_;
    }
    bool done() const { return first_ == first_end_ && second_ == second_end_; }
    PointIndex at() const { return from_first() ? first_ : second_; }
    PointKey key() const { return key_of(kind_, world_.points[at()]); }
    void next() { ++(from_first() ? first_ : second_); }

  private:
    bool from_first() const {
        if (first_ == first_end_ || second_ == second_end_) return second_ == second_end_;
        return key_of(kind_, world_.points[first_]) < key_of(kind_, world_.points[second_]);
    }

    const World& world_;
    PointKind kind_;
    PointIndex first_, first_end_, second_, second_end_;
};

/// Points of a new list and which points of the old one they are.
struct Succession {
    std::vector<ContactPoint> points;
    std::vector<PointIndex> old;  // no_point: was not listed
};

/// An old point that stays though it is not listed anew.
struct KeptPoint {
    std::size_t place;  // before the point here
    PointIndex old;
};

/// Inserts kept points, which come in order.
void insert_kept(const World& world, const std::vector<KeptPoint>& kept, Succession& next) {
    std::size_t from = next.points.size(), to = from + kept.size();
    next.points.resize(to);
    next.old.resize(to);
    for (auto one = kept.rbegin(); one != kept.rend(); ++one) {
        while (from > one->place) {
            --from, --to;
            next.points[to] = next.points[from];
            next.old[to] = next.old[from];
        }
        --to;
        next.points[to] = world.points[one->old];
        next.old[to] = one->old;
    }
}

/// The new list of a kind, in the room of the points found. A bond is carried over whether its point was found or not:
/// it lasts until the force pass finds it broken, and intact ones hold at any opening.
Succession succeed(World& world, PointKind kind, std::vector<ContactPoint> found) {
    Succession next{std::move(found), {}};
    next.old.resize(next.points.size());
    const bool consistent = world.integrator == Integrator::consistent;
    const bool closed = world.has_bonds && world.intact.no_new_contacts;
    const auto flagged = [&](PointIndex old, PointFlag flag) { return (world.point_states[old].flags & flag) != 0; };
    const auto leave_out = [&](PointIndex old) {
        if (consistent) world.owed[world.points[old].body_i] += world.openings[old].defect;
    };
    std::size_t count = 0;
    std::vector<KeptPoint> kept;
    OldPoints old(world, kind);
    const auto pass_unlisted = [&] {
        // One that touched a step ago has its last force to settle, however far it has gone.
        const bool settles = consistent && !by_guide(kind) && flagged(old.at(), point_touching) && !closed;
        if (flagged(old.at(), point_bonded) || settles) {
            kept.push_back({count, old.at()});
        } else {
            leave_out(old.at());
        }
        old.next();
    };
    for (const ContactPoint& point : next.points) {
        const PointKey key = key_of(kind, point);
        while (!old.done() && old.key() < key) pass_unlisted();
        const bool known = !old.done() && old.key() == key;
        if (!closed || (known && flagged(old.at(), point_bonded))) {
            next.old[count] = known ? old.at() : no_point;
            next.points[count] = point;
            ++count;
        } else if (known) {
            leave_out(old.at());
        }
        if (known) old.next();
    }
    while (!old.done()) pass_unlisted();
    next.points.resize(count);
    next.old.resize(count);
    insert_kept(world, kept, next);
    return next;
}

/// The pairs with four points go first. @return how many points these have
PointIndex put_fours_first(Succession& next) {
    Succession others;
    std::size_t fours = 0;
    for (std::size_t first = 0, last = 0; first < next.points.size(); first = last) {
        while (last < next.points.size() && same_pair(next.points[first], next.points[last])) ++last;
        for (std::size_t k = first; k < last; ++k) {
            if (last - first == 4) {
                next.points[fours] = next.points[k];
                next.old[fours] = next.old[k];
                ++fours;
            } else {
                others.points.push_back(next.points[k]);
                others.old.push_back(next.old[k]);
            }
        }
    }
    std::ranges::copy(others.points, next.points.begin() + static_cast<std::ptrdiff_t>(fours));
    std::ranges::copy(others.old, next.old.begin() + static_cast<std::ptrdiff_t>(fours));
    return static_cast<PointIndex>(fours);
}

/// Puts one kind behind another, in the room of the larger.
template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
    if (all.size() < more.size()) {
        more.insert(more.begin(), all.begin(), all.end());
        all = std::move(more);
    } else {
        all.insert(all.end(), more.begin(), more.end());
    }
}

/// One remembered quantity in the new order; nothing in a world that does not keep it.
template <class T>
void carry_over(std::vector<T>& values, const std::vector<PointIndex>& old, bool kept = true) {
    std::vector<T> now(kept ? old.size() : 0, T{});
    if (!values.empty()) {
        for (std::size_t k = 0; k < now.size(); ++k) {
            if (old[k] != no_point) now[k] = values[old[k]];
        }
    }
    values = std::move(now);
}

/// What points that left the list still owed goes to another of their bodies' points: written off, it would pile up,
/// for such points owe more often than they are owed.
void hand_on(World& world) {
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        if (by_guide(static_cast<PointKind>(kind))) continue;
        for (PointIndex k = world.kind_begin[kind]; k < world.kind_begin[kind + 1]; ++k) {
            if ((world.point_states[k].flags & point_bonded) != 0) continue;
            const auto take = [&](BodyIndex b) { world.openings[k].defect += std::exchange(world.owed[b], 0.0); };
            take(world.points[k].body_i);
            if (static_cast<PointKind>(kind) != PointKind::element_wall) take(world.points[k].body_j);
        }
    }
}

/// Of each point the pair of materials and the effective mass.
void find_pairs(World& world) {
    const PointIndex walls = world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    world.root_masses.resize(world.points.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const BodyIndex i = world.points[k].body_i, j = world.points[k].body_j;
        const std::size_t materials = world.materials.size();
        const std::size_t law = k < walls ? law_between(world, i, j) : materials * materials + world.info[i].material;
        world.point_states[k].law = static_cast<std::uint16_t>(law);
        world.root_masses[k] = k < walls ? root_effective_mass(world, i, j) : std::sqrt(world.inertia[i].mass);
    }
}

void refuse_more_than_countable(std::size_t points) {
    constexpr std::size_t most = no_point - 1;
    if (points > most)
        throw InputError(
            fmt::format("found {} contact points, expected at most {}; take a smaller scene", points, most));
}

/// Replaces the points of the world, carrying over what the old ones remember.
void exchange_points(World& world, PointLists& lists) {
    Succession next;
    std::array<PointIndex, point_kinds + 1> kind_begin{};
    PointIndex fours_end = 0;
    for (std::size_t number = 0; number < point_kinds; ++number) {
        const auto kind = static_cast<PointKind>(number);
        Succession of_kind = succeed(world, kind, std::move(lists[number]));
        if (kind == PointKind::element_outline) fours_end = kind_begin[number] + put_fours_first(of_kind);
        refuse_more_than_countable(next.points.size() + of_kind.points.size());
        append(next.points, std::move(of_kind.points));
        append(next.old, std::move(of_kind.old));
        kind_begin[number + 1] = static_cast<PointIndex>(next.points.size());
    }
    const bool consistent = world.integrator == Integrator::consistent;
    carry_over(world.point_states, next.old);
    carry_over(world.shear_forces, next.old);
    carry_over(world.bond_overlaps, next.old);
    carry_over(world.normal_dashpot, next.old, world.ledger_on);
    carry_over(world.shear_dashpot, next.old, world.ledger_on);
    carry_over(world.spring_work, next.old, keeps_spring_work(world));
    carry_over(world.openings, next.old, consistent);
    carry_over(world.strong_normal, next.old, world.has_bonds);
    carry_over(world.strong_shear, next.old, world.has_bonds);
    world.points = std::move(next.points);
    world.kind_begin = kind_begin;
    world.fours_end = fours_end;
    find_pairs(world);
    if (consistent) hand_on(world);
    world.point_forces.assign(world.keep_point_forces ? world.points.size() : 0, PointForce{});
    world.loss_blocks.assign(block_count(world), World::LossBlock{});
}

/// How far surface points can have gone since the list was built.
struct Ways {
    double longest = 0.0;  // m
    double left = 0.0;     // m, least that any has left of its half skin
    bool used_up = false;  // some has hardly anything left
};

Ways ways_since_list(const World& world) {
    Ways ways{0.0, std::numeric_limits<double>::infinity(), false};
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies[b];
        const ListReference& then = world.list_reference[b];
        const double way =
            norm({body.x - then.x, body.y - then.y}) + world.turning_reach[b] * std::abs(body.angle - then.angle);
        const double half = world.half_skins[b];
        ways.longest = std::max(ways.longest, way);
        ways.left = std::min(ways.left, half - way);
        ways.used_up = ways.used_up || way > 0.8 * half;
    }
    return ways;
}

bool skin_follows(const World& world) { return world.has_bonds && world.widest_skin > 0.0; }

/// The skin that lasts for list_lasts steps like those since the list was built. @param way the longest since then, m
double skin_for(const World& world, double way) {
    const double pace = way / static_cast<double>(std::max<std::int64_t>(1, world.step - world.list_step));
    return std::clamp(2.0 * list_lasts * pace, narrowest_share * world.widest_skin, world.widest_skin);
}

/// Half skins of all bodies by how fast they are now. Where no skin is wide enough a body's own speed counts; under the
/// guide's law every listed disc bounds the step, so that none is listed early.
void choose_half_skins(World& world) {
    const double half = 0.5 * world.skin;
    world.half_skins.assign(world.bodies.size(), half);
    // Before there is a step, ramps have no velocity yet.
    const bool own = world.time_step > 0.0 && world.widest_skin > 0.0 && world.skin == world.widest_skin;
    if (!own || world.segment_law != SegmentLaw::rounded) return;
    const double reach = world.widest_skin / skin_share;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies[b];
        const double speed = norm({body.vx, body.vy}) + world.turning_reach[b] * std::abs(body.omega);
        const double lasting = std::sqrt(rebuild_steps * speed * world.time_step * reach);
        world.half_skins[b] = std::clamp(lasting, half, std::max(half, widest_own * reach));
    }
}

void rebuild(World& world) {
    choose_half_skins(world);
    std::vector<std::uint64_t> pairs = near_pairs(world);
    {
        const PhaseTimer timer(world.profile, Phase::listing);
        PointLists lists = emit_points(world, pairs);
        std::vector<std::uint64_t>().swap(pairs);  // the lists need the room
        exchange_points(world, lists);
        world.sweep.valid = false;
        world.marks.resize(world.bodies.size());
    }
    world.list_reference.resize(world.bodies.size());
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        world.list_reference[b] = {world.bodies[b].x, world.bodies[b].y, world.bodies[b].angle};
    }
    world.travelled = 0.0;
    world.free_way = world.half_skins.empty() ? 0.0 : *std::ranges::min_element(world.half_skins);
    world.list_valid = true;
    world.list_step = world.step;
    world.list_builds += 1;
    evaluate_step_bound(world);
}

}  // namespace

void refresh_neighbours(World& world) {
    if (world.list_valid) {
        const std::int64_t age = world.step - world.list_step;
        const bool look = skin_follows(world) && age > 0 && age % look_interval == 0;
        if (!look && world.travelled <= world.free_way) return;
        // The bound is used up: look how far bodies really went, and rebuild if one has little left of its skin.
        const Ways ways = ways_since_list(world);
        world.travelled = 0.0;
        world.free_way = ways.left;
        if (!ways.used_up && !(look && skin_for(world, ways.longest) < 0.25 * world.skin)) return;
        refuse_piercing(world);
        if (skin_follows(world)) world.skin = skin_for(world, ways.longest);
    }
    rebuild(world);
}

}  // namespace crackle
