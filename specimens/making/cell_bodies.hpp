// SPDX-License-Identifier: GPL-3.0-or-later
// Creates rigid bodies from the cells of a mesh.
// Tested by tests/tools/commands/mesh_test.cpp.
#pragma once

#include <span>

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

/// Adds a closed chain for each cell, with ids from 1 in mesh order. A Voronoi cell has the material of its seed. A
/// triangle has the material of its first corner that is a seed (corners on faces of the domain are not).
/// @param centre_materials  for each seed, index into scene.materials
void add_cell_bodies(Scene& scene, const Mesh& mesh, std::span<const int> centre_materials);

}  // namespace crackle
