// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a joint network to the mesher's input, and describes the resulting mesh.
// Tested by tests/specimens/joints/mesh_traces_test.cpp.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"
#include "specimens/joints/joint_network.hpp"

namespace crackle {

/// Polylines for the mesher, in the order of the network's traces.
std::vector<std::vector<Point>> mesh_traces(const JointNetwork& network);

/// Describes the traces named in an error of the mesher, with their source and position: " (trace 3 belongs to ...)".
std::string traces_named(const JointNetwork& network, std::span<const int> traces);

/// Describes the mesh in lines of text: edges on traces, what was moved, and the shape of the cells. If possible, the
/// shape is compared with that of a mesh without traces.
/// @param centres, domain, request  input from which the mesh was made
std::vector<std::string> jointed_mesh_text(const Mesh& with, const std::vector<CellCentre>& centres,
                                           const Domain& domain, MeshRequest request);

}  // namespace crackle
