// SPDX-License-Identifier: GPL-3.0-or-later
// Handles Ctrl-C while the engine works: the interpreter records the signal, and the engine polls for it from time to
// time.
// Tested by tests/tools/python/run_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "specimens/making/hooks.hpp"

namespace crackle::python {

/// Polls for signals and records exceptions. Create it in the thread that calls the engine, with the interpreter lock
/// held.
class Interrupts {
  public:
    Interrupts();

    /// Whether the call should end because a signal handler has raised an exception. May be called often and from any
    /// thread; the interpreter is checked a few times per second. Call it without the interpreter lock.
    bool heard();
    /// Records an exception from a callback, which ends the call in the same way. Call it with the interpreter lock
    /// held.
    void raised(const pybind11::error_already_set& error);
    bool pending() const { return over_; }
    /// Throws the recorded exception, if any. Call it with the interpreter lock held.
    void rethrow();

  private:
    using Clock = std::chrono::steady_clock;

    std::thread::id home_ = std::this_thread::get_id();
    int process_;
    Clock::time_point asked_ = Clock::now();
    std::atomic<bool> over_{false};
    std::unique_ptr<pybind11::error_already_set> error_;
};

/// Runs `work` without the interpreter lock, then throws any exception that a signal handler or callback raised in the
/// meantime.
template <class Work>
void run_free(Interrupts& interrupts, const Work& work) {
    try {
        const pybind11::gil_scoped_release free;
        work();
    } catch (const TestInterrupted&) {
        interrupts.rethrow();
        throw;
    }
    interrupts.rethrow();
}

}  // namespace crackle::python
