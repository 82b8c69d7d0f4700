// SPDX-License-Identifier: GPL-3.0-or-later
// Normal stress along a face, which is linear between its ends. It follows from the motion of the face and its normal
// force N, so that frames need not store it. L is the length of an intact face, M its moment:
//     σ = N/L ± 6M/L²     N/m, compression positive
// A broken face presses over its lap 2a, without tension. Where it is partly open, the pressure of lap_pressure() falls
// to 0 over the closed length b = (2N/(q k |δ_φ|))^½, and
//     σ = 2N/b  at the closed end     σ = 2N/b (1 - 2a/b) < 0  at the open end, which carries nothing
// The tension of a face that failed in shear is taken as uniform.
// Tested by tests/specimens/frames/face_frames_test.cpp.
#pragma once

#include "solver/world/faces.hpp"

namespace crackle {

/// Normal stress at the two ends of a face, and its moment. With t the face's normal turned by +90°, the ends are at
/// -half_length t and half_length t from its midpoint.
struct FaceTraction {
    double half_length = 0.0;             // m, of the face, or of the lap if the face is broken and carries a force
    double moment = 0.0;                  // N m, as in FaceForces
    double at_begin = 0.0, at_end = 0.0;  // N/m, compression positive
};

/// Normal stress of an intact face. @param normal N, compression positive
FaceTraction traction_of_intact(const FaceSprings& springs, const BondFaceMotion& motion, double normal);
/// Normal stress of a broken face. @param thick thickness of segments, m @param normal N, compression positive
FaceTraction traction_of_broken(const FaceSprings& springs, const BondFaceMotion& motion, double thick, double normal);

}  // namespace crackle
