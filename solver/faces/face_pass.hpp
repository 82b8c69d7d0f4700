// SPDX-License-Identifier: GPL-3.0-or-later
// Force pass over the faces of a world. It computes the motions of faces, the pressures of cells and the forces of
// intact faces. It then breaks faces, computes the forces of broken faces, and sums the forces on each body. Sums are
// formed in a fixed order, so results do not depend on the number of threads. The pressures are omitted if cells have
// none.
// Tested by tests/solver/faces/face_pass_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Computes the forces of all faces from the current positions and the velocities half a step earlier. Adds the forces
/// to Bodies::force and the energy losses to the world's energy account, and records faces that break. Sets the
/// stiffness of the contact points that gradually replace broken faces (hand_over.hpp).
void add_face_forces(World& world);

/// Elastic forces of an intact or broken face in the last force pass.
FaceForces forces_of_face(const Faces& faces, FaceIndex k);

/// Energy stored in faces and in the pressures of cells after a force pass, J.
double face_energy(const Faces& faces);

}  // namespace crackle
