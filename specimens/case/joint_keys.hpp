// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of the mechanics of a joint, the same in [[joint_set]] and [[trace]].
// Tested by tests/specimens/joints/joint_refusal_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "specimens/case/parameter.hpp"

namespace crackle {

/// Of both tables, in the order in which a case is written.
std::vector<Parameter> joint_mechanics_keys();

/// Where joints have mechanics: "joint_set[1]", "trace[2]", with what their tables hold, in the case's order.
struct JointTable {
    std::string label;
    const TestCase::JointKeys* keys;
};
std::vector<JointTable> joint_tables(const TestCase& test);

}  // namespace crackle
