// SPDX-License-Identifier: GPL-3.0-or-later
// What a process does to the files of the folder that is looked at, in order, for a loss of power to be played after
// it (power_loss.py). Written into the file that CRACKLE_FAULT_TRACE names; a record is a line
// "kind offset bytes-of-path bytes-of-data", the path, the data and a line's end.
// Tested by tests/faults/library_test.py.
#pragma once

#include <mutex>
#include <string_view>

#include "tests/faults/plan.hpp"

namespace crackle::faults {

/// While it lives no other thread changes a file: the order on record is the order of what was done.
class Recorded {
  public:
    Recorded();
    bool wanted() const { return lock_.owns_lock(); }
    /// Offset: of a write, its place in the file; of a truncation, the new length. Data: what was written; the new
    /// name.
    void add(const char* kind, const Path& path, long offset = 0, std::string_view data = {}) const;

  private:
    std::unique_lock<std::mutex> lock_;
};

}  // namespace crackle::faults
