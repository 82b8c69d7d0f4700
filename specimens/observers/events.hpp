// SPDX-License-Identifier: GPL-3.0-or-later
// events.csv: one row a broken bond (the acoustic-emission-like record), in the order in which bonds break.
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

/// A column of every break (solver/measure/breaks.hpp), or one that a test adds.
struct EventColumn {
    Quantity what;
    std::function<std::string(const BreakEvent&, double axial_strain, std::int32_t trace)> text;
    bool jointed = false;  ///< only of specimens with traces of joints
};
/// In the order of the file.
const std::vector<EventColumn>& event_columns();

/// slips.csv: one row the first slip of a bond, likewise.
struct SlipColumn {
    Quantity what;
    std::string (*text)(const SlipEvent&, double axial_strain);
};
const std::vector<SlipColumn>& slip_columns();
std::string slips_header();
std::string slip_line(const SlipEvent& event, double axial_strain);

/// @param jointed whether the specimen has traces of joints
std::string events_header(bool jointed);  ///< with line end
/// @param trace number of that on which it broke, -1 of none; nothing of a specimen without traces
std::string event_line(const BreakEvent& event, double axial_strain, std::optional<std::int32_t> trace);

}  // namespace crackle
