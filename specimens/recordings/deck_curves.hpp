// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the output files that a deck's run writes every nprn2 steps, as columns over time: energy.dat, f-d_curve.dat,
// velocity_y.dat. Their rows contain only step numbers; times are interpolated linearly between the frames of
// output.dat. All values are in the deck's own units.
// Tested by tests/tools/page/deck_curves_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "solver/demseg/read_outputs.hpp"

namespace crackle {

/// Columns of energy.dat after the step number, with DEMseg's names for them.
enum class DeckEnergy : std::size_t {
    potential,          // enrg
    kinetic,            // enva
    strain,             // enka
    dashpots,           // enca, dissipated
    friction,           // enfr, dissipated
    displacement_work,  // enxd, work of displacement-controlled bodies
    force_work,         // enxf, work of force-controlled bodies
    error,              // err, error of the energy balance
    broken_bonds,       // enfb, dissipated
};
inline constexpr std::array<const char*, 9> deck_energy_names{"enrg", "enva", "enka", "enca", "enfr",
                                                              "enxd", "enxf", "err",  "enfb"};

/// Rows of energy.dat, by term of the energy balance, in the units of the deck.
struct DeckEnergyCurve {
    std::vector<double> time;  // s
    std::array<std::vector<double>, deck_energy_names.size()> parts;

    /// Values of one term of the energy balance, one per row.
    const std::vector<double>& of(DeckEnergy part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Curve of a body listed in in_bc.dat (npfd): contact forces and position.
struct DeckBodyCurve {
    int id = 0;
    std::vector<double> time;                                   // s
    std::vector<double> force_x, x, force_y, y, moment, angle;  // angle in rad
};

/// Rows of velocity_y.dat for one body, in the units of the deck.
struct DeckVelocityCurve {
    int id = 0;
    std::vector<double> time, vy;
};

/// All curves of a run.
struct DeckCurves {
    bool in_time = true;  ///< false if `time` contains step numbers because the run has only one frame
    DeckEnergyCurve energy;
    std::vector<DeckBodyCurve> bodies;          ///< in the order in which the bodies first appear in the file
    std::vector<DeckVelocityCurve> velocities;  ///< in the order in which the bodies first appear in the file
};

/// Reads the curves of a run. A missing file gives no rows. An incomplete last row, from a killed run, is ignored.
/// @throws InputError that names file and line of a row in another format
DeckCurves read_deck_curves(const std::filesystem::path& folder, const std::vector<DeckFrameFile::Head>& frames);

}  // namespace crackle
