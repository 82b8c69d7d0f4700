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
    std::optional<PackingReport> packing;  ///< where they were packed now
    std::optional<MeshReport> mesh;        ///< where they were meshed now
    std::vector<std::string> notices;      ///< on the joints of that mesh
};

}  // namespace crackle::python
