// SPDX-License-Identifier: GPL-3.0-or-later
// Joins rows of a survey end to end if they are segments of one fault; list files and branch tables store faults as
// several rows.
// Tested by tests/specimens/joints/faults_test.cpp.
#pragma once

#include <cstddef>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Rows joined end to end.
struct Fault {
    std::vector<Vec2> points;
    std::size_t row = 0;   ///< index of the first of its rows, which determines the fault's direction
    std::size_t rows = 1;  ///< number of rows joined
};

/// Joins rows into faults, ordered by their first rows. If exactly two rows meet at a node, they form one fault unless
/// the second runs back alongside the first. If more rows meet, they are joined in pairs, the straightest pair first;
/// no pair bends by more than 60 degrees.
/// @param reach  m; ends within this distance are at one node; 0: ends must coincide exactly
std::vector<Fault> joined_rows(const std::vector<std::vector<Vec2>>& rows, double reach);

}  // namespace crackle
