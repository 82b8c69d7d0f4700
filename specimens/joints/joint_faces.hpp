// SPDX-License-Identifier: GPL-3.0-or-later
// The joints of a case on the faces of a mesh, or among circles: which edge lies on which side of which trace, or where
// traces run, and what each trace's faces do in place of the rock's.
// Tested by tests/specimens/joints/joint_faces_test.cpp.
#pragma once

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/case/test_case.hpp"
#include "specimens/joints/joint_network.hpp"

namespace crackle {

/// What a case's keys come to.
Joint joint_of(const TestCase::JointKeys& keys);

/// @param scene  whose bodies are the cells of `mesh`, made with the traces of `network`, in their order
void set_joints(Scene& scene, const Mesh& mesh, const JointNetwork& network, const TestCase& test);

/// @param scene  whose bodies are circles, in the box of the network
void set_joints_of_circles(Scene& scene, const JointNetwork& network, const TestCase& test);

/// Names of the sources whose traces are as the rock, "a, b"; empty where none is.
std::string sources_as_rock(const JointNetwork& network, const TestCase& test);

}  // namespace crackle
