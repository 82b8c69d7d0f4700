// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that shipped cases are found from any folder, by the built program and by an installed program that was moved.
// Programs run in a temporary folder.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

class Shipped : public testing::ProgramCall {
  protected:
    Shipped() : ProgramCall("") {}

    int shell(const std::string& words) const {
        return std::system(fmt::format("cd '{}' && {} > out.txt 2> err.txt", folder_.string(), words).c_str());
    }
};

TEST_F(Shipped, CasesAndDecksAreFoundFromAnyFolder) {
    EXPECT_EQ(call("test --check specimens/guide_rock/circles_tension.toml").code, 0) << read("err.txt");
    EXPECT_EQ(call("run specimens/demseg/circle -o circle --steps 10 -q").code, 0) << read("err.txt");
    EXPECT_NE(call("doctor").out.find("shipped       specimens/... is also looked for in "), std::string::npos);
}

TEST_F(Shipped, OnesOwnComeFirst) {
    fs::create_directories(folder_ / "specimens/guide_rock");
    write("specimens/guide_rock/circles_tension.toml", "[packing]\nseed = \"mine\"\n");
    expect_refused("test --check specimens/guide_rock/circles_tension.toml", "found \"mine\"");
}

TEST_F(Shipped, WhatIsNotShippedIsRefused) {
    expect_refused("test --check specimens/guide_rock/none.toml", "specimens/guide_rock/none.toml: found no such file");
}

TEST_F(Shipped, AreFoundWhereverAnInstallationIsMovedTo) {
    ASSERT_EQ(shell("cmake --install '" CRACKLE_BINARY_DIR "' --prefix first"), 0) << read("err.txt");
    fs::rename(folder_ / "first", folder_ / "moved");
    ASSERT_EQ(shell("moved/bin/crackle doctor"), 0) << read("err.txt");
    EXPECT_NE(read("out.txt").find((fs::canonical(folder_) / "moved/share/crackle").string()), std::string::npos)
        << read("out.txt");
    EXPECT_EQ(shell("moved/bin/crackle test --check specimens/rocks/granite_tension.toml"), 0) << read("err.txt");
}

}  // namespace
}  // namespace crackle
