// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/specimens/results/files_test.cpp and tests/solver/demseg/split_test.cpp.
#pragma once

#include <filesystem>
#include <utility>

namespace crackle {

/// Purpose of a lock.
enum class Hold : bool { to_write, to_read };

/// Locks a folder against other processes during its lifetime. Several readers can hold the lock at the same time.
class FolderLock {
  public:
    /// Locks a folder. @throws InputError if another process holds a conflicting lock
    explicit FolderLock(const std::filesystem::path& folder, Hold hold = Hold::to_write);
    /// Takes over the lock of another object.
    FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FolderLock& operator=(FolderLock&&) = delete;
    ~FolderLock();

  private:
    int descriptor_;
};

}  // namespace crackle
