// SPDX-License-Identifier: GPL-3.0-or-later
// One step of a world whose bodies act on each other by faces alone. Contact points, walls and membranes have no part
// in it: cells whose faces lap no more pass through each other.
//
// The step is leapfrog, as in stepping/step.cpp, with the forces of faces in place of those of contact points.
// Tested by tests/solver/faces/face_step_test.cpp.
#pragma once

#include "solver/faces/faces.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Computes forces, records breaks, losses and the work of driven bodies, all at time n.
void compute_face_forces(World& world, Faces& faces);

/// Kicks and drifts all bodies. Call compute_face_forces() first.
void advance_with_faces(World& world);

/// Does both.
void step_with_faces(World& world, Faces& faces);

/// Ledger at time n, with the energy of the faces in its strain energy. Call it between the two.
Ledger measure_ledger(const World& world, const Faces& faces);

}  // namespace crackle
