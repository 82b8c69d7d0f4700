// SPDX-License-Identifier: GPL-3.0-or-later
// Joints of a text as a case has them, in a box.
#pragma once

#include <fstream>
#include <string>

#include "specimens/case/case_file.hpp"
#include "specimens/joints/joint_network.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle::testing {

inline TestCase joints_of(const std::string& text) {
    const ScratchFolder folder;
    std::ofstream(folder / "joints.toml") << text;
    return CaseFiles(folder / "joints.toml").joints();
}

inline Domain box(double width, double height, double x = 0.0, double y = 0.0) { return {x, x + width, y, y + height}; }

inline double total_length(const JointNetwork& network) {
    double sum = 0.0;
    for (const JointTrace& trace : network.traces) sum += trace.length();
    return sum;
}

}  // namespace crackle::testing
