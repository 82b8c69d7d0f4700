// SPDX-License-Identifier: GPL-3.0-or-later
// Runs jobs in a separate thread while the simulation continues; the jobs draw and compress frames.
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

/// Runs jobs one after another, in the order in which they were added. If a job throws, the next add() or wait()
/// rethrows the exception, and jobs still in the queue are dropped.
class Background {
  public:
    Background() = default;
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    /// Waits for the remaining jobs.
    ~Background();

    /// Waits while more than `most_waiting` jobs are in the queue, so that a job's data are copied only when the queue
    /// has room.
    void make_room(std::size_t most_waiting);
    /// Adds a job and returns at once; runs it here if no thread can start. @throws any exception of an earlier job
    void add(std::function<void()> job);
    /// Waits until all jobs are done.
    void wait();

  private:
    void work();
    void throw_error(std::unique_lock<std::mutex>& locked);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;  // the first job is running
    std::exception_ptr error_;
    bool ending_ = false;
    std::thread thread_;  // started with the first job
};

}  // namespace crackle
