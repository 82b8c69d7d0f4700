// SPDX-License-Identifier: GPL-3.0-or-later
// A case with the joints of a text, in a box.
#pragma once

#include <fstream>
#include <string>

#include "specimens/case/case_file.hpp"
#include "specimens/joints/joint_network.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle::testing {

inline JointRequest joints_of(const std::string& text) {
    const ScratchFolder folder;
    std::ofstream(folder / "joints.toml") << text;
    return CaseFiles(folder / "joints.toml").joints().joints;
}

/// A case of triangles to which joints can be added.
inline const std::string rock = R"([packing]
width = 0.5
height = 1.0
radius_min = 0.01
radius_max = 0.02
mean_overlap = 1e-5
[material]
density = 2500.0
normal_stiffness = 1e7
shear_stiffness = 1e6
friction_angle = 30.0
[mesh]
kind = "delaunay"
thick = 1e-3
[bond]
thick = 1.1e-3
[loading]
kind = "compression"
max_axial_strain = 0.01
)";

/// A case in area units without a mesh.
inline const std::string area_rock = R"([packing]
width = 0.3
height = 0.5
radius_min = 0.01
radius_max = 0.02
mean_overlap = 1e-5
[material]
density = 2500.0
units = "area"
contact_modulus = 50e9
stiffness_ratio = 2.5
friction_angle = 40.0
tensile_strength = 5e6
cohesion = 15e6
[bond]
law = "coulomb"
[loading]
kind = "compression"
max_axial_strain = 0.01
)";

inline ResolvedCase case_of(const std::string& text) {
    const ScratchFolder folder;
    std::ofstream(folder / "case.toml") << text;
    return read_case(folder / "case.toml");
}

inline Domain box(double width, double height, double x = 0.0, double y = 0.0) { return {x, x + width, y, y + height}; }

inline double total_length(const JointNetwork& network) {
    double sum = 0.0;
    for (const JointTrace& trace : network.traces) sum += trace.length();
    return sum;
}

}  // namespace crackle::testing
