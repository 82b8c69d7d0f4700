// SPDX-License-Identifier: GPL-3.0-or-later
// Reads back the frames of a test: VTK XML PolyData with zlib-compressed inline binary arrays, and the collection that
// lists them. Polygon cells are particles (circles as polygons with a radius), line cells are open chains (platens).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "solver/vec2.hpp"

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
};

/// @throws InputError naming the file and what is missing or broken in it
PolyData read_polydata(const std::filesystem::path& file);

struct FrameBody {
    int id = 0;                 ///< as in the input
    double radius = 0.0;        ///< m; 0 for polygons and open chains
    double angle = 0.0;         ///< rad, counter-clockwise
    bool open = false;          ///< an open chain
    std::vector<Vec2> outline;  ///< m, present position
};

/// The bodies of one frame, from its cell data `id`, `radius` and `angle`.
/// @throws InputError as above, and for two bodies of one id
std::vector<FrameBody> read_particle_frame(const std::filesystem::path& file);

/// Time (s) of each file that a .pvd collection lists, by file name without folders.
std::map<std::string, double> read_frame_times(const std::filesystem::path& collection);

}  // namespace crackle
