// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the overlap under the DEMseg guide's segment law (guide_segments.hpp): of each disc with a bare
// segment (disc case), and of the resultant of several discs.
//
// With a the motion of i's material relative to j's, positive along n_c when closing, and q = (r - |α|)/l =
// sqrt((r-|α|)/(r+|α|)):
//     (ii), (iv)  dδ_c = n_c·a at the contact position
//     (iii)       dδ_c = -q'·d·(n_c·a at p) ∓ q·(τ·a at the disc's centre),   d = |s_k - p|, q' = -r/(q(r + |α|)²),
//                 τ from p to s_k, upper sign for a disc of i
// For the resultant δ = |Σ δ_c n_c|:  dδ = Σ (n·n_c) dδ_c + Σ δ_c n·dn_c. Here n_c rotates with the segment in (iii)
// and (iv), and with the line from the centre to the end in (ii). Tests of segment contacts compare these derivatives
// with finite differences of the force routine.

#include "solver/geometry/overlap_gradient.hpp"

namespace crackle {
namespace {

struct Disc {
    DiscCase found;
    Bar bar;
    Vec2 centre;
    double radius, sense;
};

/// Up to four discs, in an array of fixed size, because a step must not allocate memory.
struct Discs {
    std::array<Disc, 4> all;
    std::size_t count = 0;

    const Disc* begin() const { return all.data(); }
    const Disc* end() const { return all.data() + count; }
};

Discs discs_of(const World& world, PointKind kind, const ContactPoint& point) {
    Discs discs;
    const auto add = [&](const Bar& bar, Vec2 centre, double radius, double sense) {
        DiscCase found = disc_case(bar, centre, radius);
        place(found, bar, centre);
        discs.all[discs.count++] = {found, bar, centre, radius, sense};
    };
    const BodyState &i = world.bodies.state[point.body_i], &j = world.bodies.state[point.body_j];
    if (kind == PointKind::disc_segment) {
        visit_discs<PointKind::disc_segment>(BodyView(world), point, i, j, add);
    } else {
        visit_discs<PointKind::segment_segment>(BodyView(world), point, i, j, add);
    }
    return discs;
}

void add_to(OverlapGradient& sum, double share, const OverlapGradient& row) {
    for (std::size_t d = 0; d < row.size(); ++d) sum[d] += share * row[d];
}

/// Vector from the centroid of i to that of j.
Vec2 between(const World& world, const ContactPoint& point) {
    const BodyState &i = world.bodies.state[point.body_i], &j = world.bodies.state[point.body_j];
    return {j.x - i.x, j.y - i.y};
}

/// Derivative dδ_c of the overlap of one disc that is in contact.
OverlapGradient case_gradient(const Disc& disc, Vec2 to_j) {
    const DiscCase& c = disc.found;
    const OverlapGradient along = closing_gradient(disc.sense * c.normal, c.at, c.at - to_j);
    if (c.rule != DiscRule::ramp) return along;
    const double r = disc.radius, q = std::sqrt((r - c.height) / (r + c.height));
    OverlapGradient row{};
    add_to(row, r * c.inside / (q * (r + c.height) * (r + c.height)), along);
    const Vec2 towards_end = (1.0 / c.inside) * (c.end - c.at);
    add_to(row, -disc.sense * q, closing_gradient(towards_end, disc.centre, disc.centre - to_j));
    return row;
}

/// Part of the derivative due to rotation of a disc's normal, n·dn_c, for a disc that is in contact.
OverlapGradient turning_gradient(const Disc& disc, Vec2 n, Vec2 to_j) {
    const DiscCase& c = disc.found;
    const Vec2 normal = disc.sense * c.normal, aside = perpendicular(normal);
    OverlapGradient row{};
    const bool disc_of_i = disc.sense > 0.0;
    if (c.rule == DiscRule::end && c.squared_distance > 0.0) {
        const Vec2 on_i = disc_of_i ? disc.centre : c.end, on_j = disc_of_i ? c.end : disc.centre;
        add_to(row, -dot(n, aside) / std::sqrt(c.squared_distance), closing_gradient(aside, on_i, on_j - to_j));
    } else {
        row[disc_of_i ? 5 : 2] = dot(n, aside);  // the normal rotates with the body that owns the segment
    }
    return row;
}

}  // namespace

OverlapGradient guide_gradient(const World& world, PointKind kind, const ContactPoint& point) {
    const Discs discs = discs_of(world, kind, point);
    const Vec2 to_j = between(world, point);
    Vec2 sum;
    double cases = 0.0;
    const Disc* nearest = discs.begin();
    for (const Disc& disc : discs) {
        if (disc.found.squared_distance < nearest->found.squared_distance) nearest = &disc;
        if (disc.found.rule == DiscRule::none) continue;
        sum = sum + (disc.sense * disc.found.overlap) * disc.found.normal;
        cases += 1.0;
    }
    const double size = norm(sum);
    if (!(size > 0.0)) {
        const DiscCase& c = nearest->found;
        return closing_gradient(nearest->sense * c.normal, c.at, c.at - to_j);
    }
    const Vec2 n = (1.0 / size) * sum;
    const double share = world.settings.segment_law == SegmentLaw::demseg_mean ? 1.0 / cases : 1.0;
    OverlapGradient row{};
    for (const Disc& disc : discs) {
        if (disc.found.rule == DiscRule::none) continue;
        add_to(row, share * dot(n, disc.sense * disc.found.normal), case_gradient(disc, to_j));
        add_to(row, share * disc.found.overlap, turning_gradient(disc, n, to_j));
    }
    return row;
}

std::vector<OverlapGradient> idle_discs(const World& world, PointKind kind, const ContactPoint& point) {
    std::vector<OverlapGradient> rows;
    const Vec2 to_j = between(world, point);
    for (const Disc& disc : discs_of(world, kind, point)) {
        const DiscCase& c = disc.found;
        const double limit = disc.radius + world.list.skin;
        if (c.rule != DiscRule::none || c.squared_distance > limit * limit) continue;
        rows.push_back(closing_gradient(disc.sense * c.normal, c.at, c.at - to_j));
    }
    return rows;
}

}  // namespace crackle
