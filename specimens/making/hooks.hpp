// SPDX-License-Identifier: GPL-3.0-or-later
// Callbacks of a test's caller while it runs: progress, notices, interrupts, what was made.
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
struct TestCase;
struct VirtualTest;

struct TestProgress {
    double axial_strain = 0.0;
    double share_done = 0.0;  ///< of max_axial_strain
    double axial_stress = 0.0, peak_stress = 0.0;
    const char* stress_unit = "";
    std::int64_t bonds_broken = 0, step = 0;
    double steps_per_second = 0.0;
    double seconds_left = 0.0;  ///< until max_axial_strain; failure may come first
};

/// What a look at a running test decides.
enum class AfterLook : std::uint8_t {
    go_on,
    end,       ///< the test is complete; the moment looked at is its last row
    interrupt  ///< as an interrupt: what is written stays, and the test can be gone on with
};

/// Empty members are skipped.
struct TestHooks {
    std::function<void(const std::string&)> stage;      ///< one line a stage: "packed 304 circles …"
    std::function<void(const std::string&)> detail;     ///< what only some want to know of a stage, likewise
    std::function<void(const std::string&)> working;    ///< what is being done before loading, often
    std::function<void(const TestProgress&)> progress;  ///< a few times a second
    std::function<bool()> interrupted;                  ///< asked by any thread; once true it stays so
    std::function<void(const std::string& name, const Scene&)> made;  ///< circles, then polygons, as they are tested

    /// Looks at the test while it is loaded, where the forces of the moment are known and nothing has moved yet: at
    /// every judged row, or every so many steps. World::bonds.events holds the breaks since the last look. May set the
    /// platen's speed (specimens/loading/own_loading.hpp).
    std::function<AfterLook(VirtualTest&)> look;
    std::int64_t look_every = 0;  ///< steps; 0: at rows

    /// Gives the packing of a case, made by `make` or made before; not asked for where it is empty.
    std::function<Packing(const TestCase&, const PackingRequest&, const std::function<Packing()>& make)> keep_packing;

    void report_stage(const std::string& line) const {
        if (stage) stage(line);
    }
    void report_detail(const std::string& line) const {
        if (detail) detail(line);
    }
    /// Before loading. @throws TestInterrupted if that is asked for
    void report_work(const std::string& what) const;
    void report_made(const std::string& name, const Scene& scene) const {
        if (made) made(name, scene);
    }
};

/// The caller's interrupt before loading has begun: there is nothing to keep.
class TestInterrupted : public std::runtime_error {
  public:
    TestInterrupted() : std::runtime_error("interrupted before loading began, nothing is written") {}
};

inline void TestHooks::report_work(const std::string& what) const {
    if (interrupted && interrupted()) throw TestInterrupted();
    if (working) working(what);
}

}  // namespace crackle
