// SPDX-License-Identifier: GPL-3.0-or-later
// Which contacts are across a joint, from the sides of traces that bodies lie on.
//
// Two bodies are parted by a trace where each has a face on it, on opposite sides: so are those that a face of the mesh
// on the trace was between, and those that come to meet as they slide along it. Neighbours on one side are not. What is
// asked is of the two bodies alone, so that a contact's law depends neither on where it touches nor on when the
// neighbour list was built. A body between two parts of one trace lies on both its sides, and so its neighbours do.
//
// Circles are parted by a straight part of a trace on opposite sides of which they have flat faces (flat_faces.hpp).
//
// When bonds are made two bodies are parted also where either of the faces that they turn to each other lies on a
// trace: slender cells let others reach past them.
// Tested by tests/solver/geometry/across_joint_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/world/world.hpp"

namespace crackle {

inline constexpr std::int32_t no_joint = -1;

/// Of the traces that part two bodies the first, whatever its mechanics. Into Settings::trace_joints.
std::optional<std::int32_t> trace_between(const World& world, BodyIndex i, BodyIndex j);

/// The same of two bodies that lie against each other. @param gap between them, m
std::optional<std::int32_t> trace_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

/// Of the trace that parts two bodies, of several the first; no_joint where none does, or one that is as the rock.
/// Into Settings::joints.
std::int32_t joint_between(const World& world, BodyIndex i, BodyIndex j);

/// The same of two bodies that lie against each other to be bonded. @param gap between them, m
std::int32_t joint_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

/// Of two flat faces, the same: circles at a crossing have points across both traces.
std::int32_t joint_of_flat_faces(const World& world, const ContactPoint& point);

/// m, of a contact that was never bonded: the overlap without force.
double rest_overlap_between(const World& world, BodyIndex i, BodyIndex j);

}  // namespace crackle
