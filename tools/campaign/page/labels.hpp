// SPDX-License-Identifier: GPL-3.0-or-later
// What figures call the axes of a plan: names with symbols, values with units.
// Tested by tests/tools/campaign/page/labels_test.cpp.
#pragma once

#include <string>

#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/point_table.hpp"

namespace crackle::tools {

struct AxisLabel {
    std::string name;  ///< "confining pressure σ₃"
    std::string unit;  ///< "Pa", "N/m", "°"; empty: none
};

/// @param key of a case: "confinement.pressure", "mineral[1].friction_angle"
AxisLabel axis_label(const std::string& key, bool area_units);

/// "confining pressure σ₃ 10 MPa", "mesh kind voronoi".
std::string spoken_setting(const std::string& key, const LedgerCell& value, bool area_units);

/// All settings of a point, but for one axis where that is named; empty without any.
std::string spoken_point(const PointSummary& point, const std::string& without = "");

}  // namespace crackle::tools
