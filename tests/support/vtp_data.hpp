// SPDX-License-Identifier: GPL-3.0-or-later
// A .vtp file that a test makes up: cells and arrays in memory, written by the parts that write a test's frames.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::testing {

/// A named array over the cells; `components` values a cell.
struct CellArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> real;  ///< one of the two is filled
    std::vector<std::int32_t> integer;
};

struct VtpData {
    std::vector<std::vector<Vec2>> lines, polygons;            ///< their corners
    std::vector<CellArray> cell_arrays;                        ///< lines first, then polygons
    std::vector<std::pair<std::string, double>> field_values;  ///< one number each, for the whole file
};

/// The text of a .vtp file.
std::string vtp_text(const VtpData& data);

}  // namespace crackle::testing
