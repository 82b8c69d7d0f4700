// SPDX-License-Identifier: GPL-3.0-or-later
// Files for a campaign that takes a second: cases of 60 circles, and plans for them.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace crackle::testing {

inline void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

/// @param more further lines, which may contain tables
inline std::filesystem::path write_packed_case(const std::filesystem::path& file, const std::string& kind = "tension",
                                               const std::string& more = "") {
    write_text(file, fmt::format("[packing]\ncount = 60\nradius_min = 1.333e-2\nradius_max = 2.667e-2\n"
                                 "mean_overlap = 7.74e-5\n[material]\ndensity = 2500.0\nnormal_stiffness = 1.0e7\n"
                                 "shear_stiffness = 2.5e6\nfriction_angle = 27.0\ndamping_ratio = 0.2\n"
                                 "[loading]\nkind = \"{}\"\naxial_strain_rate = 0.02\nmax_axial_strain = 0.008\n"
                                 "[output]\ncurve_rows = 200\n{}",
                                 kind, more));
    return file;
}

/// Writes a plan of two kinds of test, an axis of two values, and `packings` packings.
inline std::filesystem::path write_small_plan(const std::filesystem::path& folder, int packings = 2,
                                              const std::string& more = "") {
    write_packed_case(folder / "tension.toml");
    write_packed_case(folder / "compression.toml", "compression");
    write_text(folder / "plan.toml", fmt::format("title = \"A small rock\"\n"
                                                 "[[test]]\ncase = \"tension.toml\"\n"
                                                 "[[test]]\ncase = \"compression.toml\"\n"
                                                 "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [20, 35]\n"
                                                 "[packings]\ncount = {}\n{}",
                                                 packings, more));
    return folder / "plan.toml";
}

}  // namespace crackle::testing
