// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a case as written into the parts that the stages of a test use. The parts contain no keys or option names of
// the case file, and no values that still need a default.
// Tested by tests/specimens/case/resolve_test.cpp.
#pragma once

#include <memory>

#include "specimens/case/test_case.hpp"

namespace crackle {

/// The parts of a case. @param written  a case with its defaults, after check_consistency()
/// @throws InputError if planes of joints do not intersect the section, or if an aperture exceeds the gap of the mesh
ResolvedCase resolve(const std::shared_ptr<const TestCase>& written);

/// The joints of a case. @param written  a case after check_joints(); other keys may be missing
/// @throws InputError if planes of joints do not intersect the section
JointCase resolve_joints(const std::shared_ptr<const TestCase>& written);

/// Returns the case from which the parts were resolved, so that it can be written. Only the number of threads,
/// numerics.allow_unstable and step_scale may have been changed since.
/// @throws InputError if the parts were not made by resolve(), or if they were changed
std::shared_ptr<const TestCase> written_case(const ResolvedCase& test);

}  // namespace crackle
