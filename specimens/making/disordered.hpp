// SPDX-License-Identifier: GPL-3.0-or-later
// Disordered specimens made in one go, without a packing run: discs on a shaken lattice, and cells of a shaken grid.
// Small, irregular and the same for a seed; for verification, benchmarks and the viewer.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>

#include "solver/scene/scene.hpp"

namespace crackle {

struct DisorderedDiscs {
    int columns = 10, rows = 10;  ///< discs along x in even rows (odd rows have one less), and rows along y
    double radius = 0.02;         ///< m, mean
    double mean_overlap = 8e-5;   ///< m, over all nearest neighbours
    double overlap_spread = 0.5;  ///< overlaps vary by this share of their mean through the radii, 0 to 1
    double shake = 0.0;  ///< m, largest shift of a centre along each axis; above mean_overlap some bonds are lost
    std::uint64_t seed = 1;
};

/// Discs of unequal radii on a shaken triangular lattice, without walls; ids 1, 2, … row by row from the lower left.
Scene disordered_discs(const DisorderedDiscs& request, const Material& material);

struct ShakenCells {
    int columns = 4, rows = 4;  ///< grid cells; about half of them are split into two triangles
    double size = 0.04;         ///< m, grid spacing
    double gap = 1e-3;          ///< m, between facing edges: every cell is inset by half of it; the scene's thick
    double shake = 0.2;         ///< largest shift of a grid node along each axis as a share of the spacing, below 0.25
    bool flat_ends = false;     ///< nodes of the lowest and highest row stay on their line, for platens
    std::uint64_t seed = 1;
};

/// Convex quadrilaterals and triangles that tile a shaken grid with a constant gap; polygons, without walls; ids 1, 2,
/// …
/// @throws InputError where the inset destroys a cell
Scene shaken_cells(const ShakenCells& request, const Material& material);

}  // namespace crackle
