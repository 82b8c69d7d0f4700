// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/pierced.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/geometry/geometry.hpp"

namespace crackle {
namespace {

/// Position of a body: centroid, and cosine and sine of the rotation of its frame.
struct Place {
    Vec2 centre;
    double c, s;

    Vec2 outwards(Vec2 p) const { return centre + Vec2{c * p.x - s * p.y, s * p.x + c * p.y}; }
    Vec2 inwards(Vec2 p) const {
        const Vec2 d = p - centre;
        return {c * d.x + s * d.y, c * d.y - s * d.x};
    }
};

Place place_now(const World& world, BodyIndex b) {
    const BodyState& body = world.bodies.state[b];
    if (world.bodies.names[b].shape == no_shape) return {{body.x, body.y}, 1.0, 0.0};
    return {{body.x, body.y}, body.shape[0], body.shape[1]};
}

/// Position of a body at the time when the neighbour list was built.
Place place_then(const World& world, BodyIndex b) {
    const ListReference& then = world.list.reference[b];
    const std::uint32_t shape = world.bodies.names[b].shape;
    if (shape == no_shape) return {{then.x, then.y}, 1.0, 0.0};
    const Place now = place_now(world, b);
    const double back = world.list.reference_angles[shape] - world.bodies.state[b].angle,
                 c = correctly_rounded::cos(back), s = correctly_rounded::sin(back);
    return {{then.x, then.y}, c * now.c - s * now.s, s * now.c + c * now.s};
}

/// Distance from the edge's line, m, positive outwards; 0 beyond the ends of the edge, where bodies may pass.
double side_of(const Edge& edge, Vec2 p) {
    const double dx = p.x - edge.x, dy = p.y - edge.y;
    const double along = dx * edge.tx + dy * edge.ty;
    return along <= 0.0 || along >= edge.length ? 0.0 : dx * edge.ty - dy * edge.tx;
}

bool inside(const World& world, const BodyInfo& outline, Vec2 p) {
    for (std::uint32_t n = outline.first_piece; n < outline.first_piece + outline.piece_count; ++n) {
        const Piece& piece = world.bodies.pieces[n];
        bool in = true;
        for (std::uint32_t e = piece.first_edge; in && e < piece.first_edge + piece.edge_count; ++e) {
            const Edge& edge = world.bodies.edges[e];
            in = (p.x - edge.x) * edge.ty - (p.y - edge.y) * edge.tx < 0.0;
        }
        if (in) return true;
    }
    return false;
}

/// Number, counted from 1, of the segment of an open chain that a point moving from `then` to `now` has crossed; 0 if
/// there is none.
std::uint32_t segment_between(const World& world, const BodyInfo& chain, Vec2 then, Vec2 now) {
    for (std::uint32_t n = 0; n < chain.piece_count; ++n) {
        const Edge& edge = world.bodies.edges[world.bodies.pieces[chain.first_piece + n].first_edge];
        if (side_of(edge, now) * side_of(edge, then) < 0.0) return n + 1;
    }
    return 0;
}

/// End of an error message: possible reasons why a body passed through another. The actual reason is not known here.
std::string likely_cause(const World& world) {
    return fmt::format(
        "; the impact is too fast, the load is too high for the stiffness and thickness of the bodies, or the time "
        "step, {:.3g} s (stable bound {:.3g} s), is too large; try half this time step",
        world.stepping.time_step, world.stepping.step_bound);
}

/// Whether a body is convex, so that its centroid lies inside it.
bool convex(const BodyInfo& body) { return body.single_circle || (body.closed && body.piece_count == 1); }

}  // namespace

void refuse_piercing(const World& world) {
    if (world.stepping.allow_unstable || world.settings.segment_law != SegmentLaw::rounded) return;
    const bool held_are_listed = world.settings.driven_contacts == DrivenContacts::all;
    const auto outlines = static_cast<std::size_t>(PointKind::element_outline);
    for (PointIndex k = world.points.kind_begin[outlines]; k < world.points.kind_begin[outlines + 1]; ++k) {
        const auto [i, j] = world.points.contact.pairs[k];
        if (held_are_listed && world.bodies.inertia[i].held() && world.bodies.inertia[j].held()) continue;
        const bool closed = world.bodies.names[j].closed;
        const bool first_of_pair = k == world.points.kind_begin[outlines] ||
                                   world.points.contact.pairs[k - 1].body_i != i ||
                                   world.points.contact.pairs[k - 1].body_j != j;
        if (closed && !(first_of_pair && convex(world.bodies.info(i)))) continue;
        const BodyInfo target = world.bodies.info(j);
        const Place i_now = place_now(world, i), j_now = place_now(world, j);
        if (target.closed) {
            if (!inside(world, target, j_now.inwards(i_now.centre))) continue;
            if (inside(world, target, place_then(world, j).inwards(place_then(world, i).centre))) continue;
            throw UnstableRun(world.stepping.steps, world.bodies.info(i).id,
                              fmt::format("its centroid moved into body {}{}", target.id, likely_cause(world)));
        }
        const Element element = element_of(BodyView(world), i, world.points.contact[k].element_i);
        const Vec2 at{element.x, element.y};
        const std::uint32_t segment =
            segment_between(world, target, place_then(world, j).inwards(place_then(world, i).outwards(at)),
                            j_now.inwards(i_now.outwards(at)));
        if (segment == 0) continue;
        throw UnstableRun(world.stepping.steps, world.bodies.info(i).id,
                          fmt::format("it went through segment {} of body {}{}, or replace the segment with four "
                                      "segments that form a closed box, which pushes such a body back out",
                                      segment, target.id, likely_cause(world)));
    }
}

}  // namespace crackle
