// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of events.csv: what is written of a broken bond, of a test and of a deck alike. A test adds columns of its own
// (specimens/observers/events.hpp).
// Tested by tests/solver/demseg/breaks_test.cpp and tests/specimens/results/files_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "solver/world/world.hpp"

namespace crackle {

struct BreakColumn {
    Quantity what;
    std::string (*text)(const BreakEvent&);
};
/// In the order of the file.
const std::vector<BreakColumn>& break_columns();

std::string breaks_header();  ///< with line end, as all lines here
std::string break_line(const BreakEvent& event);

}  // namespace crackle
