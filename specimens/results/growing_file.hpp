// SPDX-License-Identifier: GPL-3.0-or-later
// A text file that grows while a test runs, and what a checkpoint records of it: where to go on, and by what bytes the
// file is known to be the one that was left.
// Tested by tests/specimens/results/growing_file_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "solver/files/file_mark.hpp"

struct XXH3_state_s;

namespace crackle {

class GrowingFile {
  public:
    /// Keeps what is marked and goes on behind it; a mark of 0 bytes starts again.
    /// @throws InputError if the file does not begin with what is marked, or cannot be written.
    GrowingFile(std::filesystem::path path, const FileMark& marked);
    ~GrowingFile();

    void write(const std::string& text);
    /// @throws InputError if the disc did not take it all, or the file is no longer where it was made.
    void flush();
    FileMark mark() const;

  private:
    struct FreeHash {
        void operator()(XXH3_state_s* state) const;
    };

    std::filesystem::path path_;
    std::ofstream out_;
    std::uint64_t bytes_ = 0;
    std::unique_ptr<XXH3_state_s, FreeHash> hash_;
};

}  // namespace crackle
