// SPDX-License-Identifier: GPL-3.0-or-later
// A test in memory as Python sees it: a moment of a test that is being loaded, or a world that Python steps itself.
// Tested by tests/tools/python/world_test.py.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

#include "specimens/loading/virtual_test.hpp"
#include "tools/python/arrays.hpp"

namespace crackle::python {

/// @throws InputError where several threads are asked for in a process that was forked after the module was loaded:
/// those of OpenMP are not there, and would be waited for for ever
void refuse_threads_after_fork(int threads);

class State {
  public:
    /// A moment of a test that someone else steps. over() comes before that goes on.
    explicit State(VirtualTest& test) : test_(&test) {}
    /// A test of its own.
    explicit State(std::shared_ptr<VirtualTest> own) : test_(own.get()), own_(std::move(own)) {}

    /// @throws std::runtime_error where the moment is over, or another thread is stepping
    VirtualTest& test() const;
    World& world() const { return test().world; }
    /// Whether a thread is stepping it just now. With the lock.
    bool is_stepped() const { return stepping_; }
    /// The same with the forces of the present places known.
    World& world_with_forces();
    /// The same of a specimen in an apparatus. @throws InputError where there is none
    VirtualTest& driven() const;

    template <class Array>
    py::array lend(Array& values) {
        return loans_.lend(values, own_);
    }
    /// Before arrays change.
    void settle() { loans_.settle(); }
    void over();

    /// Ends the test after this look. @throws InputError of a test of its own, std::runtime_error as test()
    void stop();
    bool stop_asked() const { return stop_asked_; }

  protected:
    /// While this lives nobody else may look. With the lock.
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
    bool stepping_ = false;  // looked at with the interpreter's lock held
    bool stop_asked_ = false;
};

/// One that Python steps.
class OwnWorld : public State {
  public:
    using State::State;
    void step(std::int64_t count);
};

/// Properties and methods that a moment and a world have in common, for the class `State`.
void bind_state(py::module_& module);

}  // namespace crackle::python
