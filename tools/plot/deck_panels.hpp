// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of deck runs: energies, and motions and forces of watched bodies, against time; forces against displacements.
// Tested by tests/tools/commands/plot_decks_test.cpp.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/names.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/recordings/unit_names.hpp"
#include "tools/plot/panels.hpp"

namespace crackle::plot {

/// A deck run and its appearance in diagrams.
struct PlottedDeck {
    const Recording* recording = nullptr;
    std::string label;
    std::vector<int> bodies;  ///< ids of the bodies to draw, a selection of the bodies listed in npfd
};

/// Values of --what for decks, except `all`.
enum class DeckWord { energy, displacement, height, velocity, force, curve };
constexpr auto list_names(DeckWord) {
    return in_order("energy", "displacement", "height", "velocity", "force", "curve");
}

/// Whether the run has data for this value of --what.
bool has_rows(const Recording& deck, DeckWord word);

/// Values of --what that give a useful diagram: energies; displacements; velocities that are not all 0; forces against
/// displacements if driven bodies did work.
std::vector<DeckWord> words_worth_drawing(const std::vector<PlottedDeck>& decks);

/// The parts selected by --what; `all` means everything that is worth drawing. @throws InputError
std::vector<DeckWord> words_of_decks(const std::vector<std::string>& what, const std::vector<PlottedDeck>& decks);

/// Ids of the bodies for which a run has curves.
std::vector<int> watched_bodies(const Recording& deck);

/// Panels for one value of --what. Energies have one panel per run; forces and displacements have one per direction,
/// each with the curves of all runs.
/// @param units units of the decks; if empty, axes are labelled «deck's units»
/// @param still whether to include directions in which nothing changes
std::vector<Panel> deck_panels(DeckWord word, const std::vector<PlottedDeck>& decks,
                               const std::optional<UnitNames>& units, bool still);

}  // namespace crackle::plot
