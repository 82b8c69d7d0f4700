// SPDX-License-Identifier: GPL-3.0-or-later
// new_state.bin, the sidecar of a deck: what DEMseg's text files cannot hold (body-frame outlines, whole turns, the
// account of energy, the neighbour list), so that a run in parts does the very same arithmetic as the run in one.
//
// It belongs to one set of text files: it carries a hash (XXH3, 64 bits) of each and is good only while they are
// unchanged.
// Tested by tests/solver/demseg/split_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// The text files a state belongs to, in the order of their hashes.
inline constexpr std::array<const char*, 4> deck_text_names{"in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat"};

/// Contents of the four text files.
using DeckTexts = std::array<std::string, 4>;

struct DeckState {
    World world;
    std::string base_geometry;  ///< in_gm.dat of the run's beginning: body shapes before any rounding
    std::string base_boundary;  ///< in_bc.dat of the run's beginning: ramps are counted from there
};

/// How the contacts of a run act, which its text files do not say.
struct DeckLaws {
    SegmentLaw law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
};

/// @param texts as they are written beside it.
std::string save_deck_state(const DeckState& state, const DeckTexts& texts);

/// Reads a state if it belongs to the texts. @param present which of them the deck has; an absent one that the run does
/// not need is not compared. @param edited receives the names of the files that differ.
/// @return nothing if any differs. @throws InputError on a truncated, foreign or newer file.
std::optional<DeckState> load_deck_state(const std::filesystem::path& path, const DeckTexts& texts,
                                         const std::array<bool, 4>& present, std::vector<std::string>& edited);

/// Those of the run that left a state, if one of the texts is as that run wrote it.
/// @param which in_cf.dat or in_cf0.dat, by deck_text_names: their points have the names that the law gives them
/// @return nothing if that text is another, or the file is no state @throws InputError on a truncated or damaged one
std::optional<DeckLaws> laws_of_deck_state(const std::filesystem::path& path, std::size_t which,
                                           const std::string& text);

}  // namespace crackle
