// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of a test: complete state as bytes. A resumed test ends with the bytes of an uninterrupted one.
//
// Layout: the line "crackle test checkpoint N", cereal's binary archive of the resolved case's SHA-256, setup, state
// and world, and the SHA-256 of all that. The hash is checked first, so that damage never reaches the archive. Written
// as it comes and read from the file, for the whole is as large as the world.
// Tested by tests/tools/commands/resume_test.cpp.
#pragma once

#include <iosfwd>
#include <string>

#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct TestCheckpoint {
    std::string case_hash;  ///< SHA-256 of OUT/case.toml
    TestSetup setup;
    TestState state;
    World world;
};

void save_test(std::ostream& out, const std::string& case_hash, const TestSetup& setup, const TestState& state,
               const World& world);

/// The whole stream, read twice (load_world()). @throws InputError on foreign, damaged, truncated or newer data; `name`
/// is used in the message.
TestCheckpoint load_test(std::istream& in, const std::string& name);

}  // namespace crackle
