// SPDX-License-Identifier: GPL-3.0-or-later
// A text file that grows while a test runs. A checkpoint records the file's length and a hash of its contents, so that
// a resumed test can continue the file.
// Tested by tests/specimens/results/growing_file_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "solver/files/file_mark.hpp"
#include "solver/files/file_stream.hpp"

struct XXH3_state_s;

namespace crackle {

/// A file to which rows are appended, with a hash of its contents.
class GrowingFile {
  public:
    /// Keeps the first bytes of the file, whose number and hash are in `marked`, and continues after them. If `marked`
    /// has 0 bytes, a new file is started.
    /// @throws InputError if the file does not begin with these bytes, or cannot be written.
    GrowingFile(std::filesystem::path path, const FileMark& marked);
    ~GrowingFile();

    /// Appends text.
    void write(const std::string& text);
    /// @throws InputError if not all data could be written, or the file was moved or removed.
    void flush();
    /// Length and hash of the text written.
    FileMark mark() const;

  private:
    struct FreeHash {
        void operator()(XXH3_state_s* state) const;
    };

    std::filesystem::path path_;
    FileStream out_;
    std::uint64_t bytes_ = 0;
    std::unique_ptr<XXH3_state_s, FreeHash> hash_;
};

}  // namespace crackle
