// SPDX-License-Identifier: GPL-3.0-or-later
// The second stage of making a specimen: polygons meshed around the centres of circles, along the traces of joints.
// Tested by tests/specimens/making/cell_sizes_test.cpp.
#pragma once

#include "mesher/mesher.hpp"
#include "specimens/joints/joint_network.hpp"
#include "specimens/making/cell_sizes.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// Places joints among the particles, and reports how their traces were cleaned.
JointNetwork joints_of(Specimen& specimen, const JointRequest& asked, const TestHooks& hooks);
/// Records the name and length of each trace in Specimen::traces.
void name_traces(Specimen& specimen, const JointNetwork& joints);

/// Cells meshed from circles, without gaps between the cells. @throws InputError; TestInterrupted
Mesh bare_cells(const Scene& circles, const parts::Mesh& asked, const Places& places, const Shape& shape = {},
                const TestHooks& hooks = {});

/// Replaces the circles of a specimen with polygons. The shape of the test has already been cut from the circles.
/// @return the sizes of the cells
/// @throws InputError that names the case's key if the circles cannot be meshed; TestInterrupted
CellSizes mesh_specimen(Specimen& specimen, const parts::Mesh& asked, const JointRequest& asked_joints,
                        const Places& places, const TestHooks& hooks);

}  // namespace crackle
