// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of [joints], [[joint_set]] and [[trace]] against each other: which keys a law has, and needs.
// Tested by tests/specimens/joints/joint_refusal_test.cpp.
#pragma once

#include "specimens/case/test_case.hpp"

namespace crackle {

/// @throws InputError «file:line: key: found X, expected Y; what to do»
void check_joints(const TestCase& test);

/// Whether a test can have joints: circles, or a mesh that fills the box, between platens; and whether their mechanics
/// go with the rock's. @throws InputError
void check_jointed_specimen(const TestCase& test);

/// Whether joints' apertures close within the gap of a mesh, m, where that is derived, or among circles within the
/// smallest radius. @throws InputError
void check_apertures(const TestCase& test, double gap);

}  // namespace crackle
