// SPDX-License-Identifier: GPL-3.0-or-later
// Work beside the stepping, on a thread of its own: frames are drawn and compressed there.
// Tested by tests/specimens/results/background_test.cpp.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace crackle {

/// Jobs are done one after the other, in the order in which they came. What one throws is thrown to who adds the next
/// one or waits; those that waited behind it are dropped.
class Background {
  public:
    Background() = default;
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    /// Waits for what is still to do.
    ~Background();

    /// Waits while more jobs than that have not begun, so that what a job needs is copied once there is room for it.
    void make_room(std::size_t most_waiting);
    void add(std::function<void()> job);
    /// Until nothing is left to do.
    void wait();

  private:
    void work();
    void throw_error(std::unique_lock<std::mutex>& locked);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;  // the first is being done
    std::exception_ptr error_;
    bool ending_ = false;
    std::thread thread_;  // once there is a job
};

}  // namespace crackle
