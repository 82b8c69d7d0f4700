// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a case that no rock has, with what they are likely to mean: millimetres, MPa, g/cm3, radians. A case may
// mean them all the same, so they are notices.
// Tested by tests/specimens/loading/unlikely_numbers_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/case/test_case.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// A sentence each, naming key and value.
std::vector<std::string> unlikely_numbers(const TestCase& test, const TestSetup& setup);

}  // namespace crackle
