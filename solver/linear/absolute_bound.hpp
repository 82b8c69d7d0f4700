// SPDX-License-Identifier: GPL-3.0-or-later
// Guaranteed bound on the stable time step from the absolute values of the mass-scaled matrices.
//
// With A(Δt) = 2Δt·C + Δt²·K in mass-scaled coordinates and any vector x > 0, no eigenvalue of A exceeds the largest
// (|A|x)_i/x_i (Collatz and Wielandt). Each round finds the Δt at which this ratio is 4. The next round uses |A|x in
// place of x; x thus approaches the vector that gives the best bound. In contrast to a bound from individual springs,
// terms of opposite sign cancel when K is assembled, before absolute values are taken.
// Tested by tests/solver/linear/face_rows_test.cpp.
#pragma once

#include "solver/linear/springs.hpp"

namespace crackle {

class MassScaled;

/// A stable time step, s; infinite without stiffness. @param rounds number of products with |A|
double absolute_step_bound(const MassScaled& pencil, int rounds = 10);
/// A stable time step, s, for a world whose springs are its faces and the contact points given by `which`.
double absolute_step_bound(const World& world, ClosedPoints which, int rounds = 10);

/// Sets Faces::stiffness_bound and damping_bound of a world whose neighbour list has no points yet.
void bound_faces(World& world, int rounds = 10);

}  // namespace crackle
