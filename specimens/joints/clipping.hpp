// SPDX-License-Identifier: GPL-3.0-or-later
// Traces cut by a box: what lies inside, its ends exactly on the box's faces.
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

/// What of a straight line from a to b lies in the box; nothing where that has no length.
std::optional<std::pair<Vec2, Vec2>> clipped(Vec2 a, Vec2 b, const Domain& box);

/// The pieces of a line of straight parts that lie in the box, in its order. Repeated points are left out.
std::vector<std::vector<Vec2>> clipped(const std::vector<Vec2>& points, const Domain& box);

}  // namespace crackle
