// SPDX-License-Identifier: GPL-3.0-or-later
// Labels for the axes of a plan in diagrams: names with symbols, and values with units.
// Tested by tests/tools/campaign/page/labels_test.cpp.
#pragma once

#include <string>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/point_table.hpp"

namespace crackle::tools {

struct AxisLabel {
    std::string name;  ///< for example "confining pressure σ₃"
    std::string unit;  ///< for example "Pa", "N/m", "°"; empty if there is no unit
};

/// Label for the axis of a key. @param key for example "confinement.pressure" or "mineral[1].friction_angle"
AxisLabel axis_label(const std::string& key, bool area_units);

/// A setting as text, for example "confining pressure σ₃ 10 MPa" or "mesh kind voronoi".
std::string spoken_setting(const std::string& key, const LedgerCell& value, bool area_units);

/// All settings of a point as text; empty if it has none. @param without an axis to omit; may be empty
std::string spoken_point(const PointSummary& point, const std::string& without = "");

}  // namespace crackle::tools
