// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a specimen that lie on traces of joints, and how they have moved since loading began.
//
// The middle of a face between the bodies i and j is carried along by both; u [m] is what that of j has moved beyond
// that of i, n the unit normal from i to j, turned by the mean of what the two have turned, t = n turned by +90°. Then
//
//     opening = u·n      slip = u·t, positive where who looks across sees the far side go to the left (sinistral)
//
// from either side alike. A face's own springs are in it: one that holds moves a little under load, too.
// Tested by tests/specimens/setup/trace_faces_test.cpp.
#pragma once

#include "solver/base/vec2.hpp"
#include "solver/world/world.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A face on a trace, and where it is.
struct FaceMotion {
    double opening = 0.0, slip = 0.0;  // m
    Vec2 begin, end;                   // m, means of where both bodies have carried its ends
};

/// @param i, j  places of its bodies now
FaceMotion motion_of(const TraceFace& face, const TestSetup& setup, const StartPlace& i, const StartPlace& j);

/// Finds setup.trace_faces and setup.bond_faces, of a specimen with traces. Needs setup.bonds and setup.start.
void record_trace_faces(TestSetup& setup, const World& world);

}  // namespace crackle
