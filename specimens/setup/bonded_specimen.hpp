// SPDX-License-Identifier: GPL-3.0-or-later
// Creates a bonded world from a specimen and its platens.
// Tested by tests/specimens/loading/virtual_test_test.cpp.
#pragma once

#include <cstdint>
#include <functional>

#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

/// A bonded world, and its platens.
struct BondedSpecimen {
    World world;
    Platens platens;
};

/// Adds platens, builds the world, creates bonds and moves the platens to their initial positions. Forces are not yet
/// computed. @param while_solving  passed to the world (Workers)
/// @throws InputError if the time step exceeds the exact stable step, or if the bonds do not reach from polygon to
/// polygon; the error names the case's key
BondedSpecimen bond_specimen(const Specimen& specimen, const parts::Bonds& bonds, const parts::Procedure& test,
                             std::function<void()> while_solving = {});

/// How the traces of joints are treated.
enum class Traces : std::uint8_t {
    as_they_are,
    welded,   ///< joints are as strong as the rock and do not deform; circles keep their flat faces
    as_rock,  ///< joints are ignored
};

/// The bonded specimen alone, without platens and walls.
World bond_alone(const Specimen& specimen, const parts::Bonds& bonds, const parts::Procedure& test,
                 Traces traces = Traces::as_they_are);

}  // namespace crackle
