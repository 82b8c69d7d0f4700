// SPDX-License-Identifier: GPL-3.0-or-later
// What a deck's run wrote every nprn2 steps, as columns over time: energy.dat, f-d_curve.dat, velocity_y.dat. Their
// rows have steps alone; the times of these come from the frames of output.dat, linear between two of them.
// In the deck's own units. Tested by tests/tools/page/deck_curves_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "solver/demseg/read_outputs.hpp"

namespace crackle {

/// Columns of energy.dat behind its step, by the names that DEMseg gave them.
enum class DeckEnergy : std::size_t {
    potential,          // enrg
    kinetic,            // enva
    strain,             // enka
    dashpots,           // enca, lost
    friction,           // enfr, lost
    displacement_work,  // enxd, of displacement-controlled bodies
    force_work,         // enxf, of force-controlled ones
    error,              // err, of the account
    broken_bonds,       // enfb, lost
};
inline constexpr std::array<const char*, 9> deck_energy_names{"enrg", "enva", "enka", "enca", "enfr",
                                                              "enxd", "enxf", "err",  "enfb"};

struct DeckEnergyCurve {
    std::vector<double> time;  // s
    std::array<std::vector<double>, deck_energy_names.size()> parts;

    const std::vector<double>& of(DeckEnergy part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Of a body that in_bc.dat lists (npfd): forces of contacts on it, and where it is.
struct DeckBodyCurve {
    int id = 0;
    std::vector<double> time;                                   // s
    std::vector<double> force_x, x, force_y, y, moment, angle;  // angle in rad
};

struct DeckVelocityCurve {
    int id = 0;
    std::vector<double> time, vy;
};

struct DeckCurves {
    bool in_time = true;  ///< false: `time` holds steps, since the run has a single frame
    DeckEnergyCurve energy;
    std::vector<DeckBodyCurve> bodies;          ///< in the order of their first rows
    std::vector<DeckVelocityCurve> velocities;  ///< likewise
};

/// A file that is not there has no rows; a last row that a killed run left incomplete is left out.
/// @throws InputError naming file and line of what is no row of ours
DeckCurves read_deck_curves(const std::filesystem::path& folder, const std::vector<DeckFrameFile::Head>& frames);

}  // namespace crackle
