// SPDX-License-Identifier: GPL-3.0-or-later
// Callbacks from a running test to its caller: progress, notices, interrupts, and finished specimens.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include "solver/scene/scene.hpp"

namespace crackle {

struct Packing;
struct PackingRequest;
struct VirtualTest;

/// Progress of a test; stresses in stress_unit.
struct TestProgress {
    double axial_strain = 0.0;
    double share_done = 0.0;  ///< axial strain divided by max_axial_strain
    double axial_stress = 0.0, peak_stress = 0.0;
    const char* stress_unit = "";
    std::int64_t bonds_broken = 0, step = 0;
    double steps_per_second = 0.0;
    double seconds_left = 0.0;  ///< time until max_axial_strain; the specimen may fail earlier
};

/// What a test does after the callback TestHooks::look has returned.
enum class AfterLook : std::uint8_t {
    go_on,
    end,       ///< end the test as complete; the current state becomes the last row
    interrupt  ///< interrupt the test; results are kept, and the test can be resumed
};

/// Callbacks of a test; empty callbacks are ignored.
struct TestHooks {
    std::function<void(const std::string&)> stage;   ///< called with one line at each stage: "packed 304 circles …"
    std::function<void(const std::string&)> detail;  ///< called with further details of a stage, one line each
    std::function<void(const std::string&)>
        working;  ///< called frequently, before loading starts, with a description of the current work
    std::function<void(const TestProgress&)> progress;  ///< called a few times a second
    /// Whether the caller requests an interrupt. Any thread may call it; once true, it must remain true.
    std::function<bool()> interrupted;
    std::function<void(const std::string& name, const Scene&)>
        made;  ///< called with the specimen's circles and then with its polygons, if it has any

    /// Called during loading, when the current forces are known and nothing has moved yet: at each row of the curve,
    /// including rows that are not written, or every `look_every` steps. World::bonds.events contains the breaks since
    /// the last call. The callback may set the platen's speed (specimens/loading/own_loading.hpp).
    std::function<AfterLook(VirtualTest&)> look;
    std::int64_t look_every = 0;  ///< number of steps between calls of `look`; 0: called at rows of the curve

    /// Returns the packing for a request, either from a store or made by calling `make`. If the callback is empty,
    /// every packing is made.
    std::function<Packing(const PackingRequest&, const std::function<Packing()>& make)> keep_packing;

    /// Calls `stage`, if there is one.
    void report_stage(const std::string& line) const {
        if (stage) stage(line);
    }
    /// Calls `detail`, if there is one.
    void report_detail(const std::string& line) const {
        if (detail) detail(line);
    }
    /// Reports work before loading. @throws TestInterrupted if the caller has requested an interrupt
    void report_work(const std::string& what) const;
    /// Calls `made`, if there is one.
    void report_made(const std::string& name, const Scene& scene) const {
        if (made) made(name, scene);
    }
};

/// Thrown if the caller interrupts before loading starts; no results are kept.
class TestInterrupted : public std::runtime_error {
  public:
    TestInterrupted() : std::runtime_error("interrupted before loading began; nothing was written") {}
};

inline void TestHooks::report_work(const std::string& what) const {
    if (interrupted && interrupted()) throw TestInterrupted();
    if (working) working(what);
}

}  // namespace crackle
