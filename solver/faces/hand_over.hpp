// SPDX-License-Identifier: GPL-3.0-or-later
// Where a broken face ends and the contact points between its two bodies begin.
//
// The springs of a face know two straight edges that lap. Corners that meet other edges, and edges that have turned
// far, are contact points. With q the share of the face, the energy of a pair is
//     U = q U_face + (1 - q) U_points     q = min(1, lap/(2t)) · clamp((φ₁ - |δ_φ|)/(φ₁ - φ₀), 0, 1)
// t is the thickness of segments, or half the face's length if that is less, so that neither force jumps. The shear
// springs of the points grow with their stiffness. What U changes with q at fixed places counts as friction. q is a
// factor on the pressure of the face's edges alone, so that cells with a pressure have an energy for every q; the shear
// force is within its limit.
//
// Points start without force, with a rest overlap: the rock that the face had compressed is free at its end.
//
// The points of a pair are listed only where q is less than 1 or will soon be. A face that reaches this between two
// neighbour lists asks for a new one, which comes a step later. An intact face has all of q. Source:
// solver/MODEL.md 5.5. Tested by tests/solver/faces/hand_over_test.cpp.
#pragma once

#include <functional>

#include "solver/world/world.hpp"

namespace crackle {

/// Lets new points between the bodies of faces start without force: their rest overlap is that of the present. @param
/// is_new whether a point was not in the list before
void rest_new_points(World& world, const std::function<bool(PointIndex)>& is_new);

/// Whether the face between two bodies replaces all of their contact points, and will for a while.
bool face_replaces_points(const World& world, BodyIndex i, BodyIndex j);

/// 1 - q of a broken face. @param thick thickness of segments, m
double share_of_points(const FaceSprings& springs, const BondFaceMotion& motion, double thick);

/// Finds the points between the bodies of faces in a new neighbour list, Faces::hand_over and whole_share.
void list_hand_over(World& world);

/// Sets BrokenFace::taken and the stiffness factors of the points that take over, from Faces::motion, and counts the
/// energy of the points that this changes. Call it once a force pass.
void hand_over(World& world);

}  // namespace crackle
