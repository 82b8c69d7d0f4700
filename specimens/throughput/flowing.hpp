// SPDX-License-Identifier: GPL-3.0-or-later
// Unbonded bodies that flow: a column without its right wall, collapsing under gravity.
#pragma once

#include <cstdint>

#include "solver/scene.hpp"

namespace crackle::throughput {

/// @param count bodies, met within a few @param polygons hexagons in place of discs
Scene flowing_column(std::int64_t count, bool polygons);

}  // namespace crackle::throughput
