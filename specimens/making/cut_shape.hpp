// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts the shape for a kind of test out of a packing, and finds the bodies at its sides.
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/kinds/test_kind.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Keeps the bodies inside the shape; circles that the notch crosses are removed.
/// @param meshed  whether the bodies that remain are the seeds of a mesh
/// @throws InputError if too few bodies remain, or if polygons would have to be cut
void cut_shape(Scene& scene, const Shape& shape, bool polygons, bool meshed, const parts::Procedure& test);

/// Ids of the bodies that lie within a region.
std::vector<int> bodies_within(const Scene& scene, const Region& region);

}  // namespace crackle
