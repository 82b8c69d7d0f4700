// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/results/files_test.cpp and tests/solver/demseg/split_test.cpp.
#pragma once

#include <filesystem>
#include <utility>

namespace crackle {

enum class Hold : bool { to_write, to_read };

/// Holds a folder against other processes as long as it lives: who reads does not keep out others who read.
class FolderLock {
  public:
    /// @throws InputError if another process holds it.
    explicit FolderLock(const std::filesystem::path& folder, Hold hold = Hold::to_write);
    FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock();

  private:
    int descriptor_;
};

}  // namespace crackle
