// SPDX-License-Identifier: GPL-3.0-or-later
// Clips traces to a box: keeps the parts inside, with ends exactly on the faces of the box.
// Tested by tests/specimens/joints/joint_network_test.cpp.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

/// The part inside the box of a straight line from a to b; empty if it has zero length.
std::optional<std::pair<Vec2, Vec2>> clipped(Vec2 a, Vec2 b, const Domain& box);

/// The pieces of a polyline inside the box, in order. Repeated points are removed.
std::vector<std::vector<Vec2>> clipped(const std::vector<Vec2>& points, const Domain& box);

}  // namespace crackle
