// SPDX-License-Identifier: GPL-3.0-or-later
// Assigns the joints of a case to the faces of a mesh or to circles. It records which edges lie on which side of which
// trace or, for circles, where traces run. Faces on a trace have the joint's properties instead of the rock's.
// Tested by tests/specimens/joints/joint_faces_test.cpp.
#pragma once

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/joints/joint_network.hpp"

namespace crackle {

/// Assigns joints to the faces of cells.
/// @param scene  scene whose bodies are the cells of `mesh`, in the same order
/// @param mesh  mesh made with the traces of `network`
void set_joints(Scene& scene, const Mesh& mesh, const JointNetwork& network);

/// Assigns joints to circles. @param scene  scene whose bodies are circles inside the network's box
void set_joints_of_circles(Scene& scene, const JointNetwork& network);

/// Names of the joint sets and measured traces that have the properties of the rock: "a, b"; empty if there are none.
std::string sources_as_rock(const JointNetwork& network);

}  // namespace crackle
