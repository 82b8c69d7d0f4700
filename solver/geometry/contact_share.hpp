// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and strength factors of a contact point for StiffnessUnits::area. With these units, a material is given by
// a modulus and by strengths in Pa.
//
// A face of length L between centroids at distance ℓ has k_n = E_c L/ℓ, T = σ_t L and C = c L (E_c, σ_t and c in Pa).
// These are divided equally among its n points: their factors are (L/ℓ)/n and L/n. The stiffness of a rock then does
// not depend on its grain size, as it would with a stiffness in Pa/m.
//
//   two circles          L = 2 min(r_i, r_j), ℓ = r_i + r_j; against a held body ℓ = r
//   flat faces           of circles across a joint: ℓ = r_i + r_j, L = 1 m; multiplied by the lap (shared length)
//   face to face         L length over which two edges face each other, measured before the mesh was inset;
//                        ℓ distance of the centroids; against a held body, distance of the centroid from its face
//   corner, never bonded L half the sum of the corner's two edges, ℓ sum of both bodies' √(area/π), 0 for a held
//                        body. Independent of the position, so that the force keeps a potential during sliding.
//
// All lengths are in m; values are per metre of thickness. Source: solver/MODEL.md 4.5; verified by
// tests/solver/geometry/contact_share_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/world/world.hpp"

namespace crackle {

/// Face length and centroid distance from which the factors of a contact point are computed.
struct ContactShare {
    double length = 0.0;    // m
    double distance = 0.0;  // m
    /// The facing edges of the two bodies, each as the index of the corner where it starts. Set by share_of_face()
    /// only.
    std::uint32_t edge_i = 0, edge_j = 0;
    /// Stiffness factor of the point: length divided by distance.
    double stiffness() const { return length / distance; }
};

/// Length and distance of a contact point that is not part of a face between two polygons (see the table at the top).
/// At a wall, the distance is the body's radius, or √(area/π) for a polygon.
ContactShare share_of_contact(const World& world, PointKind kind, const ContactPoint& point);

/// Length and distance of the face between two bodies at their current positions; at least one must be a polygon.
/// @param gap distance between the two outlines, m. The result does not depend on the order of i and j, because edges
/// are projected onto those of the body with the smaller id. @return empty if no two edges face each other
std::optional<ContactShare> share_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

}  // namespace crackle
