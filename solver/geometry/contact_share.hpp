// SPDX-License-Identifier: GPL-3.0-or-later
// What a contact point has of a material's contact modulus and strengths in StiffnessUnits::area.
//
// A face of length L between centroids at the distance ℓ has k_n = E_c L/ℓ, T = σ_t L and C = c L (E_c, σ_t and c in
// Pa), shared equally by its points: their shares are (L/ℓ)/n and L/n. The stiffness of a rock then does not depend on
// the size of its grains; with a stiffness in Pa/m it would fall with it.
//
//   two circles          L = 2 min(r_i, r_j), ℓ = r_i + r_j; against a body that is held ℓ = r
//   flat faces           of circles across a joint: ℓ = r_i + r_j, L a metre; times the length over which they lap
//   face to face         L the part in which two outset edges face each other: the edges before the mesh was inset;
//                        ℓ the distance of the centroids, against a body that is held from its face
//   corner, later met    L half the two edges that meet in it, ℓ = the sum of both bodies' √(area/π); of a body that is
//                        held nothing. Of the two bodies alone, so that the force keeps a potential while they slide.
//
// All in m, per metre of thickness. Source: solver/MODEL.md 4.5; verified by
// tests/solver/geometry/contact_share_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/world/world.hpp"

namespace crackle {

struct ContactShare {
    double length = 0.0;                   // m
    double distance = 0.0;                 // m
    std::uint32_t edge_i = 0, edge_j = 0;  ///< of a face: the two bodies' edges, by the corners they begin at
    double stiffness() const { return length / distance; }
};

/// Of a point whose bodies meet without having been bonded; walls have the distance of the body's centroid.
ContactShare share_of_contact(const World& world, PointKind kind, const ContactPoint& point);

/// Of the face between two bodies at least one of which is a polygon, as they lie. @param gap between the two
/// outlines, m. The same for both orders: edges are laid over those of the body with the smaller id. @return nothing
/// where no two edges face each other
std::optional<ContactShare> share_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

}  // namespace crackle
