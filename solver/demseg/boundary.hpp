// SPDX-License-Identifier: GPL-3.0-or-later
// in_bc.dat, DEMseg's file of calculation and boundary conditions. Format: FORMATS.md in this folder.
// Tested by tests/solver/demseg/files_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

class DeckReader;

/// First number of in_bc.dat (jclid): how the run starts.
enum class DeckStart : int {
    fresh = 0,      ///< a new run, from the bodies in in_gm.dat alone
    continued = 1,  ///< a continued run, which also reads the contacts in in_cf.dat
    bonded = 3,     ///< bonds are made at the start, with the back-tensions in in_cf0.dat or from the current overlaps
};

/// Control of one body. Flag 0 becomes Drive::force (even for a value of 0, since gravity and contacts still act). Flag
/// 1 becomes Drive::displacement; its value is the displacement reached after nstep steps.
struct BodyControl {
    int id = 0;
    DofControl x, y, rotation;
};

/// Contents of in_bc.dat, in the units of the deck.
struct BoundaryConditions {
    DeckStart start = DeckStart::fresh;
    std::int64_t steps_before = 0;     ///< iloop
    std::int64_t steps = 0;            ///< nstep, >= 1
    std::int64_t output_interval = 0;  ///< nprn1, >= 1: number of steps between outputs of positions and contacts
    std::int64_t row_interval =
        0;  ///< nprn2, >= 1: number of steps between rows of energies, velocities and controlled bodies
    std::vector<int> watched;  ///< ids of the bodies written to f-d_curve.dat
    std::vector<BodyControl> controls;
};

/// Reads in_bc.dat. @throws InputError with file, line and key, and what was found and expected
BoundaryConditions read_boundary(const std::filesystem::path& path);
/// Reads the contents of in_bc.dat from an open reader.
BoundaryConditions read_boundary(DeckReader& reader);

/// Writes in_bc.dat. Numbers are written so that reading them gives identical values.
void write_boundary(std::ostream& out, const BoundaryConditions& boundary);

/// Adds the controls to the scene, and enables contacts between held bodies, because DEMseg's outputs include them.
/// @throws InputError if no body of the scene has the id of a control
void apply_controls(const BoundaryConditions& boundary, Scene& scene);

}  // namespace crackle
