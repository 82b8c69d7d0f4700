// SPDX-License-Identifier: GPL-3.0-or-later
// Checks [joints], [[joint_set]] and [[trace]] for consistency: which keys each distribution law allows and requires.
// Tested by tests/specimens/joints/joint_refusal_test.cpp.
#pragma once

#include "specimens/case/test_case.hpp"

namespace crackle {

/// Checks the keys of joints. @throws InputError «file:line: key: found X, expected Y; what to do»
void check_joints(const TestCase& test);

/// Checks that joints are possible in this test: the specimen must consist of circles, or of a mesh that fills the box,
/// between platens. Also checks that the mechanical properties of joints are compatible with those of the rock.
/// @throws InputError
void check_jointed_specimen(const TestCase& test);

}  // namespace crackle
