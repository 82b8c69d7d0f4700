// SPDX-License-Identifier: GPL-3.0-or-later
// One virtual test in memory. prepare.hpp makes it from a case, load_specimen.hpp loads it, and run.hpp does both and
// writes files.
#pragma once

#include <optional>
#include <string>

#include "solver/linear/springs.hpp"
#include "solver/world/world.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

/// The complete state of a test between two steps.
struct VirtualTest {
    ResolvedCase description;
    TestSetup setup;
    TestState state;
    World world;
    std::optional<SmallStrain> small_strain;  ///< linear solution with bonded platens
    std::string no_small_strain;              ///< reason why there is no linear solution; a notice states it too
    /// Contacts that carry load at the start of loading, as used in linear solutions: only bonds, or also contacts that
    /// the normal force of a shear test has closed.
    ClosedPoints closed = ClosedPoints::bonded;
    double specimen_seconds = 0.0;  ///< wall-clock time that it took to make the specimen, s
};

}  // namespace crackle
