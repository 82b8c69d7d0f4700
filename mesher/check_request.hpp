// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the input of make_mesh().
// Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <span>

#include "mesher/mesher.hpp"

namespace crackle {

/// Checks lengths, centres, the outline and traces. @throws MeshError if they cannot be meshed
void check_request(std::span<const CellCentre> centres, const Rectangle& domain, const MeshRequest& request);

/// Distance between a convex outline and a point inside it, m.
double depth_within(std::span<const Point> outline, Point p);

}  // namespace crackle
