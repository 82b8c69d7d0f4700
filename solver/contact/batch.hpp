// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of several contact points at once, for what nearly all points do in nearly all steps: a contact or bond that
// holds, or a listed pair that does not touch. Where one of them begins to part the batch is left to the scalar code;
// both give the same bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/contact/batch_law.hpp"
#include "solver/contact/coulomb_bond.hpp"
#include "solver/contact/dashpot.hpp"
#include "solver/contact/features.hpp"
#include "solver/contact/friction.hpp"
#include "solver/contact/law.hpp"
#include "solver/contact/opening.hpp"
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

/// What the forces of batches of a kind need to know of their bodies.
template <PointKind K>
using BatchOf = std::conditional_t<K == PointKind::circle_circle, CircleBatch, OutlineBatch>;

/// Fills the geometry of batches that begin with point k. @tparam Fours they lie before Points::fours_end
template <PointKind K, bool Fours, PointIndex Most>
CRACKLE_INLINE void geometry_batches(World& world, PointIndex k, PointIndex batches, BatchOf<K> (&geometry)[Most]) {
    static_assert(K == PointKind::circle_circle || K == PointKind::element_outline);
    if constexpr (K == PointKind::circle_circle) {
        const BodyState* const bodies = world.bodies.state.data();
        const BodyPair* points = world.points.contact.pairs.data() + k;
        for (std::size_t n = 0; n < batches; ++n, points += lane_count) {
            BatchBodies i, j;
            for (int l = 0; l < lane_count; ++l) {
                i[l] = &bodies[points[l].body_i];
                j[l] = &bodies[points[l].body_j];
            }
            circle_batch(i, j, geometry[n]);
        }
    } else {
        OutlineStage stages[Most];
        const bool in_memory = world.points.size() > points_in_cache;
        const BodyPair* points = world.points.contact.pairs.data() + k;
        PointParts* parts = world.points.contact.parts.data() + (k - world.points.kind_begin[1]);
        for (std::size_t n = 0; n < batches; ++n, points += lane_count, parts += lane_count) {
            if (Fours && in_memory) prefetch_outlines(world, points, parts);
            outline_stage<Fours>(world, points, parts,
                                 Fours ? load_fours(world, points) : load_any_pairs(world, points), stages[n]);
        }
        for (PointIndex n = 0; n < batches; ++n) outline_batch(stages[n], world.stepping.drift, geometry[n]);
    }
}

/// Losses of a block of points, added up apart by the place of the point, so that lanes need not wait for each other.
/// Always eight, so that a sum does not depend on the number of lanes.
struct BlockLosses {
    static constexpr PointIndex places = 8;
    alignas(64) double dashpot[places] = {};
    double friction = 0.0, law = 0.0;
    std::uint32_t broken = 0, gained = 0;

    /// @param place of the first
    CRACKLE_INLINE void add_dashpots(PointIndex place, const Lanes& lost) {
        const PointIndex first = place % places;
        if (first + lane_count <= places) {
            store_as(dashpot + first, load_as<Lanes>(dashpot + first) + lost);
        } else {
            for (PointIndex l = 0; l < lane_count; ++l) dashpot[(first + l) % places] += lost[l];
        }
    }

    LossBlock total() const {
        double sum = 0.0;
        for (const double one : dashpot) sum += one;
        return {sum, friction, law, broken, gained};
    }
};

/// What happens to the points of a batch.
enum class BatchCase : std::uint8_t {
    all_hold,    // every point was in contact, holds, and stuck before (and is bonded, where there are bonds)
    some_hold,   // no other was in contact
    none_holds,  // nor was in contact
    one_by_one   // something breaks or parts: for the scalar code
};

/// Which points of a batch carry load, and what they were before.
struct BatchState {
    BatchCase what;
    PointState* states;
    LaneBits law_and_flags, bonded, holds;
    Lanes beyond_rest;  // m, overlap of a point without a bond beyond the one without force
};

/// Of the shear force of a bond that sticks, N.
inline constexpr double infinite_limit = std::numeric_limits<double>::infinity();

constexpr LaneBit bits_of_flags(int flags) { return static_cast<LaneBit>(flags) << 16; }

/// Whether bonds fail under their elastic forces. @param law with the points' shares
CRACKLE_INLINE LaneBits fail(const World& world, PointIndex k, const Law<Lanes>& law, const Lanes& opening,
                             const Lanes& slip) {
    const Lanes strength = load_floats(&world.points.strength_share[k]);
    const BondStrength<Lanes> bond{law.tensile_strength * strength, law.cohesion * strength, law.bond_friction};
    const Lanes normal = spring_force(law, opening);
    const Lanes shear = load_as<Lanes>(&world.points.shear_force[k]) - law.shear_stiffness * slip;
    return fails_in_tension(bond, normal) | fails_in_shear(bond, normal, shear);
}

/// The law of the points of a batch with their shares.
template <ContactFeatures F>
CRACKLE_INLINE Law<Lanes> law_of_batch(const World& world, PointIndex k, const BatchLaw& law) {
    if constexpr (F.own_shear)
        return law.law.with_shares(load_floats(&world.points.stiffness_share[k]),
                                   load_floats(&world.points.shear_root[k]));
    else if constexpr (F.own_shares)
        return law.law.with_share(load_floats(&world.points.stiffness_share[k]));
    else
        return law.law;
}

/// Whether every unbonded point of a batch that closes has been closed and surely stays so for a step more.
template <ContactFeatures F>
CRACKLE_INLINE bool none_opens(const World& world, PointIndex k, const Law<Lanes>& law, const Lanes& overlap,
                               const RelativeMotion<Lanes>& motion, const LaneBits& free) {
    const BodyPair* const points = world.points.contact.pairs.data() + k;
    const double *i[lane_count], *j[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &world.bodies.push_bound[points[l].body_i].acceleration;
        j[l] = &world.bodies.push_bound[points[l].body_j].acceleration;
    }
    Lanes acceleration_i, acceleration_j, inverse_mass_i, inverse_mass_j, dashpot{};
    gather_pairs(i, acceleration_i, inverse_mass_i);
    gather_pairs(j, acceleration_j, inverse_mass_j);
    if constexpr (F.damping) dashpot = normal_damping(law, load_as<Lanes>(&world.points.root_mass[k])) * motion.closing;
    const double step = world.stepping.time_step, kick = kick_before(world.stepping) + 0.5 * step;
    return none_of(
        free & ~stays_closed(
                   law.normal_stiffness, overlap, motion.closing, load_as<Lanes>(&world.points.last_normal[k]), dashpot,
                   PushBounds<Lanes>{acceleration_i + acceleration_j, inverse_mass_i + inverse_mass_j}, kick, step));
}

/// Changes nothing. @param k first point of the batch @param law of the batch before; left as this one's
template <ContactFeatures F, class Contact>
CRACKLE_INLINE BatchState look_at_batch(World& world, PointIndex k, const BatchGeometry<Contact>& g, BatchLaw& law) {
    constexpr int at_rest = point_touching | (F.bonds ? point_bonded | point_counted : 0);
    constexpr LaneBit of_law = 0xffff;
    constexpr LaneBit looked_at =
        of_law | bits_of_flags(at_rest | point_sliding | (F.consistent ? point_unsettled : 0));
    const Lanes& overlap = g.contact.overlap;
    PointState* const states = world.points.state.data() + k;
    const LaneBits law_and_flags = widened(states);
    LaneBits unlike = law_and_flags ^ (law.number | bits_of_flags(at_rest));
    if (!none_of(unlike & of_law)) {
        if (none_of((law_and_flags ^ law_and_flags[0]) & of_law)) {
            law.take(world, states[0].law);
        } else if (!load_laws<F>(world, states, law_and_flags & of_law, law)) {
            return {BatchCase::one_by_one, states, law_and_flags, LaneBits{}, LaneBits{}, Lanes{}};
        }
        unlike = (law_and_flags ^ bits_of_flags(at_rest)) & ~of_law;
    }
    Lanes beyond_rest = overlap;  // m, of the overlap without force
    if constexpr (F.coulomb) beyond_rest -= load_as<Lanes>(&world.points.bond_overlap[k]);
    LaneBits over = beyond_rest > 0.0;
    if constexpr (F.coulomb)
        over = ~fail(world, k, law_of_batch<F>(world, k, law), beyond_rest, g.motion.slipping * world.stepping.drift);
    else if constexpr (F.bonds)
        over = bond_holds(law.law, overlap);
    if (none_of((unlike & looked_at) | ~over)) {
        BatchCase what = BatchCase::all_hold;
        const LaneBits all_bonded = F.bonds ? over : LaneBits{};
        if constexpr (F.consistent && !F.bonds) {
            if (!none_opens<F>(world, k, law_of_batch<F>(world, k, law), overlap, g.motion, over))
                what = BatchCase::one_by_one;
        }
        return {what, states, law_and_flags, all_bonded, over, beyond_rest};
    }
    LaneBits bonded{}, holds = beyond_rest > 0.0;
    if constexpr (F.bonds) {
        bonded = (law_and_flags & bits_of_flags(point_bonded)) != 0;
        holds = bonded ? over : holds;
    }
    const LaneBits touched = (law_and_flags & bits_of_flags(point_touching)) != 0;
    BatchCase what = any(holds) ? BatchCase::some_hold : BatchCase::none_holds;
    if (any(~holds & (bonded | touched))) what = BatchCase::one_by_one;
    if constexpr (F.consistent) {
        const LaneBits free = holds & ~bonded;
        const LaneBits unsettled = (law_and_flags & bits_of_flags(point_unsettled)) != 0;
        if (any(unsettled | (free & ~touched)) ||
            (any(free) && !none_opens<F>(world, k, law_of_batch<F>(world, k, law), beyond_rest, g.motion, free)))
            what = BatchCase::one_by_one;
    }
    return {what, states, law_and_flags, bonded, holds, beyond_rest};
}

/// What points without a bond remember of a force pass, whether they close or not.
CRACKLE_INLINE void remember_overlaps(World& world, PointIndex k, const BatchState& batch) {
    LastOverlap* const last = &world.points.last_overlap[k];
    store_as(last, select(batch.bonded, load_as<Lanes>(last), batch.beyond_rest));
}

/// Forces of the points of a batch that hold, into `out`; of the others 0.
/// @tparam All BatchCase::all_hold, else some_hold @param place of the first point in its block
/// @param law with the points' shares
template <ContactFeatures F, bool All, class Contact>
CRACKLE_INLINE void force_lanes(World& world, PointIndex k, PointIndex place, const BatchGeometry<Contact>& g,
                                const Law<Lanes>& law, const BatchState& batch, PointForce* out, BlockLosses& loss) {
    const Lanes zero{};
    const auto where_held = [&](const Lanes& held, const Lanes& otherwise) -> Lanes {
        if constexpr (All)
            return held;
        else
            return select(batch.holds, held, otherwise);
    };
    const double dt = world.stepping.drift;
    Lanes normal;
    [[maybe_unused]] Lanes bond_overlap;
    if constexpr (F.bonds) bond_overlap = load_as<Lanes>(&world.points.bond_overlap[k]);
    if constexpr (F.coulomb) {
        normal = spring_force(law, g.contact.overlap - bond_overlap);
    } else {
        normal = spring_force(law, g.contact.overlap);
        if constexpr (F.bonds) normal -= spring_force(law, bond_overlap);
    }
    Lanes shear = zero;
    LaneBits sliding = batch.holds;
    if constexpr (F.friction) {
        double* const spring = &world.points.shear_force[k];
        const Lanes before = load_as<Lanes>(spring);
        Lanes limit;
        if constexpr (F.coulomb) {
            limit = law.friction * normal;
            if constexpr (All)
                limit = all_of<Lanes>(infinite_limit);
            else
                limit = select(batch.bonded, all_of<Lanes>(infinite_limit), limit);
        } else {
            limit = coulomb_limit(law, g.contact.overlap);
        }
        const ShearTrial<Lanes> trial = try_shear_within<Lanes>(law, before, g.motion.slipping * dt, limit);
        sliding = trial.slides;
        shear = trial.force;
        const LaneBits slides = sliding & batch.holds;
        if (any(slides)) shear = shear_force(trial);
        store_as(spring, where_held(shear, before));
        if (any(slides)) {
            const Lanes lost = slider_loss(law, trial, shear);
            for (int l = 0; l < lane_count; ++l) loss.friction += slides[l] != 0 ? lost[l] : 0.0;
            if constexpr (All) {
                for (int l = 0; l < lane_count; ++l)
                    if (slides[l] != 0) batch.states[l].flags |= point_sliding | point_slid;
            }
        }
    }
    if constexpr (!All) {
        LaneBits now = (batch.law_and_flags | bits_of_flags(point_touching)) & ~bits_of_flags(point_sliding);
        if constexpr (F.friction) now |= sliding & (bits_of_flags(point_sliding) | bits_of_flags(point_slid));
        if (const unsigned changed = mask_of(batch.holds & ((now ^ batch.law_and_flags) != 0)); changed != 0) {
            for (int l = 0; l < lane_count; ++l)
                if ((changed >> l & 1) != 0) batch.states[l].flags = static_cast<std::uint16_t>(now[l] >> 16);
        }
    }
    if constexpr (F.bonds && !All) {
        const unsigned uncounted = mask_of(batch.holds & ((batch.law_and_flags & bits_of_flags(point_counted)) == 0));
        loss.gained += static_cast<std::uint32_t>(__builtin_popcount(uncounted));
    }
    if constexpr (F.bonds && !F.coulomb) {
        LaneBits strong = carries_half_strength(law, normal, shear, bond_overlap);
        if constexpr (!All) strong &= batch.bonded;
        if (any(strong)) {  // rare: spares the memory of the others
            float *const strong_normal = &world.points.strong_normal[k], *const strong_shear =
                                                                             &world.points.strong_shear[k];
            store_floats(strong_normal, select(strong, normal, load_floats(strong_normal)));
            store_floats(strong_shear, select(strong, shear, load_floats(strong_shear)));
        }
    }
    if constexpr (F.damping) {
        const Lanes root_mass = load_as<Lanes>(&world.points.root_mass[k]);
        const Lanes normal_damper = normal_damping(law, root_mass) * g.motion.closing;
        const Lanes shear_damper = shear_dashpot(law, root_mass, g.motion.slipping, g.contact.overlap, sliding);
        float *const normal_memory = &world.points.normal_dashpot[k], *const shear_memory =
                                                                          &world.points.shear_dashpot[k];
        const Lanes last_normal = load_floats(normal_memory), last_shear = load_floats(shear_memory);
        const Lanes lost = dashpot_loss<Lanes>(dt, last_normal + normal_damper, g.motion.closing,
                                               last_shear + shear_damper, g.motion.slipping);
        loss.add_dashpots(place, where_held(lost, zero));
        store_floats(normal_memory, where_held(normal_damper, last_normal));
        store_floats(shear_memory, where_held(shear_damper, last_shear));
        normal += normal_damper;
        shear -= shear_damper;
    }
    if constexpr (F.consistent && !(F.bonds && All)) {
        double* const last = &world.points.last_normal[k];
        store_as(last, select(batch.bonded, load_as<Lanes>(last), where_held(normal, load_as<Lanes>(last))));
        remember_overlaps(world, k, batch);
    }
    const ForceOnBodies<Lanes> force = force_on_bodies(g.contact, normal, shear);
    store_quads(out, where_held(force.fx, zero), where_held(force.fy, zero), where_held(force.torque_i, zero),
                where_held(force.torque_j, zero));
}

}  // namespace crackle
