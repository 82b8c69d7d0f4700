// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a small specimen and its case as files. Discs lie on a slightly irregular triangular lattice between four
// walls, with overlaps so that they can be bonded. Polygons are the mesh cells of the same centres.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "solver/demseg/geometry.hpp"

namespace crackle::testing {

/// N/m; the last bit of 2kk/(k + k), for springs in series, differs from this value
inline constexpr double odd_stiffness = 16572823.625;

inline constexpr double rock_radius = 0.02;      // m
inline constexpr double rock_overlap = 7.74e-5;  // m, mean overlap

inline Scene small_rock_scene(int columns = 6, int rows = 14, std::uint64_t seed = 1) {
    std::mt19937_64 generator(seed);
    const auto random = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53 - 0.5; };
    const double spacing = 2.0 * rock_radius - rock_overlap;
    const double row_height = spacing * std::sqrt(0.75);
    const double first = rock_radius - rock_overlap;
    Scene scene;
    Material material;
    material.density = 2500.0;
    material.normal_stiffness = 1e7;
    material.shear_stiffness = 2.5e6;
    material.friction_angle = 27.0;
    scene.materials = {material};
    int id = 100;  // ids in a file need not start at 1
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns - row % 2; ++column) {
            const Vec2 centre{first + spacing * (column + 0.5 * (row % 2)) + 0.5 * rock_overlap * random(),
                              first + row_height * row + 0.5 * rock_overlap * random()};
            scene.add_circle_body(++id, 0, {centre, rock_radius, 0.0});
        }
    }
    scene.domain = {0.0,
                    2.0 * first + spacing * (columns - 1),
                    0.0,
                    2.0 * first + row_height * (rows - 1),
                    {true, true, true, true}};
    scene.time_step = 1e-5;
    return scene;
}

inline void write_small_rock(const std::filesystem::path& file, int columns = 6, int rows = 14) {
    std::ofstream out(file);
    write_geometry(out, small_rock_scene(columns, rows));
}

/// Settings of the case that tests vary.
struct SmallCase {
    std::string kind = "tension";
    std::string mesh = {};  ///< "delaunay", "voronoi" or empty
    double rate = 0.02;     // 1/s
    double max_strain = 0.005;
    /// Further keys; platens are bonded unless `loading` sets other ones.
    std::string loading = {}, numerics = {}, output = "curve_rows = 2000\nframes = 5";
    std::string material = {}, bond = {}, minerals = {};  ///< further keys; `minerals` contains tables
};

/// Writes rock.dat and case.toml into the folder. @return the case's path
inline std::filesystem::path write_small_case(const std::filesystem::path& folder, const SmallCase& wanted) {
    write_small_rock(folder / "rock.dat");
    std::ofstream out(folder / "case.toml");
    const auto add = [&out](const std::string& lines) {  // adds nothing if there are no lines
        if (!lines.empty()) out << lines << '\n';
    };
    add("[particles]\nfile = \"rock.dat\"\n[material]\ndamping_ratio = 0.2");
    add(wanted.material);
    if (!wanted.mesh.empty()) out << fmt::format("[mesh]\nkind = \"{}\"\nthick = 1.0e-3\n", wanted.mesh);
    if (!wanted.mesh.empty() || !wanted.bond.empty()) add("[bond]");
    add(wanted.bond.empty() && !wanted.mesh.empty() ? "thick = 1.08e-3" : wanted.bond);
    add(wanted.minerals);
    out << fmt::format("[loading]\nkind = \"{}\"\naxial_strain_rate = {}\nmax_axial_strain = {}\n{}\n", wanted.kind,
                       wanted.rate, wanted.max_strain, wanted.loading);
    if (wanted.loading.find("platens") == std::string::npos) out << "platens = \"bonded\"\n";
    out << "[numerics]\n" << wanted.numerics << "\n[output]\n" << wanted.output << '\n';
    return folder / "case.toml";
}

}  // namespace crackle::testing
