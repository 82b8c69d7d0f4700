// SPDX-License-Identifier: GPL-3.0-or-later
// Determines whether a contact lies across a joint, from the side of each trace on which the two bodies lie.
//
// A trace separates two bodies that have faces on opposite sides of it. They may share a mesh face on the trace, or
// meet later by sliding along it. Neighbours on the same side are not separated. The rule uses only the two bodies, so
// a contact's law depends neither on where they touch nor on when the neighbour list was built. A body between two
// parts of one trace lies on both sides of it, so the trace separates it from its neighbours on either side.
//
// A straight part of a trace separates two circles if they have flat faces on opposite sides of it (flat_faces.hpp).
//
// When bonds are made, two bodies also count as separated if one of the two edges that face each other lies on a trace.
// This is needed because a bond can connect bodies on either side of a slender cell.
// Tested by tests/solver/geometry/across_joint_test.cpp.
#pragma once

#include <cstdint>
#include <optional>

#include "solver/world/world.hpp"

namespace crackle {

inline constexpr std::int32_t no_joint = -1;

/// Trace that separates two bodies, including traces that behave like the rock, as an index into
/// Settings::trace_joints; the lowest index if several traces do.
std::optional<std::int32_t> trace_between(const World& world, BodyIndex i, BodyIndex j);

/// Trace between two adjacent bodies that are to be bonded. @param gap distance between the two outlines, m
std::optional<std::int32_t> trace_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

/// Joint along the trace that separates two bodies, as an index into Settings::joints; no_joint if there is no such
/// trace or it behaves like the rock.
std::int32_t joint_between(const World& world, BodyIndex i, BodyIndex j);

/// Joint between two adjacent bodies that are to be bonded. @param gap distance between the two outlines, m
std::int32_t joint_of_face(const World& world, BodyIndex i, BodyIndex j, double gap);

/// Joint between the two flat faces of a contact point. At a crossing of traces, two circles can have a contact point
/// across each trace.
std::int32_t joint_of_flat_faces(const World& world, const ContactPoint& point);

/// Overlap at which the force of a never-bonded contact is zero, m.
double rest_overlap_between(const World& world, BodyIndex i, BodyIndex j);

}  // namespace crackle
