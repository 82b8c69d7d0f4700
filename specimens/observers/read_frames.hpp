// SPDX-License-Identifier: GPL-3.0-or-later
// Reads back the frames of a test: VTK XML PolyData with zlib-compressed inline binary arrays, as frame_painter.hpp
// writes them. Polygon cells are particles (circles as polygons with a radius), line cells are open chains (platens).
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
    std::map<std::string, double> field_values;            ///< one number each, for the whole file
};

/// @throws InputError naming the file and what is missing or broken in it
PolyData read_polydata(const std::filesystem::path& file);

/// The file's field_values alone, which stand at its beginning. @throws InputError as above
std::map<std::string, double> read_field_values(const std::filesystem::path& file);

/// One drawn element of a body: its outline, or one circle of it (a clump has several with its id).
struct FrameBody {
    int id = 0;                 ///< as in the input
    double radius = 0.0;        ///< m; 0 for polygons and open chains
    double angle = 0.0;         ///< rad, turned since loading began, counter-clockwise
    bool open = false;          ///< an open chain
    std::vector<Vec2> outline;  ///< m, present position
};

struct ParticleFrame {
    double time = 0.0;          ///< s
    double axial_strain = 0.0;  ///< positive in the sense of the test
    std::vector<FrameBody> bodies;
};

/// One particles_NNNNN.vtp: cell data `id`, `radius` and `angle`, field data `time` and `axial_strain`.
/// @throws InputError as above
ParticleFrame read_particle_frame(const std::filesystem::path& file);

}  // namespace crackle
