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

/// Arms, normal and overlap of the points.
struct BatchGeometry {
    Lanes overlap, nx, ny, aix, aiy, ajx, ajy;
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
    g.nx = distance > 0.0 ? dx / distance : all_lanes(1.0);
    g.ny = distance > 0.0 ? dy / distance : all_lanes(0.0);
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
        const Edge* const other = faced + ((to_previous >> l & 1) != 0 ? faced->to_previous : faced->to_next);
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
    // On the corner itself the normal of the edge that begins there.
    gx = found ? (apart ? cx / to_corner : (before ? gx : ty)) : gx;
    gy = found ? (apart ? cy / to_corner : (before ? gy : -tx)) : gy;
    distance = found ? to_corner : distance;
    return found;
}

/// As contact_geometry() of elements against outlines: the edge faced last and its corners are tried for all, the
/// search is left to contact_geometry.hpp where a point has got beyond them or the outline is not one convex piece.
CRACKLE_INLINE void outline_batch(const World& world, ContactPoint* points, const PlaceLanes& i, const PlaceLanes& j,
                                  BatchGeometry& g) {
    const double *elements[lane_count], *element_reaches[lane_count], *edges[lane_count], *edge_directions[lane_count],
        *edge_lengths[lane_count], *bodies[lane_count];
    Lanes element_x, element_y, radius, target_reach, edge_x, edge_y, tx, ty, length, owner, i_and_j, unused;
    for (int l = 0; l < lane_count; ++l) {
        const Element& element = world.elements[points[l].element_i];
        const Edge& faced = world.edges[points[l].feature_j];
        elements[l] = &element.x;
        element_reaches[l] = &element.radius;
        edges[l] = &faced.x;
        edge_directions[l] = &faced.tx;
        edge_lengths[l] = &faced.length;
        bodies[l] = reinterpret_cast<const double*>(&points[l]);
    }
    gather_pairs(elements, element_x, element_y);
    gather_pairs(element_reaches, radius, target_reach);
    gather_pairs(edges, edge_x, edge_y);
    gather_pairs(edge_directions, tx, ty);
    gather_pairs(edge_lengths, length, owner);
    gather_pairs(bodies, i_and_j, unused);
    // Edge::outline_of against ContactPoint::body_j, the low and the high half of what was read.
    const LaneBits known = ((bits_of(owner) ^ (bits_of(i_and_j) >> 32)) & 0xffffffff) == 0;
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
}

/// Forces of points k to k + lane_count - 1. @return false, with no force or loss changed, where the scalar code must
/// look
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger>
CRACKLE_INLINE bool force_batch(World& world, PointIndex k, const BatchGeometry& g, World::LossBlock& loss) {
    ContactPoint* const points = world.points.data() + k;
    const BodyState* const bodies = world.bodies.data();
    BatchBodies bodies_i, bodies_j;
    const double *springs[lane_count], *laws[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        bodies_i[l] = &bodies[points[l].body_i];
        bodies_j[l] = &bodies[points[l].body_j];
        springs[l] = &points[l].shear_force;
        laws[l] = &points[l].root_effective_mass;
    }
    Lanes before, bond_overlap, root_mass, law_lanes;
    gather_pairs(springs, before, bond_overlap);
    gather_pairs(laws, root_mass, law_lanes);
    const LaneBits law_and_flags = bits_of(law_lanes);
    if (mask_of(((law_and_flags ^ law_and_flags[0]) & 0xffff) != 0) != 0) return false;
    const ContactLaw& law = world.laws[points[0].law];
    if (Friction && !(law.shear_stiffness > 0.0)) return false;
    const auto flagged = [&](PointFlag flag) { return (law_and_flags & (static_cast<LaneBit>(flag) << 16)) != 0; };

    LaneBits bonded{}, holds = g.overlap > 0.0;
    if constexpr (Bonds) {
        bonded = flagged(point_bonded);
        holds = bonded ? (g.overlap > law.break_overlap) : holds;
    }
    if (mask_of(~holds & (bonded | flagged(point_touching))) != 0) return false;  // breaks or parts

    const MotionLanes i = load_motions(bodies_i), j = load_motions(bodies_j);
    const double dt = world.drift;
    const Lanes zero{};
    const Lanes rx = (i.vx - i.omega * g.aiy) - (j.vx - j.omega * g.ajy);
    const Lanes ry = (i.vy + i.omega * g.aix) - (j.vy + j.omega * g.ajx);
    const Lanes closing = rx * g.nx + ry * g.ny;
    Lanes slipping = ry * g.nx - rx * g.ny;
    if constexpr (K != PointKind::circle_circle) {  // as in force_point()
        slipping += 0.5 * dt * i.omega * i.omega * (g.aiy * g.nx - g.aix * g.ny);
        slipping -= 0.5 * dt * j.omega * j.omega * (g.ajy * g.nx - g.ajx * g.ny);
    }

    Lanes normal = law.normal_stiffness * g.overlap;
    if constexpr (Bonds) normal -= law.normal_stiffness * bond_overlap;
    Lanes tangential = zero;
    LaneBits sliding = holds;
    if constexpr (Friction) {
        const Lanes trial = before - law.shear_stiffness * (slipping * dt);
        const Lanes squeezed = g.overlap < 0.0 ? zero : g.overlap;
        const Lanes limit = law.friction * law.normal_stiffness * squeezed;
        sliding = (magnitude(trial) > limit) | (limit <= 0.0);
        tangential = sliding ? with_sign(limit, trial) : trial;
        if (mask_of(sliding & holds) != 0) {
            if constexpr (Ledger) {
                const Lanes lost = 0.5 * (before + tangential) * (trial - tangential) / law.shear_stiffness;
                for (int l = 0; l < lane_count; ++l) loss.friction += (sliding & holds)[l] != 0 ? lost[l] : 0.0;
            }
        }
        const Lanes kept = holds ? tangential : before;
        for (int l = 0; l < lane_count; ++l) points[l].shear_force = kept[l];
    }
    constexpr auto bit_of = [](PointFlag flag) { return static_cast<LaneBit>(flag) << 16; };
    LaneBits now = (law_and_flags | bit_of(point_touching)) & ~bit_of(point_sliding);
    if constexpr (Friction) now |= sliding & (bit_of(point_sliding) | bit_of(point_slid));
    if (const unsigned changed = mask_of(holds & ((now ^ law_and_flags) != 0)); changed != 0) {
        for (int l = 0; l < lane_count; ++l)
            if ((changed >> l & 1) != 0) points[l].flags = static_cast<std::uint16_t>(now[l] >> 16);
    }
    if constexpr (Bonds) {
        const unsigned uncounted = mask_of(holds & ~flagged(point_counted));
        loss.gained += static_cast<std::uint32_t>(__builtin_popcount(uncounted));
        const Lanes half = 0.5 * law.normal_stiffness * bond_overlap;
        const LaneBits strong = bonded & (normal * normal + tangential * tangential >= half * half);
        double *const strong_normal = &world.strong_normal[k], *const strong_shear = &world.strong_shear[k];
        store_as(strong_normal, strong ? normal : load_as<Lanes>(strong_normal));
        store_as(strong_shear, strong ? tangential : load_as<Lanes>(strong_shear));
    }
    if constexpr (Damping) {
        const Lanes normal_dashpot = (law.normal_damping + law.normal_damping_ratio_term * root_mass) * closing;
        const Lanes shear_damper =
            sliding ? zero : (law.shear_damping + law.shear_damping_ratio_term * root_mass) * slipping;
        if constexpr (Ledger) {
            double *const normal_memory = &world.normal_dashpot[k], *const shear_memory = &world.shear_dashpot[k];
            const Lanes last_normal = load_as<Lanes>(normal_memory), last_shear = load_as<Lanes>(shear_memory);
            const Lanes lost =
                0.5 * dt * ((last_normal + normal_dashpot) * closing + (last_shear + shear_damper) * slipping);
            const Lanes counted = holds ? lost : zero;
            for (int l = 0; l < lane_count; ++l) loss.dashpot += counted[l];
            store_as(normal_memory, holds ? normal_dashpot : last_normal);
            store_as(shear_memory, holds ? shear_damper : last_shear);
        }
        normal += normal_dashpot;
        tangential -= shear_damper;
    }
    const Lanes fx = holds ? -normal * g.nx - tangential * g.ny : zero;
    const Lanes fy = holds ? -normal * g.ny + tangential * g.nx : zero;
    store_quads(&world.point_forces[k], fx, fy, holds ? g.aix * fy - g.aiy * fx : zero,
                holds ? g.ajy * fx - g.ajx * fy : zero);
    return true;
}

}  // namespace crackle
