// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of what is tested: its title, particles, packing, mesh, material, minerals, joints, bonds and shape.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <vector>

#include "specimens/case/parameter.hpp"

namespace crackle {

/// In the order in which a case is written.
std::vector<Parameter> specimen_keys();

}  // namespace crackle
