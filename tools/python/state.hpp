// SPDX-License-Identifier: GPL-3.0-or-later
// Access from Python to a test in memory, which is being loaded or which Python code advances step by step.
// Tested by tests/tools/python/world_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

#include "specimens/loading/virtual_test.hpp"
#include "tools/python/arrays.hpp"

namespace crackle::python {

/// @throws InputError if several threads are requested in a process forked after the module was loaded, since OpenMP
/// would wait forever for threads that the fork did not copy
void refuse_threads_after_fork(int threads);

class State {
  public:
    /// State of a test that other code advances. over() must be called before the next step.
    explicit State(VirtualTest& test) : test_(&test) {}
    /// State of a test that this object owns.
    explicit State(std::shared_ptr<VirtualTest> own) : test_(own.get()), own_(std::move(own)) {}

    /// @throws std::runtime_error if over() was called, or if another thread is stepping the test
    VirtualTest& test() const;
    World& world() const { return test().world; }
    /// Whether a thread is currently stepping the test. Call it with the interpreter lock held.
    bool is_stepped() const { return stepping_; }
    /// The world, with forces computed for the current positions.
    World& world_with_forces();
    /// The test, if it has a specimen in an apparatus. @throws InputError otherwise
    VirtualTest& driven() const;

    template <class Array>
    py::array lend(Array& values) {
        return loans_.lend(values, own_);
    }
    /// Call this before arrays change.
    void settle() { loans_.settle(); }
    void over();

    /// Requests that the test end after this callback. @throws InputError for a test that this object owns,
    /// std::runtime_error as test()
    void stop();
    bool stop_asked() const { return stop_asked_; }

  protected:
    /// Prevents other access during its lifetime. Use it with the interpreter lock held.
    class Stepping {
      public:
        explicit Stepping(State& state) : stepping_(state.stepping_) { stepping_ = true; }
        Stepping(const Stepping&) = delete;
        Stepping& operator=(const Stepping&) = delete;
        ~Stepping() { stepping_ = false; }

      private:
        bool& stepping_;
    };

  private:
    VirtualTest* test_;
    std::shared_ptr<VirtualTest> own_;
    Loans loans_;
    bool stepping_ = false;  // protected by the interpreter lock
    bool stop_asked_ = false;
};

/// A world that Python code advances step by step.
class OwnWorld : public State {
  public:
    using State::State;
    void step(std::int64_t count);
};

/// Binds the properties and methods of the Python class `State`, the common base for callbacks of a test and for
/// worlds.
void bind_state(py::module_& module);

}  // namespace crackle::python
