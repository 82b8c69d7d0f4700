// SPDX-License-Identifier: GPL-3.0-or-later
// A specimen between its platens as a world with bonds.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <cstdint>
#include <functional>

#include "solver/world/world.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

struct BondedSpecimen {
    World world;
    Platens platens;
};

/// Platens added, world built, bonds made, platens in place, forces known.
/// @param loading of the test, or with other platens @param while_solving for the world (Workers)
/// @throws InputError for a step above the exact stable step, naming the case's key
BondedSpecimen bond_specimen(const Specimen& specimen, const TestCase& test, const TestCase::Loading& loading,
                             std::function<void()> while_solving = {});

enum class Traces : std::uint8_t {
    as_they_are,
    welded,   ///< of joints that hold as the rock does and give nothing; circles keep their flat faces
    as_rock,  ///< without joints
};

/// The same without platens and walls.
World bond_alone(const Specimen& specimen, const TestCase& test, Traces traces = Traces::as_they_are);

}  // namespace crackle
