// SPDX-License-Identifier: GPL-3.0-or-later
// Regular arrangements with closed-form stiffness, waves and stable steps; shared by tests, benchmarks and the viewer.
// Tested by tests/verification/lattice_test.cpp.
#pragma once

#include "solver/scene/scene.hpp"

namespace crackle {

/// Equal discs of radius R at spacing 2R - overlap on a triangular lattice, rows along x.
/// @param columns,rows discs along x in even rows (odd rows have one less), and rows along y
/// @return scene without walls; ids 1, 2, … row by row from the lower left
Scene triangular_lattice(int columns, int rows, double radius, double overlap, const Material& material);

/// Equal discs of radius R at spacing 2R - overlap on a square lattice, ids row by row from the lower left, without
/// walls.
Scene square_lattice(int columns, int rows, double radius, double overlap, const Material& material);

/// Equal discs of radius R in a row along x at the given spacing, ids 1 … count, without walls.
Scene disc_chain(int count, double radius, double spacing, const Material& material);

/// Regular hexagons of apothem a on a honeycomb, `thick` apart (each inset by thick/2), ids row by row, without walls.
Scene honeycomb(int columns, int rows, double apothem, double thick, const Material& material);

}  // namespace crackle
