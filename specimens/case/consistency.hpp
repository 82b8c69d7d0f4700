// SPDX-License-Identifier: GPL-3.0-or-later
// Checks whether the keys of a case are consistent with each other.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include "specimens/case/test_case.hpp"

namespace crackle {

/// Checks that the keys of a case are consistent. @throws InputError «file:line: key: found X, expected Y; what to do»
void check_consistency(const TestCase& test);

}  // namespace crackle
