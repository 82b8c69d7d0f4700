// SPDX-License-Identifier: GPL-3.0-or-later
// Calls `crackle COMMAND ...` or another program in a temporary folder, and checks its output and that a refusal
// changes no file.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle::testing {

struct Answer {
    int code = -1;
    std::string out, err;
};

/// Base class for tests of one command, or without a name, of a program.
class ProgramCall : public ::testing::Test {
  protected:
    explicit ProgramCall(std::string command, std::string program = CRACKLE_PROGRAM)
        : command_(std::move(command)), program_(std::move(program)) {}

    Answer call(const std::string& words) const {
        const int status = std::system(
            fmt::format("cd '{}' && '{}' {} {} > out.txt 2> err.txt", folder_.string(), program_, command_, words)
                .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out_), read(err_)};
    }

    std::string read(const std::string& name) const { return read_file(folder_ / name); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

    void replace(const std::string& file, const std::string& old_text, const std::string& new_text) const {
        std::string text = read(file);
        const std::size_t at = text.find(old_text);
        ASSERT_NE(at, std::string::npos) << old_text;
        write(file, text.replace(at, old_text.size(), new_text));
    }

    std::map<std::string, std::string> snapshot() const {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
            const std::string name = entry.path().filename();
            if (entry.is_regular_file() && name != out_ && name != err_) files[entry.path()] = read_file(entry.path());
        }
        return files;
    }

    /// Expects exit code 2, one line that contains `says`, and no created, changed or removed file.
    void expect_refused(const std::string& words, const std::string& says) const {
        const auto before = snapshot();
        const Answer answer = call(words);
        fmt::print("  {}", answer.err);
        EXPECT_EQ(answer.code, 2) << words << '\n' << answer.err;
        EXPECT_NE(answer.err.find(says), std::string::npos) << "expected: " << says << "\ngot: " << answer.err;
        EXPECT_EQ(std::count(answer.err.begin(), answer.err.end(), '\n'), 1) << answer.err;
        EXPECT_TRUE(answer.out.empty()) << answer.out;
        EXPECT_TRUE(snapshot() == before) << "files were created, changed or lost";
    }

    static constexpr const char *out_ = "out.txt", *err_ = "err.txt";
    ScratchFolder scratch_;
    std::filesystem::path folder_ = scratch_ / "";

  private:
    std::string command_, program_;
};

}  // namespace crackle::testing
