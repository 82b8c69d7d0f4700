// SPDX-License-Identifier: GPL-3.0-or-later
// A folder for the files of a generated case.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "solver/base/errors.hpp"

namespace crackle::verification {

/// An empty folder that is removed with all its files on destruction.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        // mkdtemp() replaces the six letters.
        std::string name = (std::filesystem::temp_directory_path() / "crackle_").string() + std::string(6, 'X');
        if (::mkdtemp(name.data()) == nullptr)
            throw OutputError(name + ": cannot be made, expected room for a folder; set TMPDIR");
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;  // nothing depends on it
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace crackle::verification
