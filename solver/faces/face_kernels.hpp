// SPDX-License-Identifier: GPL-3.0-or-later
// Motions and forces of intact faces in SIMD lanes, compiled for an instruction set. Results are bit-identical for any
// number of lanes. Broken faces are first treated as intact; the force pass then replaces their values.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include "solver/base/instruction_set.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/faces.hpp"

namespace crackle {

/// Computes Faces::motion of the faces from `begin` up to, but not including, `end`, and Faces::dilation_i and
/// dilation_j if cells have pressures.
using MoveFaces = void (*)(Faces& faces, const BodyState* bodies, FaceIndex begin, FaceIndex end);
template <InstructionSet>
void move_faces(Faces& faces, const BodyState* bodies, FaceIndex begin, FaceIndex end);

/// Result of force_faces().
struct IntactForces {
    double dashpot_loss = 0.0;  // J
    bool some_fail = false;     // whether the strength of an intact face is exceeded
};

/// Computes Faces::force of the faces from `begin` up to, but not including, `end`, which belong to one block. @param
/// drift length of the last drift, s
using ForceFaces = IntactForces (*)(Faces& faces, const BodyState* bodies, double drift, FaceIndex begin,
                                    FaceIndex end);
template <InstructionSet>
IntactForces force_faces(Faces& faces, const BodyState* bodies, double drift, FaceIndex begin, FaceIndex end);

}  // namespace crackle
