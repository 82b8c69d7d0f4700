// SPDX-License-Identifier: GPL-3.0-or-later
// By what a test is known: two with the same identity give the same figures, so one is run.
// Tested by tests/specimens/campaign/identity_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "specimens/case/case_file.hpp"

namespace crackle {

/// Goes up when the same case gives other figures than before: earlier tests are then run again, not reused.
/// tests/same_bytes pins what it stands for.
inline constexpr int results_version = 2;

/// SHA-256 of files, each read once.
class FileHashes {
  public:
    /// @throws InputError if it cannot be read
    const std::string& of(const std::filesystem::path& file);

  private:
    std::map<std::filesystem::path, std::string> known_;
};

/// 32 hexadecimal digits: XXH3 (128 bits) of the results version, of every key that a figure can depend on, and of what
/// the files it names contain. Titles, threads, and what is only written differently (frames, slips, checkpoints) are
/// left out.
std::string identity_of(const TestCase& test, FileHashes& files);

/// The same of what makes the packing alone: tests that have it equal start from the same circles.
std::string packing_identity(const TestCase& test, FileHashes& files);

}  // namespace crackle
