// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C while the engine works: the interpreter notes the signal, and the engine asks for it now and then.
// Tested by tests/tools/python/run_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "specimens/making/hooks.hpp"

namespace crackle::python {

/// Made by the thread that calls the engine, with the interpreter's lock held.
class Interrupts {
  public:
    Interrupts();

    /// Whether the interpreter wants to end the call: a signal's handler has raised. Asked as often as one likes, from
    /// any thread; the interpreter is asked a few times a second. Without the interpreter's lock.
    bool heard();
    /// What a callback has raised ends the call likewise. With the lock.
    void raised(const pybind11::error_already_set& error);
    bool pending() const { return over_; }
    /// Throws what was raised, if something was. With the lock.
    void rethrow();

  private:
    using Clock = std::chrono::steady_clock;

    std::thread::id home_ = std::this_thread::get_id();
    int process_;
    Clock::time_point asked_ = Clock::now();
    std::atomic<bool> over_{false};
    std::unique_ptr<pybind11::error_already_set> error_;
};

/// Does work with the interpreter's lock free, then throws what a signal or a callback has raised meanwhile.
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
