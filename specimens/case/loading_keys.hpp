// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that describe how a specimen is tested: loading, confinement, numerics, output.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <vector>

#include "specimens/case/parameter.hpp"

namespace crackle {

/// The keys in the order in which a case is written.
std::vector<Parameter> loading_keys();

}  // namespace crackle
