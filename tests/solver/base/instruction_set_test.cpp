// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which kernels a program chooses. The tests named after a set (tests/support/with_set) check that all sets give
// the same bytes.
#include "solver/base/instruction_set.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

class InstructionSets : public testing::ProgramCall {
  protected:
    InstructionSets() : ProgramCall("doctor") { unsetenv("CRACKLE_ISA"); }
    ~InstructionSets() override { unsetenv("CRACKLE_ISA"); }

    static void ask_for(std::string_view set) { setenv("CRACKLE_ISA", std::string(set).c_str(), 1); }
    std::string instructions() const {
        const std::string report = call("").out;
        const std::size_t at = report.find("instructions");
        return report.substr(at, report.find('\n', at) - at);
    }
};

TEST_F(InstructionSets, TheWidestThatRunsIsTaken) {
    std::string_view widest;
    for (const InstructionSet set : built_in_sets())
        if (runs_here(set)) widest = name_of(set);
    EXPECT_NE(instructions().find(std::string(widest) + ", chosen"), std::string::npos) << instructions();
}

TEST_F(InstructionSets, AnyThatRunsCanBeAskedFor) {
    for (const InstructionSet set : built_in_sets()) {
        if (!runs_here(set)) continue;
        ask_for(name_of(set));
        EXPECT_NE(instructions().find(std::string(name_of(set)) + ", chosen"), std::string::npos) << instructions();
    }
}

TEST_F(InstructionSets, WhatIsUnknownIsRefusedBeforeAnythingIsDone) {
    ask_for("x86-64-v9");
    expect_refused("", "CRACKLE_ISA: found 'x86-64-v9', expected one of ");
}

TEST(InstructionSetOrder, AWiderOneRunsOnlyWhereTheNarrowerDo) {
    bool narrower = true;
    for (const InstructionSet set : built_in_sets()) {
        EXPECT_TRUE(narrower || !runs_here(set)) << name_of(set);
        narrower = runs_here(set);
    }
}

}  // namespace
}  // namespace crackle
