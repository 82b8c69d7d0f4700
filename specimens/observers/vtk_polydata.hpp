// SPDX-License-Identifier: GPL-3.0-or-later
// ParaView's XML PolyData (.vtp) and its collection file (.pvd). Arrays stand in the text as base64 of zlib-compressed
// little-endian bytes (vtkZLibDataCompressor, one block an array). Format: VTK File Formats, "XML File Formats".
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/vec2.hpp"

namespace crackle {

/// A named array over the cells; `components` values a cell.
struct CellArray {
    std::string name;
    int components = 1;
    std::vector<double> real;  ///< one of the two is filled
    std::vector<std::int64_t> integer;
};

/// Cells of one kind: indices into the points, cell after cell, and the end of each cell in them.
struct CellList {
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> offsets;
};

struct VtpData {
    std::vector<Vec2> points;
    CellList lines;  ///< polylines
    CellList polygons;
    std::vector<CellArray> cell_arrays;                        ///< lines first, then polygons, as VTK counts cells
    std::vector<std::pair<std::string, double>> field_values;  ///< one number each, for the whole file

    /// Adds a cell whose corners are appended to the points.
    void add_line(const std::vector<Vec2>& corners) { add(lines, corners); }
    void add_polygon(const std::vector<Vec2>& corners) { add(polygons, corners); }

  private:
    void add(CellList& list, const std::vector<Vec2>& corners);
};

/// The text of a .vtp file.
std::string vtp_text(const VtpData& data);

struct CollectionEntry {
    double time = 0.0;
    int part = 0;
    std::string file;  ///< relative to the collection
};

/// The text of a .pvd file.
std::string pvd_text(const std::vector<CollectionEntry>& entries);

}  // namespace crackle
