// SPDX-License-Identifier: GPL-3.0-or-later
// events.csv: one row per broken bond, in the order in which bonds break; similar to a record of acoustic emission.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// A column of events.csv: either a column of every record of breaks (solver/measure/breaks.hpp), or one added only
/// in tests.
struct EventColumn {
    Quantity what;
    std::function<std::string(const BreakEvent&, double axial_strain, std::int32_t trace)> text;
    bool jointed = false;  ///< whether the column exists only for specimens with joint traces
};
/// The columns in file order.
const std::vector<EventColumn>& event_columns();

/// A column of slips.csv, which has one row for the first slip of each bond.
struct SlipColumn {
    Quantity what;
    std::string (*text)(const SlipEvent&, double axial_strain);
};
/// The columns in file order.
const std::vector<SlipColumn>& slip_columns();
/// Header line, including the line end.
std::string slips_header();
/// Line for a slip, including the line end. @param axial_strain  the axial strain at the slip
std::string slip_line(const SlipEvent& event, double axial_strain);

/// @param jointed  whether the specimen has joint traces
std::string events_header(bool jointed);  ///< header line, including the line end
/// @param trace  index of the trace on which the bond broke, -1 if not on a trace; empty if the specimen has no traces
std::string event_line(const BreakEvent& event, double axial_strain, std::optional<std::int32_t> trace);

}  // namespace crackle
