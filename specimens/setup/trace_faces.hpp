// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a specimen that lie on joint traces, and their motion since loading began.
//
// Each of the bodies i and j at a face carries along its own copy of the face's midpoint. u [m] is the displacement of
// j's copy relative to i's. n is the unit normal from i to j, rotated by the mean rotation of the two bodies, and t is
// n rotated by +90°. Then
//
//     opening = u·n      slip = u·t, positive if an observer looking across sees the far side move left (sinistral)
//
// The result does not change if i and j are exchanged. The deformation of the face's own springs is included, so an
// intact face also moves a little under load.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/vec2.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Position of a body at the start of loading; for a confined specimen, before the pressure was applied.
struct StartPlace {
    double x = 0.0, y = 0.0, angle = 0.0;

    CRACKLE_FIELDS(x, y, angle);
};

/// A face on a trace at the start of loading: a mesh face, or the overlapping flat faces of two circles.
struct TraceFace {
    std::int32_t trace = 0;   ///< index into BondRecord::traces
    BodyIndex i = 0, j = 0;   ///< i < j
    std::int32_t bonds = 0;   ///< number of bonded points; 0 for an open face
    double length = 0.0;      // m
    Vec2 middle{}, normal{};  // midpoint, m; unit normal from i to j

    CRACKLE_FIELDS(trace, i, j, bonds, length, middle, normal);
};

/// Motion of a face and its current position.
struct FaceMotion {
    double opening = 0.0, slip = 0.0;  // m
    Vec2 begin, end;  // m, current ends; each is the mean of the positions to which the two bodies have carried it
};

/// Positions of the two bodies at a face.
struct FacePlaces {
    StartPlace i, j;

    CRACKLE_FIELDS(i, j);
};
/// Motion of a face. @param start  initial positions of its bodies @param now  their current positions
FaceMotion motion_of(const TraceFace& face, const FacePlaces& start, const FacePlaces& now);

/// Finds the faces on traces, sorted by bodies. The bodies must still be where they were bonded.
std::vector<TraceFace> find_trace_faces(const World& world);
/// For each bond, the index of its face; -1 if the bond lies on no trace.
std::vector<std::int32_t> faces_of_bonds(const std::vector<TraceFace>& faces, const ContactList& bonds);

}  // namespace crackle
