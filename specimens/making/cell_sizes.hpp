// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of the cells of a mesh: measured, and the circles that give the ones asked for.
//
// A cell of area A, before the inset, has the equivalent diameter D = sqrt(4A/pi). With mean D̄ and coefficient of
// variation s of N cells that fill a box, D̄² (1 + s²) = 4 W H/(π N) exactly: the mean is met by scaling all radii. The
// spread follows from that of the radii as measured (specimens/METHODS.md 2).
// Tested by tests/specimens/making/cell_sizes_test.cpp.
#pragma once

#include <string>

#include "mesher/mesher.hpp"
#include "specimens/packing/size_distribution.hpp"

namespace crackle {

/// Equivalent diameters of a mesh's cells.
struct CellSizes {
    double mean = 0.0;    // m
    double spread = 0.0;  ///< coefficient of variation, -
};

/// Share of the mean cell size sqrt(area/cells) that lies between cells of a case that gives no gap: at 0.02 all but
/// one in a hundred faces have both their points (solver/MODEL.md 5.2), and no cell of a usual packing is destroyed.
inline constexpr double derived_gap_share = 0.02;
double derived_gap(double area, double cells);  // m

CellSizes measure_cells(const Mesh& mesh);

/// A sentence on the smallest cell, where by its mass the stable time step would be more than ten times shorter than by
/// that of the mean one: step ~ sqrt(mass), for the springs are alike. Empty of other meshes.
std::string small_cell_text(const Mesh& mesh);

/// Sizes of circles whose centres' cells have these diameters, but for a factor on all radii near 1.
/// @param sizes "uniform" or "lognormal", as a case's packing.sizes
/// @param correction  added to the spread, for another packing where one has missed it
/// @throws InputError «found X, expected Y; …» for a spread that no such circles give
SizeDistribution radii_for_cells(MeshKind kind, const std::string& sizes, const CellSizes& asked,
                                 double correction = 0.0);

/// All radii times `by`.
SizeDistribution scaled(SizeDistribution sizes, double by);

}  // namespace crackle
