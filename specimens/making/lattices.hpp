// SPDX-License-Identifier: GPL-3.0-or-later
// Regular arrangements for which stiffness, wave speed and stable time step are known in closed form. Tests, benchmarks
// and the viewer use them.
// Tested by tests/verification/lattice_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle {

/// Equal discs of the given radius at distance 2 radius - overlap on a triangular lattice, with rows along x.
/// @param columns, rows  number of discs along x in even rows (one less in odd rows), and number of rows
/// @return scene without walls; ids 1, 2, … row by row from the lower left
Scene triangular_lattice(int columns, int rows, double radius, double overlap, const Material& material);

/// Equal discs of the given radius at distance 2 radius - overlap on a square lattice, without walls; ids 1, 2, … row
/// by row from the lower left.
Scene square_lattice(int columns, int rows, double radius, double overlap, const Material& material);

/// Equal discs in a row along x at the given spacing, with ids 1, 2, …, count, without walls.
Scene disc_chain(int count, double radius, double spacing, const Material& material);

/// Regular hexagons of the given apothem on a honeycomb, separated by gaps of `thick` (each is inset by thick/2),
/// without walls; ids 1, 2, … row by row.
Scene honeycomb(int columns, int rows, double apothem, double thick, const Material& material);

}  // namespace crackle
