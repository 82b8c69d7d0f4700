// SPDX-License-Identifier: GPL-3.0-or-later
// Gradual replacement of a broken face by the contact points between its two bodies.
//
// The springs of a face describe two straight edges that lie opposite each other over a length, the lap. Corners that
// meet other edges, and edges that have rotated too far, are treated by contact points instead. With q the share of the
// face, the energy of a pair of bodies is
//     U = q U_face + (1 - q) U_points     q = min(1, lap/(2t)) · clamp((φ₁ - |δ_φ|)/(φ₁ - φ₀), 0, 1)
// δ_φ is the relative rotation. t is the thickness of segments, or half the face's length if that is less. As q is
// continuous, so are the forces of the face and of the points. The shear force of a contact point is scaled with its
// stiffness. A change of U that is due to q alone counts as friction loss. Of the face's forces, q multiplies only
// those with which its two edges press on each other, so that the pressures of the cells still derive from an energy.
// The shear force of the face remains within its Coulomb limit.
//
// Once q is 0, the face is retired, and the points keep all the force. It returns only when its two edges lie opposite
// each other at a distance of more than t. The edges of bodies that have moved past each other would otherwise seem to
// overlap by as much as a body's size as soon as their lap grows again.
//
// Contact points start without force: their rest overlap is the overlap at that time, because the rock that the face
// compressed is unloaded when the face is removed.
//
// The neighbour list contains the points of a pair only if q is less than 1 or soon will be. If q falls below 1 before
// the points are listed, the list is rebuilt, one step later. The q of an intact face is 1. Source: solver/MODEL.md
// 5.5. Tested by tests/solver/faces/hand_over_test.cpp.
#pragma once

#include <functional>

#include "solver/world/world.hpp"

namespace crackle {

/// Sets the rest overlap of new contact points between bodies with a common face to the current overlap, so that they
/// start without force. @param is_new returns whether a point was missing in the previous list
void rest_new_points(World& world, const std::function<bool(PointIndex)>& is_new);

/// Whether the two bodies have a common face and need no contact points, either now or after a small further motion.
bool face_replaces_points(const World& world, BodyIndex i, BodyIndex j);

/// Weight 1 - q of the contact points that replace a broken face. @param thick thickness of segments, m
double share_of_points(const FaceSprings& springs, const BondFaceMotion& motion, double thick);

/// After a rebuild of the neighbour list, finds the contact points between bodies with a common face, and sets
/// Faces::hand_over and whole_share.
void list_hand_over(World& world);

/// Computes BrokenFace::taken from Faces::motion, and sets the stiffness factors of the contact points that replace
/// broken faces. The resulting energy loss of the points counts as friction. Call this once per force pass.
void hand_over(World& world);

}  // namespace crackle
