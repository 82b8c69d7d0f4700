// SPDX-License-Identifier: GPL-3.0-or-later
// What a deck run writes on its way: positions and contact forces every nprn1 steps, energies, controlled bodies,
// velocities and the number of bonds every nprn2, and every bond that breaks. Formats: FORMATS.md. Every number reads
// back to the same bits. Tested by tests/solver/demseg/split_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "solver/files/file_set.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Names of the output files, in the order in which DeckOutputs holds them.
inline constexpr std::array<const char*, 8> deck_output_names{
    "output.dat", "cont.dat", "cont2.dat", "energy.dat", "f-d_curve.dat", "velocity_y.dat", "bonds.dat", "events.csv"};

/// Staged: of a run that replaces another, whose outputs keep their names until the new run can be gone on with.
enum class OutputNames : bool { own, staged };

enum class OutputMode {
    fresh,      ///< begins files with their headers
    part,       ///< begins files without: a later part, to be put behind an earlier one
    appending,  ///< goes on with the files of the earlier part
};

class DeckOutputs {
  public:
    /// @throws InputError naming a file that cannot be written.
    DeckOutputs(const std::filesystem::path& folder, OutputMode mode, OutputNames names = OutputNames::own);

    // All of these throw UnstableRun instead of writing a number that is not finite.

    /// output.dat, cont.dat, cont2.dat. Needs current forces. @param order bodies in the order of the deck.
    void write_frame(const World& world, std::span<const BodyIndex> order);
    /// energy.dat and velocity_y.dat. @param bodies whose velocity is written.
    void write_energy_row(const World& world, std::span<const BodyIndex> bodies);
    /// f-d_curve.dat. @param bodies npfd's.
    void write_force_rows(const World& world, std::span<const BodyIndex> bodies);
    /// bonds.dat
    void write_bond_row(const World& world);
    /// events.csv
    void write_breaks(const World& world, std::span<const BreakEvent> breaks);
    /// @throws InputError if something could not be written (a full disc, say).
    void flush();

    /// From the names that they are written under to their own; none where these are the same.
    Renames renames() const;
    /// Once the files have been renamed so, or will be whatever comes.
    void have_own_names() { suffix_ = ""; }

  private:
    enum Which { positions, contact_forces, contact_details, energies, force_displacement, velocities, bonds, events };

    void write(Which which, const World& world, const std::string& text);

    std::filesystem::path path(std::size_t which) const;

    std::filesystem::path folder_;
    std::string suffix_;
    std::array<std::ofstream, deck_output_names.size()> files_;
};

/// Cuts the outputs of an earlier part back to their last complete row or frame of a step up to `step`: what a part
/// that failed or was killed wrote behind the point from which the run goes on. Files that are not there are left
/// alone.
/// @throws InputError on a file that is none of ours, before any is touched.
void drop_rows_after(const std::filesystem::path& folder, std::int64_t step);

}  // namespace crackle
