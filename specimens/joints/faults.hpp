// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a survey that are segments of one fault (lists and branch tables have it so), joined end to end.
// Tested by tests/specimens/joints/faults_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Rows joined end to end.
struct Fault {
    std::vector<Vec2> points;
    std::size_t row = 0;   ///< the first of its rows, which gives it its direction
    std::size_t rows = 1;  ///< so many
};

/// Two rows alone at a node are one fault, unless the second runs back beside the first; where more meet, those that go
/// on most straightly are, at a bend of at most 60 degrees. In the order of their first rows.
/// @param reach  m: ends that near to each other are at one node; 0: ends alike to the last digit
std::vector<Fault> joined_rows(const std::vector<std::vector<Vec2>>& rows, double reach);

}  // namespace crackle
