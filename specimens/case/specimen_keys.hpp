// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that describe the specimen: its title, particles, packing, mesh, material, minerals, joints, bonds and shape.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <vector>

#include "specimens/case/parameter.hpp"

namespace crackle {

/// The keys in the order in which a case is written.
std::vector<Parameter> specimen_keys();

}  // namespace crackle
