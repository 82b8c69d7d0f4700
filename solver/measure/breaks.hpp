// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of events.csv, which lists broken bonds, for both tests and decks. Tests add further columns
// (specimens/observers/events.hpp).
// Tested by tests/solver/demseg/breaks_test.cpp and tests/specimens/results/files_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// A column of events.csv.
struct BreakColumn {
    Quantity what;
    std::string (*text)(const BreakEvent&);
};
/// Columns of events.csv, in file order.
const std::vector<BreakColumn>& break_columns();

std::string breaks_header();  ///< header line of events.csv, with a newline at the end
/// A row of events.csv for a break, with a newline at the end.
std::string break_line(const BreakEvent& event);

}  // namespace crackle
