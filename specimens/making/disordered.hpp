// SPDX-License-Identifier: GPL-3.0-or-later
// Disordered specimens made directly, without a packing run: discs on a perturbed lattice, and cells of a perturbed
// grid. They are small, irregular and reproducible from a seed. Verification, benchmarks and the viewer use them.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <cstdint>

#include "solver/scene/scene.hpp"

namespace crackle {

/// Request for discs on a perturbed lattice.
struct DisorderedDiscs {
    int columns = 10,
        rows = 10;         ///< number of discs along x in even rows (one less in odd rows); number of rows along y
    double radius = 0.02;  ///< mean radius, m
    double mean_overlap = 8e-5;  ///< mean over all nearest neighbours, m
    double overlap_spread =
        0.5;  ///< relative variation of the overlaps about their mean, caused by different radii, 0 to 1
    double shake =
        0.0;  ///< largest displacement of a centre along each axis, m; above mean_overlap, some bonds are lost
    std::uint64_t seed = 1;
};

/// Discs of unequal radii on a perturbed triangular lattice, without walls; ids 1, 2, … row by row from the lower left.
Scene disordered_discs(const DisorderedDiscs& request, const Material& material);

/// Request for polygons on a perturbed grid.
struct ShakenCells {
    int columns = 4, rows = 4;  ///< number of grid cells along x and y; about half of them are split into two triangles
    double size = 0.04;         ///< grid spacing, m
    double gap = 1e-3;  ///< distance between facing edges, m: every cell is inset by half of it; also Scene::thick
    /// Largest displacement of a grid node along each axis, relative to the grid spacing; below 0.25.
    double shake = 0.2;
    bool flat_ends = false;  ///< whether the lowest and highest nodes stay on straight lines, for platens
    std::uint64_t seed = 1;
};

/// Convex quadrilaterals and triangles that tile a perturbed grid with a constant gap, without walls; ids 1, 2, …
/// @throws InputError if the inset destroys a cell
Scene shaken_cells(const ShakenCells& request, const Material& material);

}  // namespace crackle
