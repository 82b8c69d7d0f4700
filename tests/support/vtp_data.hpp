// SPDX-License-Identifier: GPL-3.0-or-later
// A .vtp file defined by a test: cells and arrays in memory, written by the code that writes a test's frames.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::testing {

/// A named array with `components` values per cell.
struct CellArray {
    std::string name;
    std::size_t components = 1;
    std::vector<double> real;  ///< only one of these two arrays is used
    std::vector<std::int32_t> integer;
};

struct VtpData {
    std::vector<std::vector<Vec2>> lines, polygons;            ///< corners of each cell
    std::vector<CellArray> cell_arrays;                        ///< arrays with the values of lines first, then of
                                                               ///< polygons
    std::vector<std::pair<std::string, double>> field_values;  ///< one number per name, for the whole file
};

/// The text of a .vtp file.
std::string vtp_text(const VtpData& data);

}  // namespace crackle::testing
