// SPDX-License-Identifier: GPL-3.0-or-later
// Reads back the frames of a test: VTK XML PolyData with zlib-compressed inline binary arrays, as frame_painter.hpp
// writes them. Polygon cells are particles (circles as polygons with a radius), line cells are open chains (platens).
// Tested by tests/specimens/frames/frame_test.cpp and tests/specimens/frames/read_frames_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// One .vtp file. Cells stand as VTK counts them: lines first, then polygons.
struct PolyData {
    struct Cell {
        bool line = false;                ///< a line cell, else a polygon
        std::vector<std::size_t> points;  ///< indices into `points`
    };
    std::vector<Vec2> points;  ///< m
    std::vector<Cell> cells;
    std::map<std::string, std::vector<double>> cell_data;  ///< component by component, cells.size() × components values
    std::map<std::string, double> field_values;            ///< one number each, for the whole file
};

/// @throws InputError naming the file and what is missing or broken in it
PolyData read_polydata(const std::filesystem::path& file);

/// The file's field_values alone, which stand at its beginning. @throws InputError as above
std::map<std::string, double> read_field_values(const std::filesystem::path& file);

/// Cell data `name`, `components` values a cell. @throws InputError as above
const std::vector<double>& cell_values(const std::filesystem::path& file, const PolyData& data, const char* name,
                                       std::size_t components = 1);

/// @throws InputError that names the file and how to mend it
[[noreturn]] void refuse_frame(const std::filesystem::path& file, const std::string& what);

}  // namespace crackle
