// SPDX-License-Identifier: GPL-3.0-or-later
// A network of joints as the mesher takes it, and what a mesh with its traces comes to.
// Tested by tests/specimens/joints/mesh_traces_test.cpp.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"
#include "specimens/joints/joint_network.hpp"

namespace crackle {

/// In the order of the network's traces.
std::vector<std::vector<Point>> mesh_traces(const JointNetwork& network);

/// The traces that an error of the mesher names, by where they come from and where they run: " (trace 3 is ...)".
std::string traces_named(const JointNetwork& network, std::span<const int> traces);

/// Lines for people: edges on traces, what had to move, and the shape of the cells beside that of a mesh without
/// traces, which some centres do not have.
/// @param centres, domain, request  that the mesh was made of
std::vector<std::string> jointed_mesh_text(const Mesh& with, const std::vector<CellCentre>& centres,
                                           const Domain& domain, MeshRequest request);

}  // namespace crackle
