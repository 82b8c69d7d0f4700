// SPDX-License-Identifier: GPL-3.0-or-later
// Finds values in a case that are unlikely for any rock, and suggests the unit that was probably used: millimetres,
// MPa, g/cm3 or radians. Such values may be intended, so they only cause notices.
// Tested by tests/specimens/loading/unlikely_numbers_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/parts/resolved_case.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A sentence for each unlikely value, naming its key.
std::vector<std::string> unlikely_numbers(const ResolvedCase& test, const TestedSpecimen& specimen);

}  // namespace crackle
