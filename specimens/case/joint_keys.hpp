// SPDX-License-Identifier: GPL-3.0-or-later
// Keys for the mechanical properties of a joint, which [[joint_set]] and [[trace]] share.
// Tested by tests/specimens/joints/joint_refusal_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/case/parameter.hpp"
#include "specimens/case/test_case.hpp"

namespace crackle {

/// Keys that [[joint_set]] and [[trace]] share, in the order in which a case is written.
std::vector<Parameter> joint_mechanics_keys();

/// A table that may set mechanical properties of joints, "joint_set[1]" or "trace[2]", with its keys.
struct JointTable {
    std::string label;
    const TestCase::JointKeys* keys;
};
std::vector<JointTable> joint_tables(const TestCase& test);

}  // namespace crackle
