// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of several contact points at once, for what nearly all points do in nearly all steps: a contact or bond that
// holds, or a listed pair that does not touch. Where one of them begins to part, or they are of different
// materials, the batch is left to the scalar code; both give the same bytes.
#pragma once

#include <cstddef>

#include "solver/contact/geometry.hpp"
#include "solver/contact/lanes.hpp"
#include "solver/contact/law.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Overlap and normal of the points, how i moves against j at the contact position, and the arms there: of outlines
/// about both centroids, of single circles, whose arms lie along the normal, their lengths in aix and ajx.
struct BatchGeometry {
    Lanes overlap, nx, ny, aix, aiy, ajx, ajy;
    Lanes closing, slipping;  // m/s, along the normal and the tangent
};

using BatchBodies = const BodyState* [lane_count];

/// Two numbers that lie side by side, of each body of a batch. @param first of them
CRACKLE_INLINE void load_pairs(const BatchBodies& bodies, double BodyState::*first, Lanes& a, Lanes& b) {
    const double* at[lane_count];
    for (int l = 0; l < lane_count; ++l) at[l] = &(bodies[l]->*first);
    gather_pairs(at, a, b);
}

/// As circles_geometry() of two single circles, and their approach as in force_point().
CRACKLE_INLINE void circles_batch(const BatchBodies& i, const BatchBodies& j, BatchGeometry& g) {
    static_assert(offsetof(BodyState, shape) == offsetof(BodyState, omega) + sizeof(double));
    Lanes ix, iy, jx, jy, ivx, ivy, jvx, jvy, spin_i, spin_j, radius_i, radius_j;
    load_pairs(i, &BodyState::x, ix, iy);
    load_pairs(j, &BodyState::x, jx, jy);
    load_pairs(i, &BodyState::omega, spin_i, radius_i);
    load_pairs(j, &BodyState::omega, spin_j, radius_j);
    const Lanes dx = jx - ix, dy = jy - iy;
    const Lanes squared = dx * dx + dy * dy, distance = root(squared), inverse = distance * (1.0 / squared);
    const LaneBits apart = squared >= least_squared_distance;
    g.overlap = radius_i + radius_j - distance;
    g.nx = apart ? dx * inverse : all_lanes(1.0);
    g.ny = apart ? dy * inverse : Lanes{};
    g.aix = radius_i - 0.5 * g.overlap;
    g.ajx = radius_j - 0.5 * g.overlap;
    load_pairs(i, &BodyState::vx, ivx, ivy);
    load_pairs(j, &BodyState::vx, jvx, jvy);
    const Lanes rx = ivx - jvx, ry = ivy - jvy;
    g.closing = rx * g.nx + ry * g.ny;
    g.slipping = (ry * g.nx - rx * g.ny) + (spin_i * g.aix + spin_j * g.ajx);
}

/// The two bodies of each point of element_outline.
struct PairLanes {
    Lanes dx, dy, dvx, dvy;  // of i against j
    Lanes spin_i, spin_j, cosine_i, sine_i, cosine_j, sine_j;
};

CRACKLE_INLINE PairLanes load_any_pairs(const World& world, const ContactPoint* points) {
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
    pair.dvx = ix - jx, pair.dvy = iy - jy;
    load_pairs(i, &BodyState::omega, pair.spin_i, pair.cosine_i);
    load_pairs(j, &BodyState::omega, pair.spin_j, pair.cosine_j);
    const double *sine_i[lane_count], *sine_j[lane_count];
    for (int l = 0; l < lane_count; ++l) sine_i[l] = i[l]->shape + 1, sine_j[l] = j[l]->shape + 1;
    gather_pairs(sine_i, pair.sine_i, unused);
    gather_pairs(sine_j, pair.sine_j, unused);
    return pair;
}

/// Of points that lie in fours, those whose body_i is not that of the first.
CRACKLE_INLINE LaneBits swapped_lanes(const ContactPoint* points) {
    typedef std::int32_t Words __attribute__((vector_size(4 * lane_count)));
    Words owners, firsts;
    for (int l = 0; l < lane_count; ++l) {
        owners[l] = static_cast<std::int32_t>(points[l].body_i);
        firsts[l] = static_cast<std::int32_t>(points[l & ~3].body_i);
    }
    return __builtin_convertvector(owners != firsts, LaneBits);
}

/// The same where the points lie in fours between two bodies each, which are loaded once.
CRACKLE_INLINE PairLanes load_fours(const World& world, const ContactPoint* points) {
    constexpr std::size_t fours = lane_count / 4;
    const BodyState *a[fours], *b[fours];
    for (std::size_t f = 0; f < fours; ++f) {
        const ContactPoint* const four = points + 4 * f;
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
    pair.dvx = difference(&BodyState::vx), pair.dvy = difference(&BodyState::vy);
    either([](const BodyState& body) { return body.omega; }, pair.spin_i, pair.spin_j);
    either([](const BodyState& body) { return body.shape[0]; }, pair.cosine_i, pair.cosine_j);
    either([](const BodyState& body) { return body.shape[1]; }, pair.sine_i, pair.sine_j);
    return pair;
}

/// What is known of points of element_outline before the roots: kernels do this for many batches, then the roots for
/// all of these, for one batch is a chain of calculations that the processor would wait for.
struct OutlineStage {
    Lanes ox, oy;        // m, the element from i's centroid
    Lanes wx, wy;        // m, from j's
    Lanes radius;        // m, of the element
    Lanes cover;         // m, distance at which the overlap begins
    Lanes across;        // m, in front of the line of the edge faced
    Lanes over;          // m, beyond an end of it; 0: faces the edge itself
    Lanes tx, ty;        // direction of the edge, body frame of j
    Lanes cosine, sine;  // of j
    Lanes dvx, dvy, spin_i, spin_j;
};

/// What points that come later look at. In a mesh beyond the caches it comes from memory, from places that only the
/// points tell: a sixth of the step of 50,000 cells.
CRACKLE_INLINE void prefetch_outlines(const World& world, const ContactPoint* points) {
    constexpr std::ptrdiff_t points_ahead = 128;
    if (world.points.contact.data() + world.points.fours_end - points < points_ahead + lane_count) return;
    const ContactPoint* const later = points + points_ahead;
    for (int l = 0; l < lane_count; ++l) __builtin_prefetch(&world.bodies.edges[later[l].feature_j]);
    for (int l = 0; l < lane_count; l += 2) __builtin_prefetch(&world.bodies.elements[later[l].element_i]);
    for (int l = 0; l < lane_count; l += 4) {
        __builtin_prefetch(&world.bodies.state[later[l].body_i]);
        __builtin_prefetch(&world.bodies.state[later[l].body_j]);
    }
}

/// Points of outlines beyond which a mesh is taken to be larger than the caches: some 8 MB.
inline constexpr std::size_t points_in_cache = 50'000;

/// The edge faced last and its corners are tried for all points; the search is left to contact_geometry.hpp where one
/// has got beyond them or the outline is not one convex piece.
CRACKLE_INLINE void outline_stage(const World& world, ContactPoint* points, const PairLanes& pair,
                                  OutlineStage& stage) {
    static_assert(offsetof(Edge, cone) == offsetof(Edge, length) + sizeof(double));
    const double *elements[lane_count], *element_reaches[lane_count], *edges[lane_count], *edge_directions[lane_count],
        *edge_lengths[lane_count], *edge_ends[lane_count];
    Lanes element_x, element_y, target_reach, edge_x, edge_y, tx, ty, length, cone_before, cone_beyond, unused;
    for (int l = 0; l < lane_count; ++l) {
        const Element& element = world.bodies.elements[points[l].element_i];
        const Edge& faced = world.bodies.edges[points[l].feature_j];
        elements[l] = &element.x;
        element_reaches[l] = &element.radius;
        edges[l] = &faced.x;
        edge_directions[l] = &faced.tx;
        edge_lengths[l] = &faced.length;
        edge_ends[l] = &faced.cone[1];
    }
    gather_pairs(elements, element_x, element_y);
    gather_pairs(element_reaches, stage.radius, target_reach);
    stage.cover = stage.radius + target_reach;
    gather_pairs(edges, edge_x, edge_y);
    gather_pairs(edge_directions, tx, ty);
    gather_pairs(edge_lengths, length, cone_before);
    gather_pairs(edge_ends, cone_beyond, unused);
    stage.ox = pair.cosine_i * element_x - pair.sine_i * element_y;
    stage.oy = pair.sine_i * element_x + pair.cosine_i * element_y;
    const Lanes wx = stage.wx = pair.dx + stage.ox, wy = stage.wy = pair.dy + stage.oy;
    const Lanes px = pair.cosine_j * wx + pair.sine_j * wy, py = pair.cosine_j * wy - pair.sine_j * wx;
    const Lanes dx = px - edge_x, dy = py - edge_y;
    const Lanes across = dx * ty - dy * tx, along = dx * tx + dy * ty;
    const LaneBits before = along<0.0, beyond = along> length;
    const Lanes over = before ? along : (beyond ? along - length : Lanes{});
    LaneBits settled = (across >= 0.0) & (across + over * (before ? cone_before : cone_beyond) >= 0.0);
    stage.across = across;
    stage.over = over;
    stage.tx = tx, stage.ty = ty;
    stage.cosine = pair.cosine_j, stage.sine = pair.sine_j;
    stage.dvx = pair.dvx, stage.dvy = pair.dvy;
    stage.spin_i = pair.spin_i, stage.spin_j = pair.spin_j;
    // Whether the edge faced last is of an outline whose edges are all there is to face.
    if (!world.bodies.convex_outlines) {
        for (int l = 0; l < lane_count; ++l)
            if (world.bodies.edges[points[l].feature_j].outline_of != points[l].body_j) settled[l] = 0;
    }
    if (const unsigned search = mask_of(~settled); search != 0) {
        for (int l = 0; l < lane_count; ++l) {
            if ((search >> l & 1) == 0) continue;
            ContactPoint& point = points[l];
            const OutlineFacing facing =
                face_outline(world, world.bodies.info[point.body_j], point.feature_j, px[l], py[l]);
            point.feature_j = facing.edge;
            stage.across[l] = facing.distance;
            stage.over[l] = 0.0;
            stage.tx[l] = -facing.gy;
            stage.ty[l] = facing.gx;
        }
    }
}

/// As contact_geometry() of elements against outlines, and their approach as in force_point().
CRACKLE_INLINE void outline_batch(const OutlineStage& stage, double drift, BatchGeometry& g) {
    const LaneBits at_corner = stage.over != 0.0;
    const Lanes squared = stage.over * stage.over + stage.across * stage.across;
    const Lanes to_corner = root(squared), inverse = to_corner * (1.0 / squared);
    const LaneBits apart = at_corner & (squared >= least_squared_distance);
    const Lanes a = stage.over * inverse, out = stage.across * inverse;
    const Lanes gx = apart ? a * stage.tx + out * stage.ty : stage.ty;
    const Lanes gy = apart ? a * stage.ty - out * stage.tx : -stage.tx;
    g.overlap = stage.cover - (at_corner ? to_corner : stage.across);
    g.nx = stage.sine * gy - stage.cosine * gx;
    g.ny = -(stage.sine * gx + stage.cosine * gy);
    const Lanes lift = stage.radius - 0.5 * g.overlap;
    const Lanes lift_x = lift * g.nx, lift_y = lift * g.ny;
    g.aix = stage.ox + lift_x;
    g.aiy = stage.oy + lift_y;
    g.ajx = stage.wx + lift_x;
    g.ajy = stage.wy + lift_y;
    const Lanes rx = stage.dvx - (stage.spin_i * g.aiy - stage.spin_j * g.ajy);
    const Lanes ry = stage.dvy + (stage.spin_i * g.aix - stage.spin_j * g.ajx);
    g.closing = rx * g.nx + ry * g.ny;
    g.slipping = ry * g.nx - rx * g.ny;
    const double half = 0.5 * drift;
    g.slipping += half * stage.spin_i * stage.spin_i * (g.aiy * g.nx - g.aix * g.ny);
    g.slipping -= half * stage.spin_j * stage.spin_j * (g.ajy * g.nx - g.ajx * g.ny);
}

/// All that the forces of some batches of points need to know of their bodies.
/// @tparam Fours they lie before World::fours_end
template <PointKind K, bool Fours, PointIndex Most>
CRACKLE_INLINE void geometry_batches(World& world, PointIndex k, PointIndex batches, BatchGeometry (&geometry)[Most]) {
    static_assert(K == PointKind::circle_circle || K == PointKind::element_outline);
    if constexpr (K == PointKind::circle_circle) {
        const BodyState* const bodies = world.bodies.state.data();
        for (std::size_t n = 0; n < batches; ++n) {
            const ContactPoint* const points = world.points.contact.data() + k + n * lane_count;
            BatchBodies i, j;
            for (int l = 0; l < lane_count; ++l) {
                i[l] = &bodies[points[l].body_i];
                j[l] = &bodies[points[l].body_j];
            }
            circles_batch(i, j, geometry[n]);
        }
    } else {
        OutlineStage stages[Most];
        const bool in_memory = world.points.size() > points_in_cache;
        for (std::size_t n = 0; n < batches; ++n) {
            ContactPoint* const points = world.points.contact.data() + k + n * lane_count;
            if (Fours && in_memory) prefetch_outlines(world, points);
            outline_stage(world, points, Fours ? load_fours(world, points) : load_any_pairs(world, points), stages[n]);
        }
        for (PointIndex n = 0; n < batches; ++n) outline_batch(stages[n], world.stepping.drift, geometry[n]);
    }
}

/// Law of a batch, each number in all lanes, where kernels have them at hand.
struct LawLanes {
    LawLanes(const World& world, std::uint16_t of_law) : LawLanes(world.settings.laws[of_law], of_law) {}

    Lanes normal_stiffness, shear_stiffness, normal_damping, shear_damping, normal_damping_ratio_term,
        shear_damping_ratio_term;
    Lanes limit_stiffness;  // N/m: Coulomb's limit over the overlap
    Lanes half_stiffness;
    Lanes break_overlap;
    LaneBit number;  // into World::laws
    bool shears;     // has a shear spring

  private:
    LawLanes(const ContactLaw& law, std::uint16_t of_law)
        : normal_stiffness(all_lanes(law.normal_stiffness)),
          shear_stiffness(all_lanes(law.shear_stiffness)),
          normal_damping(all_lanes(law.normal_damping)),
          shear_damping(all_lanes(law.shear_damping)),
          normal_damping_ratio_term(all_lanes(law.normal_damping_ratio_term)),
          shear_damping_ratio_term(all_lanes(law.shear_damping_ratio_term)),
          limit_stiffness(all_lanes(law.friction * law.normal_stiffness)),
          half_stiffness(all_lanes(0.5 * law.normal_stiffness)),
          break_overlap(all_lanes(law.break_overlap)),
          number(of_law),
          shears(law.shear_stiffness > 0.0) {}
};

/// Losses of a block of points, added up apart by the place of the point, so that lanes need not wait for each other.
/// Always eight, so that a sum does not depend on the number of lanes.
struct BlockLosses {
    static constexpr PointIndex places = 8;
    alignas(64) double dashpot[places] = {};
    double friction = 0.0, law = 0.0;
    std::uint32_t broken = 0, gained = 0;

    /// @param place of the first, a multiple of four
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

/// Which points of a batch carry load, and what they were before.
struct BatchState {
    PointState* states;
    LaneBits law_and_flags, bonded, holds;
};

/// @tparam All every point was in contact, holds, and stuck before (and is bonded, where there are bonds)
/// @param place of the first point in its block
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger, bool All>
CRACKLE_INLINE void force_lanes(World& world, PointIndex k, PointIndex place, const BatchGeometry& g,
                                const LawLanes& law, const BatchState& batch, PointForce* out, BlockLosses& loss) {
    const Lanes zero{};
    const auto where_held = [&](const Lanes& held, const Lanes& otherwise) -> Lanes {
        if constexpr (All)
            return held;
        else
            return batch.holds ? held : otherwise;
    };
    const double dt = world.stepping.drift;
    Lanes normal = law.normal_stiffness * g.overlap;
    [[maybe_unused]] Lanes bond_overlap;
    if constexpr (Bonds) {
        bond_overlap = load_as<Lanes>(&world.points.bond_overlap[k]);
        normal -= law.normal_stiffness * bond_overlap;
    }
    Lanes tangential = zero;
    LaneBits sliding = batch.holds;
    if constexpr (Friction) {
        double* const spring = &world.points.shear_force[k];
        const Lanes before = load_as<Lanes>(spring);
        const Lanes trial = before - law.shear_stiffness * (g.slipping * dt);
        const Lanes squeezed = g.overlap < 0.0 ? zero : g.overlap;
        const Lanes limit = law.limit_stiffness * squeezed;
        sliding = (magnitude(trial) > limit) | (limit <= 0.0);
        tangential = trial;
        const LaneBits slides = sliding & batch.holds;
        if (mask_of(slides) == 0) {
            store_as(spring, where_held(trial, before));
        } else {
            tangential = sliding ? with_sign(limit, trial) : trial;
            store_as(spring, where_held(tangential, before));
            if constexpr (Ledger) {
                const Lanes lost = 0.5 * (before + tangential) * (trial - tangential) / law.shear_stiffness;
                for (int l = 0; l < lane_count; ++l) loss.friction += slides[l] != 0 ? lost[l] : 0.0;
            }
            if constexpr (All) {
                for (int l = 0; l < lane_count; ++l)
                    if (slides[l] != 0) batch.states[l].flags |= point_sliding | point_slid;
            }
        }
    }
    if constexpr (!All) {
        constexpr auto bit_of = [](PointFlag flag) { return static_cast<LaneBit>(flag) << 16; };
        LaneBits now = (batch.law_and_flags | bit_of(point_touching)) & ~bit_of(point_sliding);
        if constexpr (Friction) now |= sliding & (bit_of(point_sliding) | bit_of(point_slid));
        if (const unsigned changed = mask_of(batch.holds & ((now ^ batch.law_and_flags) != 0)); changed != 0) {
            for (int l = 0; l < lane_count; ++l)
                if ((changed >> l & 1) != 0) batch.states[l].flags = static_cast<std::uint16_t>(now[l] >> 16);
        }
    }
    if constexpr (Bonds) {
        if constexpr (!All) {
            constexpr LaneBit counted = static_cast<LaneBit>(point_counted) << 16;
            const unsigned uncounted = mask_of(batch.holds & ((batch.law_and_flags & counted) == 0));
            loss.gained += static_cast<std::uint32_t>(__builtin_popcount(uncounted));
        }
        const Lanes half = law.half_stiffness * bond_overlap;
        LaneBits strong = normal * normal + tangential * tangential >= half * half;
        if constexpr (!All) strong &= batch.bonded;
        if (mask_of(strong) != 0) {  // rare: spares the memory of the others
            float *const strong_normal = &world.points.strong_normal[k], *const strong_shear =
                                                                             &world.points.strong_shear[k];
            store_floats(strong_normal, strong ? normal : load_floats(strong_normal));
            store_floats(strong_shear, strong ? tangential : load_floats(strong_shear));
        }
    }
    if constexpr (Damping) {
        const Lanes root_mass = load_as<Lanes>(&world.points.root_mass[k]);
        const Lanes normal_dashpot = (law.normal_damping + law.normal_damping_ratio_term * root_mass) * g.closing;
        const Lanes shear_damper =
            sliding ? zero : (law.shear_damping + law.shear_damping_ratio_term * root_mass) * g.slipping;
        if constexpr (Ledger) {
            float *const normal_memory = &world.points.normal_dashpot[k], *const shear_memory =
                                                                              &world.points.shear_dashpot[k];
            const Lanes last_normal = load_floats(normal_memory), last_shear = load_floats(shear_memory);
            const Lanes lost =
                0.5 * dt * ((last_normal + normal_dashpot) * g.closing + (last_shear + shear_damper) * g.slipping);
            loss.add_dashpots(place, where_held(lost, zero));
            store_floats(normal_memory, where_held(normal_dashpot, last_normal));
            store_floats(shear_memory, where_held(shear_damper, last_shear));
        }
        normal += normal_dashpot;
        tangential -= shear_damper;
    }
    const Lanes fx = where_held(-normal * g.nx - tangential * g.ny, zero);
    const Lanes fy = where_held(-normal * g.ny + tangential * g.nx, zero);
    Lanes torque_i, torque_j;
    if constexpr (K == PointKind::circle_circle) {
        torque_i = g.aix * tangential;
        torque_j = g.ajx * tangential;
    } else {
        torque_i = g.aix * fy - g.aiy * fx;
        torque_j = g.ajy * fx - g.ajx * fy;
    }
    store_quads(out, fx, fy, where_held(torque_i, zero), where_held(torque_j, zero));
}

/// Forces of points k to k + lane_count - 1, into `out`. @param place of the first in its block @param law of the batch
/// before; left as this one's @return false, with no force or loss changed, where the scalar code must look
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger>
CRACKLE_INLINE bool force_batch(World& world, PointIndex k, PointIndex place, const BatchGeometry& g, LawLanes& law,
                                PointForce* out, BlockLosses& loss) {
    constexpr auto bit_of = [](int flags) { return static_cast<LaneBit>(flags) << 16; };
    constexpr int at_rest = point_touching | (Bonds ? point_bonded | point_counted : 0);
    constexpr LaneBit of_law = 0xffff, looked_at = of_law | bit_of(at_rest | point_sliding);
    PointState* const states = world.points.state.data() + k;
    const LaneBits law_and_flags = widened(states);
    LaneBits unlike = law_and_flags ^ (law.number | bit_of(at_rest));
    if (!none_of(unlike & of_law)) {
        if (!none_of((law_and_flags ^ law_and_flags[0]) & of_law)) return false;
        law = LawLanes(world, states[0].law);
        unlike = law_and_flags ^ (law.number | bit_of(at_rest));
    }
    if (Friction && !law.shears) return false;
    const LaneBits over = g.overlap > (Bonds ? law.break_overlap : Lanes{});
    if (none_of((unlike & looked_at) | ~over)) {
        force_lanes<K, Friction, Damping, Bonds, Ledger, true>(world, k, place, g, law,
                                                               {states, law_and_flags, over, over}, out, loss);
        return true;
    }
    LaneBits bonded{}, holds = g.overlap > 0.0;
    if constexpr (Bonds) {
        bonded = (law_and_flags & bit_of(point_bonded)) != 0;
        holds = bonded ? over : holds;
    }
    const LaneBits held_before = bonded | ((law_and_flags & bit_of(point_touching)) != 0);
    if (mask_of(~holds & held_before) != 0) return false;  // breaks or parts
    if (mask_of(holds) == 0) {
        store_quads(out, Lanes{}, Lanes{}, Lanes{}, Lanes{});
        return true;
    }
    force_lanes<K, Friction, Damping, Bonds, Ledger, false>(world, k, place, g, law,
                                                            {states, law_and_flags, bonded, holds}, out, loss);
    return true;
}

}  // namespace crackle
