// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of several contact points at once, for what nearly all points do in nearly all steps: a contact or bond that
// holds, or a listed pair that does not touch. Where one of them begins to part, or they are of different
// materials, the batch is left to the scalar code; both give the same bytes.
#pragma once

#include "solver/contact_geometry.hpp"
#include "solver/contact_law.hpp"
#include "solver/lanes.hpp"
#include "solver/world.hpp"

namespace crackle {

/// Arms, normal and overlap of the points, and how i moves against j at the contact position.
struct BatchGeometry {
    Lanes overlap, nx, ny, aix, aiy, ajx, ajy;
    Lanes closing, slipping;  // m/s, along the normal and the tangent
};
/// One body of each point.
struct PlaceLanes {
    Lanes x, y, shape0, shape1;
};
struct MotionLanes {
    Lanes vx, vy, omega;
};

using BatchBodies = const BodyState* [lane_count];

CRACKLE_INLINE PlaceLanes load_places(const BatchBodies& bodies) {
    const double* at[lane_count];
    PlaceLanes lanes;
    for (int l = 0; l < lane_count; ++l) at[l] = &bodies[l]->x;
    gather_pairs(at, lanes.x, lanes.y);
    for (int l = 0; l < lane_count; ++l) at[l] = bodies[l]->shape;
    gather_pairs(at, lanes.shape0, lanes.shape1);
    return lanes;
}

CRACKLE_INLINE MotionLanes load_motions(const BatchBodies& bodies) {
    const double* at[lane_count];
    MotionLanes lanes;
    Lanes angle;
    for (int l = 0; l < lane_count; ++l) at[l] = &bodies[l]->vx;
    gather_pairs(at, lanes.vx, lanes.vy);
    for (int l = 0; l < lane_count; ++l) at[l] = &bodies[l]->omega;
    gather_pairs(at, lanes.omega, angle);
    return lanes;
}

/// As detail::circles_geometry() of two single circles.
CRACKLE_INLINE void circles_batch(const PlaceLanes& i, const PlaceLanes& j, BatchGeometry& g) {
    const Lanes dx = (j.x - i.x) + 0.0, dy = (j.y - i.y) + 0.0;
    const Lanes distance = root(dx * dx + dy * dy);
    g.overlap = i.shape0 + j.shape0 - distance;
    const Lanes inverse = 1.0 / distance;
    g.nx = distance > 0.0 ? dx * inverse : all_lanes(1.0);
    g.ny = distance > 0.0 ? dy * inverse : all_lanes(0.0);
    const Lanes li = i.shape0 - 0.5 * g.overlap, lj = j.shape0 - 0.5 * g.overlap;
    g.aix = 0.0 + li * g.nx;
    g.aiy = 0.0 + li * g.ny;
    g.ajx = 0.0 - lj * g.nx;
    g.ajy = 0.0 - lj * g.ny;
}

/// Points beyond an end of their edge: those in the cone of the corner there, as detail::face_convex() finds them.
/// @param lanes asked for @return lanes found; only their distance and gradient are changed
CRACKLE_INLINE LaneBits corners_batch(const World& world, const ContactPoint* points, const LaneBits& asked,
                                      const LaneBits& before, const Lanes& px, const Lanes& py, const Lanes& dx,
                                      const Lanes& dy, Lanes& distance, Lanes& gx, Lanes& gy) {
    const unsigned to_previous = mask_of(before);
    const double *starts[lane_count], *directions[lane_count], *lengths[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        const Edge* const faced = &world.edges[points[l].feature_j];
        const Edge* const other = faced + faced->to_neighbour[to_previous >> l & 1];
        starts[l] = &other->x;
        directions[l] = &other->tx;
        lengths[l] = &other->length;
    }
    Lanes x, y, tx, ty, length, rest;
    gather_pairs(starts, x, y);
    gather_pairs(directions, tx, ty);
    gather_pairs(lengths, length, rest);
    const Lanes ex = px - x, ey = py - y;
    const Lanes along = ex * tx + ey * ty;
    const LaneBits found = asked & (before ? along >= length : along <= 0.0);
    const Lanes cx = before ? dx : ex, cy = before ? dy : ey;
    const Lanes to_corner = root(cx * cx + cy * cy);
    const LaneBits apart = to_corner > 0.0;
    const Lanes inverse = 1.0 / to_corner;
    // On the corner itself the normal of the edge that begins there.
    gx = found ? (apart ? cx * inverse : (before ? gx : ty)) : gx;
    gy = found ? (apart ? cy * inverse : (before ? gy : -tx)) : gy;
    distance = found ? to_corner : distance;
    return found;
}

/// As contact_geometry() of elements against outlines: the edge faced last and its corners are tried for all, the
/// search is left to contact_geometry.hpp where a point has got beyond them or the outline is not one convex piece.
CRACKLE_INLINE void outline_batch(const World& world, ContactPoint* points, const PlaceLanes& i, const PlaceLanes& j,
                                  BatchGeometry& g) {
    const double *elements[lane_count], *element_reaches[lane_count], *edges[lane_count], *edge_directions[lane_count],
        *edge_lengths[lane_count];
    Lanes element_x, element_y, radius, target_reach, edge_x, edge_y, tx, ty, length, unused;
    for (int l = 0; l < lane_count; ++l) {
        const Element& element = world.elements[points[l].element_i];
        const Edge& faced = world.edges[points[l].feature_j];
        elements[l] = &element.x;
        element_reaches[l] = &element.radius;
        edges[l] = &faced.x;
        edge_directions[l] = &faced.tx;
        edge_lengths[l] = &faced.length;
    }
    gather_pairs(elements, element_x, element_y);
    gather_pairs(element_reaches, radius, target_reach);
    gather_pairs(edges, edge_x, edge_y);
    gather_pairs(edge_directions, tx, ty);
    gather_pairs(edge_lengths, length, unused);
    // Whether the edge faced last is of an outline whose edges are all there is to face.
    LaneBits known = LaneBits{} == 0;
    if (!world.convex_outlines) {
        for (int l = 0; l < lane_count; ++l)
            known[l] = world.edges[points[l].feature_j].outline_of == points[l].body_j ? -1 : 0;
    }
    const Lanes ox = i.shape0 * element_x - i.shape1 * element_y, oy = i.shape1 * element_x + i.shape0 * element_y;
    const Lanes wx = (i.x - j.x) + ox, wy = (i.y - j.y) + oy;
    const Lanes px = j.shape0 * wx + j.shape1 * wy, py = j.shape0 * wy - j.shape1 * wx;
    const Lanes dx = px - edge_x, dy = py - edge_y;
    Lanes distance = dx * ty - dy * tx;
    Lanes gx = ty, gy = -tx;
    const Lanes along = dx * tx + dy * ty;
    const LaneBits outside = known & (distance >= 0.0), before = along<0.0, beyond = along> length;
    LaneBits settled = outside & ~(before | beyond);
    if (const LaneBits asked = outside & (before | beyond); mask_of(asked) != 0)
        settled |= corners_batch(world, points, asked, before, px, py, dx, dy, distance, gx, gy);
    if (const unsigned search = mask_of(~settled); search != 0) {
        for (int l = 0; l < lane_count; ++l) {
            if ((search >> l & 1) == 0) continue;
            ContactPoint& point = points[l];
            const OutlineFacing facing = face_outline(world, world.info[point.body_j], point.feature_j, px[l], py[l]);
            point.feature_j = facing.edge;
            distance[l] = facing.distance;
            gx[l] = facing.gx;
            gy[l] = facing.gy;
        }
    }
    g.overlap = radius + target_reach - distance;
    g.nx = -(j.shape0 * gx - j.shape1 * gy);
    g.ny = -(j.shape1 * gx + j.shape0 * gy);
    const Lanes lift = radius - 0.5 * g.overlap;
    g.aix = ox + lift * g.nx;
    g.aiy = oy + lift * g.ny;
    g.ajx = wx + lift * g.nx;
    g.ajy = wy + lift * g.ny;
}

/// Velocity of i against j at the contact position, as in force_point().
template <PointKind K>
CRACKLE_INLINE void approach_batch(const MotionLanes& i, const MotionLanes& j, double dt, BatchGeometry& g) {
    const Lanes rx = (i.vx - i.omega * g.aiy) - (j.vx - j.omega * g.ajy);
    const Lanes ry = (i.vy + i.omega * g.aix) - (j.vy + j.omega * g.ajx);
    g.closing = rx * g.nx + ry * g.ny;
    g.slipping = ry * g.nx - rx * g.ny;
    if constexpr (K != PointKind::circle_circle) {
        g.slipping += 0.5 * dt * i.omega * i.omega * (g.aiy * g.nx - g.aix * g.ny);
        g.slipping -= 0.5 * dt * j.omega * j.omega * (g.ajy * g.nx - g.ajx * g.ny);
    }
}

/// All that the forces of points k to k + lane_count - 1 need to know of their bodies.
template <PointKind K>
CRACKLE_INLINE void geometry_batch(World& world, PointIndex k, BatchGeometry& g) {
    static_assert(K == PointKind::circle_circle || K == PointKind::element_outline);
    ContactPoint* const points = world.points.data() + k;
    const BodyState* const bodies = world.bodies.data();
    BatchBodies i, j;
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &bodies[points[l].body_i];
        j[l] = &bodies[points[l].body_j];
    }
    if constexpr (K == PointKind::circle_circle)
        circles_batch(load_places(i), load_places(j), g);
    else
        outline_batch(world, points, load_places(i), load_places(j), g);
    approach_batch<K>(load_motions(i), load_motions(j), world.drift, g);
}

/// What the points of a batch have in common, and which of them carry load.
struct BatchState {
    const ContactLaw& law;
    PointState* states;
    LaneBits law_and_flags, bonded, holds;
};

/// @tparam All every point was in contact, holds, and stuck before (and is bonded, where there are bonds)
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger, bool All>
CRACKLE_INLINE void force_lanes(World& world, PointIndex k, const BatchGeometry& g, const BatchState& batch,
                                PointForce* out, World::LossBlock& loss) {
    const ContactLaw& law = batch.law;
    const Lanes zero{};
    const auto where_held = [&](const Lanes& held, const Lanes& otherwise) -> Lanes {
        if constexpr (All)
            return held;
        else
            return batch.holds ? held : otherwise;
    };
    const double dt = world.drift;
    Lanes normal = law.normal_stiffness * g.overlap;
    [[maybe_unused]] Lanes bond_overlap;
    if constexpr (Bonds) {
        bond_overlap = load_as<Lanes>(&world.bond_overlaps[k]);
        normal -= law.normal_stiffness * bond_overlap;
    }
    Lanes tangential = zero;
    LaneBits sliding = batch.holds;
    if constexpr (Friction) {
        double* const spring = &world.shear_forces[k];
        const Lanes before = load_as<Lanes>(spring);
        const Lanes trial = before - law.shear_stiffness * (g.slipping * dt);
        const Lanes squeezed = g.overlap < 0.0 ? zero : g.overlap;
        const Lanes limit = law.friction * law.normal_stiffness * squeezed;
        sliding = (magnitude(trial) > limit) | (limit <= 0.0);
        tangential = sliding ? with_sign(limit, trial) : trial;
        store_as(spring, where_held(tangential, before));
        if (const LaneBits slides = sliding & batch.holds; mask_of(slides) != 0) {
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
        const Lanes half = 0.5 * law.normal_stiffness * bond_overlap;
        LaneBits strong = normal * normal + tangential * tangential >= half * half;
        if constexpr (!All) strong &= batch.bonded;
        if (mask_of(strong) != 0) {  // rare: spares the memory of the others
            double *const strong_normal = &world.strong_normal[k], *const strong_shear = &world.strong_shear[k];
            store_as(strong_normal, strong ? normal : load_as<Lanes>(strong_normal));
            store_as(strong_shear, strong ? tangential : load_as<Lanes>(strong_shear));
        }
    }
    if constexpr (Damping) {
        const Lanes root_mass = load_as<Lanes>(&world.root_masses[k]);
        const Lanes normal_dashpot = (law.normal_damping + law.normal_damping_ratio_term * root_mass) * g.closing;
        const Lanes shear_damper =
            sliding ? zero : (law.shear_damping + law.shear_damping_ratio_term * root_mass) * g.slipping;
        if constexpr (Ledger) {
            double *const normal_memory = &world.normal_dashpot[k], *const shear_memory = &world.shear_dashpot[k];
            const Lanes last_normal = load_as<Lanes>(normal_memory), last_shear = load_as<Lanes>(shear_memory);
            const Lanes lost =
                0.5 * dt * ((last_normal + normal_dashpot) * g.closing + (last_shear + shear_damper) * g.slipping);
            const Lanes counted = where_held(lost, zero);
            for (int l = 0; l < lane_count; ++l) loss.dashpot += counted[l];
            store_as(normal_memory, where_held(normal_dashpot, last_normal));
            store_as(shear_memory, where_held(shear_damper, last_shear));
        }
        normal += normal_dashpot;
        tangential -= shear_damper;
    }
    const Lanes fx = where_held(-normal * g.nx - tangential * g.ny, zero);
    const Lanes fy = where_held(-normal * g.ny + tangential * g.nx, zero);
    store_quads(out, fx, fy, where_held(g.aix * fy - g.aiy * fx, zero), where_held(g.ajy * fx - g.ajx * fy, zero));
}

/// Forces of points k to k + lane_count - 1, into `out`. @return false, with no force or loss changed, where the scalar
/// code must look
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger>
CRACKLE_INLINE bool force_batch(World& world, PointIndex k, const BatchGeometry& g, PointForce* out,
                                World::LossBlock& loss) {
    constexpr auto bit_of = [](int flags) { return static_cast<LaneBit>(flags) << 16; };
    constexpr LaneBit of_law = 0xffff;
    PointState* const states = world.point_states.data() + k;
    const LaneBits law_and_flags = widened(states);
    if (!none_of((law_and_flags ^ law_and_flags[0]) & of_law)) return false;
    const ContactLaw& law = world.laws[states[0].law];
    if (Friction && !(law.shear_stiffness > 0.0)) return false;
    constexpr int at_rest = point_touching | (Bonds ? point_bonded | point_counted : 0);
    const double least = Bonds ? law.break_overlap : 0.0;
    const LaneBits over = g.overlap > least;
    constexpr LaneBit looked_at = bit_of(at_rest | point_sliding);
    if (none_of((law_and_flags & looked_at) ^ bit_of(at_rest)) && mask_of(~over) == 0) {
        force_lanes<K, Friction, Damping, Bonds, Ledger, true>(world, k, g, {law, states, law_and_flags, over, over},
                                                               out, loss);
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
    force_lanes<K, Friction, Damping, Bonds, Ledger, false>(world, k, g, {law, states, law_and_flags, bonded, holds},
                                                            out, loss);
    return true;
}

}  // namespace crackle
