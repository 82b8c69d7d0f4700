// SPDX-License-Identifier: GPL-3.0-or-later
// What a kind of test leaves of a packing: the bodies within its shape, and those at its sides.
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/kinds/test_kind.hpp"

namespace crackle {

/// Leaves the bodies that lie within the shape of the kind of test; circles that its notch runs through are taken away.
/// @throws InputError where too few are left, or polygons would have to be cut
void cut_shape(Scene& scene, const Shape& shape, bool polygons, const TestCase& test);

/// Ids of the bodies that lie within a region.
std::vector<int> bodies_within(const Scene& scene, const Region& region);

}  // namespace crackle
