// SPDX-License-Identifier: GPL-3.0-or-later
// in_bc.dat, DEMseg's file of calculation and boundary conditions. Formats: FORMATS.md beside this file.
// Tested by tests/solver/demseg/files_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

class DeckReader;

/// jclid, the file's first number.
enum class DeckStart : int {
    fresh = 0,      ///< from the bodies of in_gm.dat alone
    continued = 1,  ///< with the contacts of in_cf.dat
    bonded = 3,     ///< bonds made at the start, back-tensions from in_cf0.dat or from the present overlaps
};

/// One controlled body. Flag 0 becomes Drive::force (a value of 0 too: gravity and contacts act all the same), flag 1
/// becomes Drive::displacement, value = displacement reached at the end of the nstep steps.
struct BodyControl {
    int id = 0;
    DofControl x, y, rotation;
};

struct BoundaryConditions {
    DeckStart start = DeckStart::fresh;
    std::int64_t steps_before = 0;     ///< iloop
    std::int64_t steps = 0;            ///< nstep, >= 1
    std::int64_t output_interval = 0;  ///< nprn1, >= 1: large outputs
    std::int64_t row_interval = 0;     ///< nprn2, >= 1: small outputs
    std::vector<int> watched;          ///< ids written to f-d_curve.dat
    std::vector<BodyControl> controls;
};

/// @throws InputError with file, line, key, what was found and expected.
BoundaryConditions read_boundary(const std::filesystem::path& path);
BoundaryConditions read_boundary(DeckReader& reader);

/// Numbers read back to the same bits.
void write_boundary(std::ostream& out, const BoundaryConditions& boundary);

/// Adds the controls to the scene, and the contacts between bodies that are held, which the outputs show. @throws
/// InputError naming an id that no body of the scene has.
void apply_controls(const BoundaryConditions& boundary, Scene& scene);

}  // namespace crackle
