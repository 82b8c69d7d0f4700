// SPDX-License-Identifier: GPL-3.0-or-later
// Where the bodies of several contact points meet, and how they move there: records turned into lanes.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/relative_motion.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Geometry of the points of a batch and how i moves against j there.
template <class Contact>
struct BatchGeometry {
    Contact contact;
    RelativeMotion<Lanes> motion;
};
using CircleBatch = BatchGeometry<CircleContact<Lanes>>;
using OutlineBatch = BatchGeometry<PointGeometry<Lanes>>;
struct FaceBatch : BatchGeometry<FlatFaceGeometry<Lanes>> {
    PairMotion<Lanes> pair;
};

using BatchBodies = const BodyState* [lane_count];

/// Two numbers that lie side by side, of each body of a batch. @param first of them
CRACKLE_INLINE void load_pairs(const BatchBodies& bodies, double BodyState::*first, Lanes& a, Lanes& b) {
    const double* at[lane_count];
    for (int l = 0; l < lane_count; ++l) at[l] = &(bodies[l]->*first);
    gather_pairs(at, a, b);
}

/// Of two single circles each.
CRACKLE_INLINE void circle_batch(const BatchBodies& i, const BatchBodies& j, CircleBatch& g) {
    static_assert(offsetof(BodyState, shape) == offsetof(BodyState, omega) + sizeof(double));
    Lanes ix, iy, jx, jy, ivx, ivy, jvx, jvy, spin_i, spin_j, radius_i, radius_j;
    load_pairs(i, &BodyState::x, ix, iy);
    load_pairs(j, &BodyState::x, jx, jy);
    load_pairs(i, &BodyState::omega, spin_i, radius_i);
    load_pairs(j, &BodyState::omega, spin_j, radius_j);
    g.contact = circle_contact<Lanes>(jx - ix, jy - iy, radius_i, radius_j);
    load_pairs(i, &BodyState::vx, ivx, ivy);
    load_pairs(j, &BodyState::vx, jvx, jvy);
    g.motion = relative_motion<Lanes>(g.contact, {ivx - jvx, ivy - jvy, spin_i, spin_j});
}

/// The two bodies of each point of element_outline.
struct PairLanes {
    Lanes dx, dy;  // m, of i from j
    PairMotion<Lanes> motion;
    Lanes cosine_i, sine_i, cosine_j, sine_j;
};

CRACKLE_INLINE PairLanes load_any_pairs(const World& world, const BodyPair* points) {
    static_assert(offsetof(BodyState, angle) == offsetof(BodyState, shape) + 2 * sizeof(double));
    const BodyState* const bodies = world.bodies.state.data();
    BatchBodies i, j;
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &bodies[points[l].body_i];
        j[l] = &bodies[points[l].body_j];
    }
    PairLanes pair;
    Lanes ix, iy, jx, jy, unused;
    load_pairs(i, &BodyState::x, ix, iy);
    load_pairs(j, &BodyState::x, jx, jy);
    pair.dx = ix - jx, pair.dy = iy - jy;
    load_pairs(i, &BodyState::vx, ix, iy);
    load_pairs(j, &BodyState::vx, jx, jy);
    pair.motion.vx = ix - jx, pair.motion.vy = iy - jy;
    load_pairs(i, &BodyState::omega, pair.motion.spin_i, pair.cosine_i);
    load_pairs(j, &BodyState::omega, pair.motion.spin_j, pair.cosine_j);
    const double *sine_i[lane_count], *sine_j[lane_count];
    for (int l = 0; l < lane_count; ++l) sine_i[l] = i[l]->shape + 1, sine_j[l] = j[l]->shape + 1;
    gather_pairs(sine_i, pair.sine_i, unused);
    gather_pairs(sine_j, pair.sine_j, unused);
    return pair;
}

/// Of points that lie in fours, those whose body_i is not that of the first of them here.
CRACKLE_INLINE LaneBits swapped_lanes(const BodyPair* points) {
    typedef std::int32_t Words __attribute__((vector_size(4 * lane_count)));
    Words owners, firsts;
    for (int l = 0; l < lane_count; ++l) {
        owners[l] = static_cast<std::int32_t>(points[l].body_i);
        firsts[l] = static_cast<std::int32_t>(points[l & ~3].body_i);
    }
    return __builtin_convertvector(owners != firsts, LaneBits);
}

/// The same where the points lie in fours between two bodies each, which are loaded once.
CRACKLE_INLINE PairLanes load_fours(const World& world, const BodyPair* points) {
    constexpr std::size_t fours = std::max(1, lane_count / 4);  // or half of one
    const BodyState *a[fours], *b[fours];
    for (std::size_t f = 0; f < fours; ++f) {
        const BodyPair* const four = points + 4 * f;
        a[f] = &world.bodies.state[four->body_i];
        b[f] = &world.bodies.state[four->body_j];
    }
    const LaneBits swapped = swapped_lanes(points);  // i is the second of the two
    const LaneBits sign = swapped & sign_bit;
    const auto of_fours = [](const auto& number) {
        double numbers[fours];
        for (std::size_t f = 0; f < fours; ++f) numbers[f] = number(f);
        return lanes_of_fours(numbers);
    };
    const auto difference = [&](double BodyState::*number) {
        return lanes_of(bits_of(of_fours([&](std::size_t f) { return a[f]->*number - b[f]->*number; })) ^ sign);
    };
    const auto either = [&](const auto& number, Lanes& i, Lanes& j) {
        const Lanes of_a = of_fours([&](std::size_t f) { return number(*a[f]); });
        const Lanes of_b = of_fours([&](std::size_t f) { return number(*b[f]); });
        i = swapped ? of_b : of_a;
        j = swapped ? of_a : of_b;
    };
    PairLanes pair;
    pair.dx = difference(&BodyState::x), pair.dy = difference(&BodyState::y);
    pair.motion.vx = difference(&BodyState::vx), pair.motion.vy = difference(&BodyState::vy);
    either([](const BodyState& body) { return body.omega; }, pair.motion.spin_i, pair.motion.spin_j);
    either([](const BodyState& body) { return body.shape[0]; }, pair.cosine_i, pair.cosine_j);
    either([](const BodyState& body) { return body.shape[1]; }, pair.sine_i, pair.sine_j);
    return pair;
}

/// What is known of points of element_outline before the roots: kernels do this for many batches, then the roots for
/// all of these, for one batch is a chain of calculations that the processor would wait for.
struct OutlineStage {
    FacingElement<Lanes> element;
    Lanes across, over;  // m, as in BeforeEdge, of the edge faced
    Lanes tx, ty;        // direction of the edge, body frame of j
    PairMotion<Lanes> motion;
};

/// What points that come later look at. In a mesh beyond the caches it comes from memory, from places that only the
/// points name: a sixth of the step of 50,000 cells.
CRACKLE_INLINE void prefetch_outlines(const World& world, const BodyPair* points, const PointParts* parts) {
    constexpr std::ptrdiff_t points_ahead = 128;
    if (world.points.contact.pairs.data() + world.points.fours_end - points < points_ahead + lane_count) return;
    const BodyPair* const later = points + points_ahead;
    const PointParts* const later_parts = parts + points_ahead;
    for (int l = 0; l < lane_count; ++l) __builtin_prefetch(&world.bodies.edges[later_parts[l].feature_j]);
    for (int l = 0; l < lane_count; l += 2) __builtin_prefetch(&world.bodies.elements[later_parts[l].element_i]);
    for (int l = 0; l < lane_count; l += 4) {
        __builtin_prefetch(&world.bodies.state[later[l].body_i]);
        __builtin_prefetch(&world.bodies.state[later[l].body_j]);
    }
}

/// Points beyond which a scene is taken to be larger than the caches: some 8 MB.
inline constexpr std::size_t points_in_cache = 50'000;

/// Bodies that the points of circles name later on. Beyond the caches this spares a twentieth of a step; the points'
/// own arrays come by themselves.
CRACKLE_INLINE void prefetch_circles(const World& world, PointIndex k, PointIndex count) {
    constexpr PointIndex bodies_ahead = 128, points_ahead = 256, points_in_line = 64 / sizeof(BodyPair);
    if (k + count + points_ahead > world.points.kind_begin[1]) return;
    const BodyPair* const points = world.points.contact.pairs.data() + k;
    for (PointIndex l = 0; l < count; l += points_in_line) __builtin_prefetch(points + points_ahead + l);
    for (PointIndex l = 0; l < count; ++l) {
        const BodyIndex j = points[bodies_ahead + l].body_j;  // i has been some other's j
        __builtin_prefetch(&world.bodies.state[j]);
        __builtin_prefetch(&world.bodies.force[j]);
    }
}

/// The edge faced last and its corners are tried for all points; the search is left to geometry.hpp where one
/// has got beyond them or the outline is not one convex piece. @tparam Fours all elements are corners of a mesh
template <bool Fours>
CRACKLE_INLINE void outline_stage(const World& world, const BodyPair* points, PointParts* parts, const PairLanes& pair,
                                  OutlineStage& stage) {
    static_assert(offsetof(Edge, cone) == offsetof(Edge, length) + sizeof(double));
    const double *elements[lane_count], *element_reaches[lane_count], *edges[lane_count], *edge_directions[lane_count],
        *edge_lengths[lane_count], *edge_ends[lane_count];
    [[maybe_unused]] Element circles[lane_count];
    Lanes element_x, element_y, target_reach, unused;
    EdgeNumbers<Lanes> edge;
    for (int l = 0; l < lane_count; ++l) {
        const Element* element = nullptr;
        if constexpr (Fours) {
            element = &world.bodies.elements[parts[l].element_i];
        } else {
            circles[l] = element_of(world, points[l].body_i, parts[l].element_i);
            element = &circles[l];
        }
        const Edge& faced = world.bodies.edges[parts[l].feature_j];
        elements[l] = &element->x;
        element_reaches[l] = &element->radius;
        edges[l] = &faced.x;
        edge_directions[l] = &faced.tx;
        edge_lengths[l] = &faced.length;
        edge_ends[l] = &faced.cone[1];
    }
    FacingElement<Lanes>& e = stage.element;
    gather_pairs(elements, element_x, element_y);
    gather_pairs(element_reaches, e.radius, target_reach);
    e.cover = e.radius + target_reach;
    gather_pairs(edges, edge.x, edge.y);
    gather_pairs(edge_directions, edge.tx, edge.ty);
    gather_pairs(edge_lengths, edge.length, edge.cone_before);
    gather_pairs(edge_ends, edge.cone_beyond, unused);
    e.ox = pair.cosine_i * element_x - pair.sine_i * element_y;
    e.oy = pair.sine_i * element_x + pair.cosine_i * element_y;
    e.wx = pair.dx + e.ox;
    e.wy = pair.dy + e.oy;
    e.cosine = pair.cosine_j, e.sine = pair.sine_j;
    const Lanes px = e.cosine * e.wx + e.sine * e.wy, py = e.cosine * e.wy - e.sine * e.wx;
    const BeforeEdge<Lanes> place = before_edge(edge, px, py);
    LaneBits settled = place.is_closest;
    stage.across = place.across;
    stage.over = place.over;
    stage.tx = edge.tx, stage.ty = edge.ty;
    stage.motion = pair.motion;
    // Whether the edge faced last is of an outline whose edges are all there is to face.
    if (!world.bodies.convex_outlines) {
        for (int l = 0; l < lane_count; ++l)
            if (world.bodies.edges[parts[l].feature_j].outline_of != points[l].body_j) settled[l] = 0;
    }
    if (const unsigned search = mask_of(~settled); search != 0) {
        for (int l = 0; l < lane_count; ++l) {
            if ((search >> l & 1) == 0) continue;
            const OutlineFacing facing =
                face_outline(world, world.bodies.info(points[l].body_j), parts[l].feature_j, px[l], py[l]);
            parts[l].feature_j = facing.edge;
            stage.across[l] = facing.distance;
            stage.over[l] = 0.0;
            stage.tx[l] = -facing.gy;
            stage.ty[l] = facing.gx;
        }
    }
}

CRACKLE_INLINE void outline_batch(const OutlineStage& stage, double drift, OutlineBatch& g) {
    g.contact = outline_contact(stage.element,
                                outline_distance(stage.over != 0.0, stage.over, stage.across, stage.tx, stage.ty));
    g.motion = relative_motion(g.contact, stage.motion, drift);
}

/// Of two single circles' flat faces each.
CRACKLE_INLINE void face_batch(const World& world, const BodyPair* points, const PointParts* parts, FaceBatch& g) {
    static_assert(offsetof(FlatFace, to) == offsetof(FlatFace, from) + sizeof(double));
    static_assert(offsetof(FlatFace, along_y) == offsetof(FlatFace, along_x) + sizeof(double));
    BatchBodies i, j;
    const double *ends_i[lane_count], *ends_j[lane_count], *heights_i[lane_count], *heights_j[lane_count],
        *directions[lane_count];
    Lanes sense;
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &world.bodies.state[points[l].body_i];
        j[l] = &world.bodies.state[points[l].body_j];
        const FlatFace &a = world.bodies.flat_faces[parts[l].element_i],
                       &b = world.bodies.flat_faces[parts[l].feature_j];
        ends_i[l] = &a.from, ends_j[l] = &b.from;
        heights_i[l] = &a.height, heights_j[l] = &b.height;
        directions[l] = &a.along_x;
        sense[l] = sense_of(a);
    }
    FaceNumbers<Lanes> a, b;
    Lanes along_x, along_y, ix, iy, jx, jy, unused;
    gather_pairs(ends_i, a.from, a.to);
    gather_pairs(ends_j, b.from, b.to);
    gather_pairs(heights_i, a.height, unused);
    gather_pairs(heights_j, b.height, unused);
    gather_pairs(directions, along_x, along_y);
    load_pairs(i, &BodyState::x, ix, iy);
    load_pairs(j, &BodyState::x, jx, jy);
    g.contact = flat_face_contact<Lanes>(a, b, along_x, along_y, sense, jx - ix, jy - iy);
    load_pairs(i, &BodyState::vx, ix, iy);
    load_pairs(j, &BodyState::vx, jx, jy);
    g.pair.vx = ix - jx, g.pair.vy = iy - jy;
    load_pairs(i, &BodyState::omega, g.pair.spin_i, unused);
    load_pairs(j, &BodyState::omega, g.pair.spin_j, unused);
    g.motion = relative_motion<Lanes>(g.contact, g.pair, world.stepping.drift);
}

/// What the forces of batches of a kind need to know of their bodies.
template <PointKind K>
using BatchOf = std::conditional_t<K == PointKind::circle_circle, CircleBatch,
                                   std::conditional_t<K == PointKind::face_face, FaceBatch, OutlineBatch>>;

/// Fills the geometry of batches that begin with point k. @tparam Fours they lie before Points::fours_end
template <PointKind K, bool Fours, PointIndex Most>
CRACKLE_INLINE void geometry_batches(World& world, PointIndex k, PointIndex batches, BatchOf<K> (&geometry)[Most]) {
    const BodyPair* points = world.points.contact.pairs.data() + k;
    if constexpr (K == PointKind::circle_circle) {
        const BodyState* const bodies = world.bodies.state.data();
        for (std::size_t n = 0; n < batches; ++n, points += lane_count) {
            BatchBodies i, j;
            for (int l = 0; l < lane_count; ++l) {
                i[l] = &bodies[points[l].body_i];
                j[l] = &bodies[points[l].body_j];
            }
            circle_batch(i, j, geometry[n]);
        }
    } else if constexpr (K == PointKind::face_face) {
        const PointParts* parts = world.points.contact.parts.data() + (k - world.points.kind_begin[1]);
        for (std::size_t n = 0; n < batches; ++n, points += lane_count, parts += lane_count)
            face_batch(world, points, parts, geometry[n]);
    } else {
        static_assert(K == PointKind::element_outline);
        OutlineStage stages[Most];
        const bool in_memory = world.points.size() > points_in_cache;
        PointParts* parts = world.points.contact.parts.data() + (k - world.points.kind_begin[1]);
        for (std::size_t n = 0; n < batches; ++n, points += lane_count, parts += lane_count) {
            if (Fours && in_memory) prefetch_outlines(world, points, parts);
            outline_stage<Fours>(world, points, parts,
                                 Fours ? load_fours(world, points) : load_any_pairs(world, points), stages[n]);
        }
        for (PointIndex n = 0; n < batches; ++n) outline_batch(stages[n], world.stepping.drift, geometry[n]);
    }
}

}  // namespace crackle
