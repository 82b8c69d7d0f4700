// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable time step from the absolute values of the mass-scaled matrices.
//
// With A(Δt) = 2Δt·C + Δt²·K in mass-scaled coordinates and any vector x > 0, no eigenvalue of A exceeds the largest
// (|A|x)_i/x_i (Collatz and Wielandt). Each round solves for the Δt at which this is 4, and takes |A|x for the next x,
// which approaches the best one. Unlike a bound spring by spring, it lets forces of opposite sign cancel in |K|.
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include "solver/linear/springs.hpp"

namespace crackle {

class MassScaled;

/// A stable time step, s; infinite without stiffness. @param rounds number of products with |A|
double absolute_step_bound(const MassScaled& pencil, int rounds = 10);
/// Likewise of a world, whose faces and points `which` are its springs.
double absolute_step_bound(const World& world, ClosedPoints which, int rounds = 10);

/// Sets Faces::stiffness_bound and damping_bound of a world whose neighbour list has no points yet.
void bound_faces(World& world, int rounds = 10);

}  // namespace crackle
