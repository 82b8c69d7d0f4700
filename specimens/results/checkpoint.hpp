// SPDX-License-Identifier: GPL-3.0-or-later
// The checkpoint of a test: its complete state as bytes. A resumed test produces the same bytes as an uninterrupted
// one.
//
// Layout: the line "crackle test checkpoint N"; cereal's binary archive of the resolved case's SHA-256, setup, state
// and world; and the SHA-256 of everything before it. The hash is checked first, so that damaged data never reach
// cereal. The archive is written and read as a stream, because it is as large as the world.
// Tested by tests/tools/commands/resume_test.cpp.
#pragma once

#include <iosfwd>
#include <string>

#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// The first bytes of a checkpoint; the version number follows.
inline constexpr const char* checkpoint_title = "crackle test checkpoint ";

/// Everything that is needed to resume a test.
struct TestCheckpoint {
    std::string case_hash;  ///< SHA-256 of OUT/case.toml
    TestSetup setup;
    TestState state;
    World world;
};

/// Writes a checkpoint: title, version, hash of the case, setup, state and world.
void save_test(std::ostream& out, const std::string& case_hash, const TestSetup& setup, const TestState& state,
               const World& world);

/// Loads a checkpoint; the stream is read twice (load_world()). @throws InputError if the data are not a checkpoint of
/// this version, or are damaged or truncated; the message contains `name`
TestCheckpoint load_test(std::istream& in, const std::string& name);

}  // namespace crackle
