// SPDX-License-Identifier: GPL-3.0-or-later
// Force pass over the faces of a world. Its phases are motions of faces, pressures of cells, forces of intact faces,
// breaks, forces of broken faces, and sums on bodies. Each sum has a fixed order, so that results do not depend on the
// number of threads. Without a pressure of the cells the second phase is left out.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Computes the forces of all faces at the current positions and the velocities of half a step before. Adds them to
/// Bodies::force and their losses to the world's energy account, and records faces that break. Sets the stiffness of
/// the contact points that take over from broken faces (hand_over.hpp).
void add_face_forces(World& world);

/// Elastic forces of a face in the last force pass, broken or not.
FaceForces forces_of_face(const Faces& faces, FaceIndex k);

/// Energy stored in faces and in the pressures of cells after a force pass, J.
double face_energy(const Faces& faces);

}  // namespace crackle
