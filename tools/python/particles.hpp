// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/python/commands_test.py.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/mesher.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/packing/packing.hpp"

namespace crackle::python {

struct Particles {
    Scene scene;
    std::optional<PackingReport> packing;  ///< report of the packing, if it was made in this process
    std::optional<MeshReport> mesh;        ///< report of the mesh, if it was made in this process
    std::vector<std::string> notices;      ///< report lines on the mesh's joints, or notices on a case's specimen
};

}  // namespace crackle::python
