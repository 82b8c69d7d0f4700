// SPDX-License-Identifier: GPL-3.0-or-later
// Records all changes that a process makes to files in the observed folder, in order, so that power_loss.py can
// simulate a loss of power. The file is named by CRACKLE_FAULT_TRACE. A record consists of a line "kind offset
// bytes-of-path bytes-of-data", the path, the data and a newline.
// Tested by tests/faults/library_test.py.
#pragma once

#include <mutex>
#include <string_view>

#include "tests/faults/plan.hpp"

namespace crackle::faults {

/// While this object exists, no other thread changes a file, so the recorded order is that of the changes.
class Recorded {
  public:
    Recorded();
    bool wanted() const { return lock_.owns_lock(); }
    /// @param offset for a write, its position in the file; for a truncation, the new length @param data what was
    /// written, or the new name
    void add(const char* kind, const Path& path, long offset = 0, std::string_view data = {}) const;

  private:
    std::unique_lock<std::mutex> lock_;
};

}  // namespace crackle::faults
