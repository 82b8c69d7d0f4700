// SPDX-License-Identifier: GPL-3.0-or-later
// The identity of a test. Tests with the same identity have the same results, so only one of them is run.
// Tested by tests/specimens/campaign/identity_test.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "specimens/campaign/plan.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// SHA-256 of files; each file is read only once.
class FileHashes {
  public:
    /// SHA-256 of a file. @throws InputError if the file cannot be read
    const std::string& of(const std::filesystem::path& file);

  private:
    std::map<std::filesystem::path, std::string> known_;
};

/// Identity of a test, 32 hexadecimal digits: XXH3 (128 bits) of the results version, every key that can affect a
/// result, and the contents of the files that keys name. Titles, threads and keys that only choose outputs (frames,
/// slips, checkpoints) are excluded.
std::string identity_of(const ResolvedCase& test, FileHashes& files);

/// Identity of the packing alone; tests with the same packing identity start from the same circles.
std::string packing_identity(const ResolvedCase& test, FileHashes& files);

/// Whether a key may differ between tests of the same rock: title, seeds, confinement, loading, threads and output.
bool differs_within_a_rock(const std::string& key);

/// Keys that define the rock of a test, with their values: all keys for which differs_within_a_rock() is false. Files
/// are represented by their contents. A particle file is excluded, like a seed, if the case states the material;
/// otherwise, the file provides the material and is included.
std::map<std::string, std::string> keys_of_rock(const ResolvedCase& test, FileHashes& files);

/// Text that is equal for plans with the same rows, no matter how the plans are written.
std::string rows_mark(const Plan& plan, const std::vector<std::string>& identities);

/// Keys and values of the rock in each test, by name of the test, as JSON.
std::string rocks_text(const Plan& plan);

}  // namespace crackle
