// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry and relative motion of several contact points at once: loads the states of the bodies into vector lanes.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/geometry/flat_faces.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/geometry/relative_motion.hpp"

namespace crackle {

/// Geometry of the points in a batch, and the motion of body i relative to body j at each point.
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

/// Loads two adjacent numbers from the state of each body in a batch. @param first the first of the two numbers
CRACKLE_INLINE void load_pairs(const BatchBodies& bodies, double BodyState::*first, Lanes& a, Lanes& b) {
    const double* at[lane_count];
    for (int l = 0; l < lane_count; ++l) at[l] = &(bodies[l]->*first);
    gather_pairs(at, a, b);
}

/// Geometry of a batch of contacts between single circles.
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

/// For each element_outline point in a batch: relative position and motion of the two bodies, and their orientations.
struct PairLanes {
    Lanes dx, dy;  // m, position of i relative to j
    PairMotion<Lanes> motion;
    Lanes cosine_i, sine_i, cosine_j, sine_j;
};

CRACKLE_INLINE PairLanes load_any_pairs(const PassView& view, const BodyPair* points) {
    static_assert(offsetof(BodyState, angle) == offsetof(BodyState, shape) + 2 * sizeof(double));
    const BodyState* const bodies = view.bodies.state;
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

/// Mask of the lanes whose body_i differs from that of the first point in their group of four.
CRACKLE_INLINE LaneBits swapped_lanes(const BodyPair* points) {
    typedef std::int32_t Words __attribute__((vector_size(4 * lane_count)));
    Words owners, firsts;
    for (int l = 0; l < lane_count; ++l) {
        owners[l] = static_cast<std::int32_t>(points[l].body_i);
        firsts[l] = static_cast<std::int32_t>(points[l & ~3].body_i);
    }
    return __builtin_convertvector(owners != firsts, LaneBits);
}

/// Loads the bodies of points stored in groups of four. All points of a group lie between the same two bodies, so each
/// body is loaded only once per group.
CRACKLE_INLINE PairLanes load_fours(const PassView& view, const BodyPair* points) {
    // Number of groups in a batch; with two lanes, a batch is half a group, which counts as one.
    constexpr std::size_t fours = std::max(1, lane_count / 4);
    const BodyState *a[fours], *b[fours];
    for (std::size_t f = 0; f < fours; ++f) {
        const BodyPair* const four = points + 4 * f;
        a[f] = &view.bodies.state[four->body_i];
        b[f] = &view.bodies.state[four->body_j];
    }
    const LaneBits swapped = swapped_lanes(points);  // lanes in which body i is the second body of the group
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

/// Values of element_outline points before any square root is taken. Kernels compute these for many batches first and
/// then take all roots. If they completed one batch at a time, the processor would wait for each result in a chain of
/// dependent operations.
struct OutlineStage {
    FacingElement<Lanes> element;
    Lanes across, over;  // m, distance in front of the edge and distance beyond its end, as in BeforeEdge
    Lanes tx, ty;        // unit direction of the edge in the body frame of j
    PairMotion<Lanes> motion;
};

/// Prefetches the bodies and edges of later points. In a mesh larger than the caches, they are read from memory at
/// addresses that the processor cannot predict. Without prefetching, waiting for them takes a sixth of a step with
/// 50,000 cells.
CRACKLE_INLINE void prefetch_outlines(const PassView& view, const BodyPair* points, const PointParts* parts) {
    constexpr std::ptrdiff_t points_ahead = 128;
    if (view.pairs + view.fours_end - points < points_ahead + lane_count) return;
    const BodyPair* const later = points + points_ahead;
    const PointParts* const later_parts = parts + points_ahead;
    for (int l = 0; l < lane_count; ++l) __builtin_prefetch(&view.bodies.edges[later_parts[l].feature_j]);
    for (int l = 0; l < lane_count; l += 2) __builtin_prefetch(&view.bodies.elements[later_parts[l].element_i]);
    for (int l = 0; l < lane_count; l += 4) {
        __builtin_prefetch(&view.bodies.state[later[l].body_i]);
        __builtin_prefetch(&view.bodies.state[later[l].body_j]);
    }
}

/// Number of points above which the data of a scene are assumed to exceed the caches (about 8 MB).
inline constexpr std::size_t points_in_cache = 50'000;

/// Prefetches the bodies of later circle contacts and the list of body pairs. In scenes larger than the caches this
/// saves 5 % of a step. The processor itself prefetches the other arrays of points.
CRACKLE_INLINE void prefetch_circles(const PassView& view, PointIndex k, PointIndex count) {
    constexpr PointIndex bodies_ahead = 128, points_ahead = 256, points_in_line = 64 / sizeof(BodyPair);
    if (k + count + points_ahead > view.circle_points) return;
    const BodyPair* const points = view.pairs + k;
    for (PointIndex l = 0; l < count; l += points_in_line) __builtin_prefetch(points + points_ahead + l);
    for (PointIndex l = 0; l < count; ++l) {
        const BodyIndex j =
            points[bodies_ahead + l].body_j;  // body_i is not prefetched, because it was body_j of an earlier point
        __builtin_prefetch(&view.bodies.state[j]);
        __builtin_prefetch(&view.force[j]);
    }
}

/// Computes the OutlineStage of a batch from the edge that each point faced last. If a point has moved beyond this edge
/// and its corners, or if the outline is not one convex piece, face_outline() searches for the edge. @tparam Fours
/// whether all elements are corners of a mesh
template <bool Fours>
CRACKLE_INLINE void outline_stage(const PassView& view, const BodyPair* points, PointParts* parts,
                                  const PairLanes& pair, OutlineStage& stage) {
    static_assert(offsetof(Edge, cone) == offsetof(Edge, length) + sizeof(double));
    const double *elements[lane_count], *element_reaches[lane_count], *edges[lane_count], *edge_directions[lane_count],
        *edge_lengths[lane_count], *edge_ends[lane_count];
    [[maybe_unused]] Element circles[lane_count];
    Lanes element_x, element_y, target_reach, unused;
    EdgeNumbers<Lanes> edge;
    for (int l = 0; l < lane_count; ++l) {
        const Element* element = nullptr;
        if constexpr (Fours) {
            element = &view.bodies.elements[parts[l].element_i];
        } else {
            circles[l] = element_of(view.bodies, points[l].body_i, parts[l].element_i);
            element = &circles[l];
        }
        const Edge& faced = view.bodies.edges[parts[l].feature_j];
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
    // The edge faced last can be used only if it belongs to an outline of body_j that is one convex piece.
    if (!view.bodies.convex_outlines) {
        for (int l = 0; l < lane_count; ++l)
            if (view.bodies.edges[parts[l].feature_j].outline_of != points[l].body_j) settled[l] = 0;
    }
    for (unsigned search = mask_of(~settled); search != 0; search &= search - 1) {
        const int l = std::countr_zero(search);
        const OutlineFacing facing =
            face_outline(view.bodies, view.bodies.shape_of(points[l].body_j), parts[l].feature_j, px[l], py[l]);
        parts[l].feature_j = facing.edge;
        stage.across[l] = facing.distance;
        stage.over[l] = 0.0;
        stage.tx[l] = -facing.gy;
        stage.ty[l] = facing.gx;
    }
}

CRACKLE_INLINE void outline_batch(const OutlineStage& stage, double drift, OutlineBatch& g) {
    g.contact = outline_contact(stage.element,
                                outline_distance(stage.over != 0.0, stage.over, stage.across, stage.tx, stage.ty));
    g.motion = relative_motion(g.contact, stage.motion, drift);
}

/// Geometry of a batch of contacts between flat faces of single circles.
CRACKLE_INLINE void face_batch(const PassView& view, const BodyPair* points, const PointParts* parts, FaceBatch& g) {
    static_assert(offsetof(FlatFace, to) == offsetof(FlatFace, from) + sizeof(double));
    static_assert(offsetof(FlatFace, along_y) == offsetof(FlatFace, along_x) + sizeof(double));
    BatchBodies i, j;
    const double *ends_i[lane_count], *ends_j[lane_count], *heights_i[lane_count], *heights_j[lane_count],
        *directions[lane_count];
    Lanes sense;
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &view.bodies.state[points[l].body_i];
        j[l] = &view.bodies.state[points[l].body_j];
        const FlatFace &a = view.bodies.flat_faces[parts[l].element_i], &b = view.bodies.flat_faces[parts[l].feature_j];
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
    g.motion = relative_motion<Lanes>(g.contact, g.pair, view.drift);
}

/// Type of the geometry of a batch, for each kind of point.
template <PointKind K>
using BatchOf = std::conditional_t<K == PointKind::circle_circle, CircleBatch,
                                   std::conditional_t<K == PointKind::face_face, FaceBatch, OutlineBatch>>;

/// Computes the geometry of consecutive batches, starting at point k. @tparam Fours whether the points lie before
/// Points::fours_end
template <PointKind K, bool Fours, PointIndex Most>
CRACKLE_INLINE void geometry_batches(const PassView& view, PointIndex k, PointIndex batches,
                                     BatchOf<K> (&geometry)[Most]) {
    const BodyPair* points = view.pairs + k;
    if constexpr (K == PointKind::circle_circle) {
        const BodyState* const bodies = view.bodies.state;
        for (std::size_t n = 0; n < batches; ++n, points += lane_count) {
            BatchBodies i, j;
            for (int l = 0; l < lane_count; ++l) {
                i[l] = &bodies[points[l].body_i];
                j[l] = &bodies[points[l].body_j];
            }
            circle_batch(i, j, geometry[n]);
        }
    } else if constexpr (K == PointKind::face_face) {
        const PointParts* parts = view.parts + (k - view.circle_points);
        for (std::size_t n = 0; n < batches; ++n, points += lane_count, parts += lane_count)
            face_batch(view, points, parts, geometry[n]);
    } else {
        static_assert(K == PointKind::element_outline);
        OutlineStage stages[Most];
        const bool in_memory = view.points > points_in_cache;
        PointParts* parts = view.parts + (k - view.circle_points);
        for (std::size_t n = 0; n < batches; ++n, points += lane_count, parts += lane_count) {
            if (Fours && in_memory) prefetch_outlines(view, points, parts);
            outline_stage<Fours>(view, points, parts, Fours ? load_fours(view, points) : load_any_pairs(view, points),
                                 stages[n]);
        }
        for (PointIndex n = 0; n < batches; ++n) outline_batch(stages[n], view.drift, geometry[n]);
    }
}

/// Number of batches whose geometry is computed first, so that their square roots and divisions overlap in time.
inline constexpr PointIndex batches_ahead = 64 / lane_count;

/// Computes the geometry of the next batches of a kind, from point k to at most `end`. @param fours_end the end of the
/// points that are stored in groups of four @return the number of batches
template <PointKind K>
CRACKLE_INLINE PointIndex geometry_ahead(const PassView& view, PointIndex k, PointIndex fours_end, PointIndex end,
                                         BatchOf<K> (&geometry)[batches_ahead]) {
    const bool fours = k + lane_count <= fours_end;
    const PointIndex batches = std::min<PointIndex>(batches_ahead, ((fours ? fours_end : end) - k) / lane_count);
    if constexpr (K == PointKind::circle_circle)
        if (view.points > points_in_cache) prefetch_circles(view, k, batches * lane_count);
    if (fours)
        geometry_batches<K, true>(view, k, batches, geometry);
    else
        geometry_batches<K, false>(view, k, batches, geometry);
    return batches;
}

}  // namespace crackle
