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

/// Arms, normal and overlap of the points, and the two bodies of each.
struct BatchGeometry {
    Lanes overlap, nx, ny, aix, aiy, ajx, ajy;
};
struct BodyLanes {
    Lanes x, y, vx, vy, omega, shape0, shape1;
};

CRACKLE_INLINE void load_bodies(const BodyState* bodies, const BodyIndex (&b)[lane_count], BodyLanes& lanes) {
    Quad record[lane_count];
    Lanes first[4], second[4];
    for (int l = 0; l < lane_count; ++l) record[l] = load_as<Quad>(&bodies[b[l]].x);
    transpose_quads(record, first);
    for (int l = 0; l < lane_count; ++l) record[l] = load_as<Quad>(&bodies[b[l]].omega);
    transpose_quads(record, second);
    lanes = {first[0], first[1], first[2], first[3], second[0], second[2], second[3]};
}

/// As detail::circles_geometry() of two single circles.
CRACKLE_INLINE void circles_batch(const BodyLanes& i, const BodyLanes& j, BatchGeometry& g) {
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

/// As contact_geometry() of elements against outlines: the edge faced last is tried for all, the search is left to
/// contact_geometry.hpp where a point has got beyond it or the outline is not one convex piece.
CRACKLE_INLINE void outline_batch(const World& world, ContactPoint* points, const BodyLanes& i, const BodyLanes& j,
                                  BatchGeometry& g) {
    Quad record[lane_count];
    Lanes element[4], edge[4];  // x, y, radius, target_reach; x, y, tx, ty
    Lanes length{};
    LaneBits known{};
    for (int l = 0; l < lane_count; ++l) record[l] = load_as<Quad>(&world.elements[points[l].element_i]);
    transpose_quads(record, element);
    for (int l = 0; l < lane_count; ++l) {
        const Edge& faced = world.edges[points[l].feature_j];
        record[l] = load_as<Quad>(&faced);
        length[l] = faced.length;
        known[l] = faced.outline_of == points[l].body_j ? -1 : 0;
    }
    transpose_quads(record, edge);
    const Lanes ox = i.shape0 * element[0] - i.shape1 * element[1], oy = i.shape1 * element[0] + i.shape0 * element[1];
    const Lanes wx = (i.x - j.x) + ox, wy = (i.y - j.y) + oy;
    const Lanes px = j.shape0 * wx + j.shape1 * wy, py = j.shape0 * wy - j.shape1 * wx;
    const Lanes dx = px - edge[0], dy = py - edge[1];
    Lanes distance = dx * edge[3] - dy * edge[2];
    Lanes gx = edge[3], gy = -edge[2];
    const Lanes along = dx * edge[2] + dy * edge[3];
    const unsigned search = mask_of(~(known & (distance >= 0.0) & (along >= 0.0) & (along <= length)));
    if (search != 0) {
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
    g.overlap = element[2] + element[3] - distance;
    g.nx = -(j.shape0 * gx - j.shape1 * gy);
    g.ny = -(j.shape1 * gx + j.shape0 * gy);
    const Lanes lift = element[2] - 0.5 * g.overlap;
    g.aix = ox + lift * g.nx;
    g.aiy = oy + lift * g.ny;
    g.ajx = wx + lift * g.nx;
    g.ajy = wy + lift * g.ny;
}

/// Forces of points k to k + lane_count - 1. @return false, with no force or loss changed, where the scalar code must
/// look
template <PointKind K, bool Friction, bool Damping, bool Bonds, bool Ledger>
CRACKLE_INLINE bool force_batch(World& world, PointIndex k, World::LossBlock& loss) {
    static_assert(K == PointKind::circle_circle || K == PointKind::element_outline);
    ContactPoint* const points = world.points.data() + k;
    BodyIndex body_i[lane_count], body_j[lane_count];
    Quad record[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        body_i[l] = points[l].body_i;
        body_j[l] = points[l].body_j;
        record[l] = load_as<Quad>(&points[l].shear_force);
    }
    Lanes column[4];  // shear_force, bond_overlap, root_effective_mass, law with flags
    transpose_quads(record, column);
    const LaneBits law_and_flags = bits_of(column[3]);
    if (mask_of(((law_and_flags ^ law_and_flags[0]) & 0xffff) != 0) != 0) return false;
    const ContactLaw& law = world.laws[points[0].law];
    if (Friction && !(law.shear_stiffness > 0.0)) return false;
    const auto flagged = [&](PointFlag flag) { return (law_and_flags & (static_cast<LaneBit>(flag) << 16)) != 0; };

    BodyLanes i, j;
    load_bodies(world.bodies.data(), body_i, i);
    load_bodies(world.bodies.data(), body_j, j);
    BatchGeometry g;
    if constexpr (K == PointKind::circle_circle)
        circles_batch(i, j, g);
    else
        outline_batch(world, points, i, j, g);

    LaneBits bonded{}, holds = g.overlap > 0.0;
    if constexpr (Bonds) {
        bonded = flagged(point_bonded);
        holds = bonded ? (g.overlap > law.break_overlap) : holds;
    }
    if (mask_of(~holds & (bonded | flagged(point_touching))) != 0) return false;  // breaks or parts

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
    if constexpr (Bonds) normal -= law.normal_stiffness * column[1];
    Lanes tangential = zero;
    LaneBits sliding = holds;
    if constexpr (Friction) {
        const Lanes before = column[0], trial = before - law.shear_stiffness * (slipping * dt);
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
        const Lanes half = 0.5 * law.normal_stiffness * column[1];
        const unsigned strong = mask_of(bonded & (normal * normal + tangential * tangential >= half * half));
        if (strong != 0) {
            for (int l = 0; l < lane_count; ++l)
                if ((strong >> l & 1) != 0)
                    world.bond_history[k + static_cast<PointIndex>(l)] = {normal[l], tangential[l]};
        }
    }
    if constexpr (Damping) {
        const Lanes normal_dashpot = (law.normal_damping + law.normal_damping_ratio_term * column[2]) * closing;
        const Lanes shear_damper =
            sliding ? zero : (law.shear_damping + law.shear_damping_ratio_term * column[2]) * slipping;
        if constexpr (Ledger) {
            PointDissipation* const last = world.dissipation.data() + k;
            Lanes last_normal, last_shear;
            load_pairs(last, last_normal, last_shear);
            const Lanes lost =
                0.5 * dt * ((last_normal + normal_dashpot) * closing + (last_shear + shear_damper) * slipping);
            const Lanes counted = holds ? lost : zero;
            for (int l = 0; l < lane_count; ++l) loss.dashpot += counted[l];
            store_pairs(last, holds ? normal_dashpot : last_normal, holds ? shear_damper : last_shear);
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
