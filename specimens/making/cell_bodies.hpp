// SPDX-License-Identifier: GPL-3.0-or-later
// The cells of a mesh as rigid bodies.
// Tested by tests/tools/commands/mesh_test.cpp.
#pragma once

#include <span>

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

/// Adds a closed chain for each cell, numbered from 1 in the mesh's order. A Voronoi cell has the material of its seed,
/// a triangle that of its first corner that is a seed (corners on the domain's faces are none).
/// @param centre_materials index into scene.materials, by seed
void add_cell_bodies(Scene& scene, const Mesh& mesh, std::span<const int> centre_materials);

}  // namespace crackle
