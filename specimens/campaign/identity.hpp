// SPDX-License-Identifier: GPL-3.0-or-later
// By what a test is known: two with the same identity give the same figures, so one is run.
// Tested by tests/specimens/campaign/identity_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "specimens/case/case_file.hpp"

namespace crackle {

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

/// Whether two tests of one rock may differ in a key: title, seeds, confinement, loading, threads and output.
bool differs_within_a_rock(const std::string& key);

/// What the rock of a test is made of: every key but those with its value, files by what they contain. A particle file
/// is a packing, like a seed, where the case states the material; else it has that, too, and counts.
std::map<std::string, std::string> keys_of_rock(const TestCase& test, FileHashes& files);

}  // namespace crackle
