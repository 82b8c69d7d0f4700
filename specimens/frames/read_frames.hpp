// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the frames of a test: VTK XML PolyData with zlib-compressed inline binary arrays, as written by
// frame_painter.hpp. Polygon cells are particles (circles are polygons with a radius); line cells are open chains
// (platens).
// Tested by tests/specimens/frames/frame_test.cpp and tests/specimens/frames/read_frames_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// Contents of one .vtp file. Cells are numbered as in VTK: lines before polygons.
struct PolyData {
    /// A cell of a file.
    struct Cell {
        bool line = false;                ///< whether it is a line cell rather than a polygon
        std::vector<std::size_t> points;  ///< indices into `points`
    };
    std::vector<Vec2> points;  ///< m
    std::vector<Cell> cells;
    std::map<std::string, std::vector<double>>
        cell_data;  ///< cells.size() × components values; the components of a cell are adjacent
    std::map<std::string, double> field_values;  ///< single numbers for the whole file
};

/// Reads a frame. @throws InputError that names the file and what is missing or damaged
PolyData read_polydata(const std::filesystem::path& file);

/// Reads only the field_values, at the start of the file. @throws InputError under the same conditions as
/// read_polydata()
std::map<std::string, double> read_field_values(const std::filesystem::path& file);

/// Values of the cell data `name`, with `components` values per cell. @throws InputError under the same conditions as
/// read_polydata()
const std::vector<double>& cell_values(const std::filesystem::path& file, const PolyData& data, const char* name,
                                       std::size_t components = 1);

/// Reports a damaged frame. @throws InputError that names the file and how to repair it
[[noreturn]] void refuse_frame(const std::filesystem::path& file, const std::string& what);

}  // namespace crackle
