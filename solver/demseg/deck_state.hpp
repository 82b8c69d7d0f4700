// SPDX-License-Identifier: GPL-3.0-or-later
// new_state.bin, the state file beside a deck's text files. It contains data for which DEMseg's text files have no
// place (body-frame outlines, full turns, the energy account, the neighbour list). With these data, a run in several
// parts performs exactly the same arithmetic as a single run.
//
// A state file belongs to one set of text files: it contains a hash (XXH3, 64 bits) of each, and is valid only while
// they are unchanged.
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

/// The text files to which a state file belongs, in the order in which it contains their hashes.
inline constexpr std::array<const char*, 4> deck_text_names{"in_gm.dat", "in_bc.dat", "in_cf.dat", "in_cf0.dat"};

/// Contents of the four text files.
using DeckTexts = std::array<std::string, 4>;

/// The state of a deck run between two of its parts.
struct DeckState {
    World world;
    std::string base_geometry;  ///< in_gm.dat at the very beginning of the run: body shapes before any round-off
    std::string base_boundary;  ///< in_bc.dat at the very beginning of the run, from which ramps are counted
};

/// Contact law and integrator of a run; the text files do not contain them.
struct DeckLaws {
    SegmentLaw law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
};

/// Bytes of a state file. @param texts the text files written together with it
std::string save_deck_state(const DeckState& state, const DeckTexts& texts);

/// Reads a state file if it belongs to the text files. @param present whether each text file exists; absent files are
/// not compared. @param edited receives the names of the files that differ
/// @return empty if any file differs @throws InputError if it is truncated, not a state file, or of another version
std::optional<DeckState> load_deck_state(const std::filesystem::path& path, const DeckTexts& texts,
                                         const std::array<bool, 4>& present, std::vector<std::string>& edited);

/// Contact law and integrator of the run that wrote a state file, if the given text file is unchanged.
/// @param which index of in_cf.dat or in_cf0.dat in deck_text_names; in these files, the identification of points
/// depends on the law
/// @return empty if the text file has changed, or if the file at `path` is not a state file @throws InputError if the
/// state file is truncated or damaged
std::optional<DeckLaws> laws_of_deck_state(const std::filesystem::path& path, std::size_t which,
                                           const std::string& text);

}  // namespace crackle
