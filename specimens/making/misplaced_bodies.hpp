// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include <string>

#include "solver/scene/scene.hpp"

namespace crackle {

/// Rejects a particle file in which the centroid of a body lies outside the domain, or in which two bodies coincide.
/// Bodies coincide if the distance between their centroids is less than a hundredth of the smaller body's size.
/// @param where  start of the error message: «file:line: key»
/// @throws InputError that names the bodies and their positions
void refuse_misplaced_bodies(const Scene& scene, const std::string& where);

}  // namespace crackle
