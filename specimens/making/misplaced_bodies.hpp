// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/making/specimen_test.cpp.
#pragma once

#include <string>

#include "solver/scene/scene.hpp"

namespace crackle {

/// Refuses a particle file with a body whose centroid lies beyond a side of the domain, or with two bodies at one
/// place, be they alike or not: centroids nearer than a hundredth of the smaller one's size.
/// @param where begins the text of an error: «file:line: key»
/// @throws InputError naming the bodies and their places
void refuse_misplaced_bodies(const Scene& scene, const std::string& where);

}  // namespace crackle
