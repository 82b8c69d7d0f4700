// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of decks' runs: energies, watched bodies and velocities over time, forces over displacements.
// Tested by tests/tools/commands/plot_decks_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// One run as it appears in diagrams.
struct PlottedDeck {
    const Recording* recording = nullptr;
    std::string label;
    std::vector<int> bodies;  ///< of npfd's those that are drawn
};

/// What --what says of decks, apart from all.
enum class DeckWord { energy, displacement, height, velocity, force, curve };

/// Whether the run has rows of it.
bool has_rows(const Recording& deck, DeckWord word);

/// What has something to show: energies; displacements and velocities that are not all 0; forces over displacements
/// where driven bodies did work.
std::vector<DeckWord> words_worth_drawing(const std::vector<PlottedDeck>& decks);

/// Of energies a panel a run, of forces and displacements one a direction, each with the curves of all runs.
/// @param units  of the decks; none: they are called the deck's
/// @param still  draw directions, too, in which nothing happens
std::vector<Panel> deck_panels(DeckWord word, const std::vector<PlottedDeck>& decks,
                               const std::optional<UnitNames>& units, bool still);

}  // namespace crackle::plot
