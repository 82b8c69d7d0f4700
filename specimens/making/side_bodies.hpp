// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the bodies at the left and the right side of a packing, between which the lateral strain is measured.
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include <vector>

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

/// Whether a circle of the body extends beyond the side.
bool circle_overlaps_side(const Scene& scene, const Body& body, Wall side);

/// Finds the polygons on a side of the domain; particle files do not mark them. An edge lies on the side if both its
/// ends are as close to the side as the closest corner of any polygon.
std::vector<int> polygons_on_side(const Scene& scene, Wall side);

/// Whether a cell lies at a side of the domain. If `domain_boundary` is false, the mesh ends at the outermost centres.
/// A triangle then lies at a side if the circles of at least two of its corners touched the wall there.
bool cell_on_side(const Cell& cell, Wall side, bool domain_boundary, const std::vector<char>& centre_touches);

}  // namespace crackle
