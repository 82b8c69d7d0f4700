// SPDX-License-Identifier: GPL-3.0-or-later
// One virtual test in memory: prepare.hpp makes it from a case, load_specimen.hpp loads it, run.hpp does both with
// files.
#pragma once

#include <optional>
#include <string>

#include "solver/linear/springs.hpp"
#include "solver/world/world.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

struct VirtualTest {
    TestCase description;
    TestSetup setup;
    TestState state;
    World world;
    std::optional<SmallStrain> small_strain;  ///< linear solution with bonded platens
    std::string no_small_strain;              ///< why there is none; a notice says it, too
    /// What bears when loading begins, by linear solutions: bonds, or what pressing has closed as well.
    ClosedPoints closed = ClosedPoints::bonded;
    double specimen_seconds = 0.0;  ///< wall clock that making the specimen took
};

}  // namespace crackle
