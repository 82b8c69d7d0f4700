// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the sizes of mesh cells, and finds the circle sizes that produce requested cell sizes.
//
// A cell of area A before the inset has the equivalent diameter D = sqrt(4A/π). For N cells that fill a box of width W
// and height H, with mean diameter D̄ and coefficient of variation s, D̄² (1 + s²) = 4 W H/(π N) holds exactly. Scaling
// all radii therefore gives the requested mean. How the spread of the cells depends on the spread of the radii has been
// measured (specimens/making/METHODS.md).
// Tested by tests/specimens/making/cell_sizes_test.cpp.
#pragma once

#include <string>

#include "mesher/mesher.hpp"
#include "specimens/packing/size_distribution.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Equivalent diameters of a mesh's cells.
struct CellSizes {
    double mean = 0.0;    // m
    double spread = 0.0;  ///< coefficient of variation, -
};

/// Default gap between cells, relative to the mean cell size sqrt(area/cells). At 0.02, 99 % of the faces have both
/// contact points (solver/MODEL.md 5.2), and the inset destroys no cell of a usual packing.
inline constexpr double derived_gap_share = 0.02;
/// Gap if the case states no gap, m. @param area  area of the box, m2 @param cells  number of cells in the box
double derived_gap(double area, double cells);

/// Sizes of the cells of a mesh, including gaps.
CellSizes measure_cells(const Mesh& mesh);

/// A sentence on the smallest cell if its mass makes the stable time step more than ten times shorter than the step for
/// the mean cell; otherwise empty. The stable step is proportional to sqrt(mass), since the springs are similar.
std::string small_cell_text(const Mesh& mesh);

/// Radii of circles whose mesh cells have the requested diameters, up to a common factor close to 1.
/// @param sizes  uniform or lognormal
/// @param correction  added to the requested spread, to retry after a packing has missed it
/// @throws InputError «found X, expected Y; …» if no circles with such radii give the requested spread
SizeDistribution radii_for_cells(MeshKind kind, RadiusLaw sizes, const CellSizes& asked, double correction = 0.0);

/// The distribution with all radii multiplied by a factor.
SizeDistribution scaled(SizeDistribution sizes, double by);

}  // namespace crackle
