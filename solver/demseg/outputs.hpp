// SPDX-License-Identifier: GPL-3.0-or-later
// Outputs of a deck run. Positions and contact forces are written every nprn1 steps. Energies, controlled bodies,
// velocities and the number of bonds are written every nprn2 steps, and broken bonds as they occur. Formats:
// FORMATS.md. Numbers are written so that reading them gives identical values.
// Tested by tests/solver/demseg/split_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "solver/files/file_set.hpp"
#include "solver/files/file_stream.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Names of the output files, indexed by DeckOutputs::Which.
inline constexpr std::array<const char*, 8> deck_output_names{
    "output.dat", "cont.dat", "cont2.dat", "energy.dat", "f-d_curve.dat", "velocity_y.dat", "bonds.dat", "events.csv"};

/// Whether outputs have their final names. A run that replaces an earlier run writes its outputs under temporary
/// (staged) names until it can be resumed.
enum class OutputNames : bool { own, staged };

/// Whether output files are created or appended to, and whether they have headers.
enum class OutputMode {
    fresh,      ///< creates files, with headers
    part,       ///< creates files without headers, for a later part that will be appended to an earlier one
    appending,  ///< appends to the files of an earlier part
};

/// Output files of a deck run.
class DeckOutputs {
  public:
    /// Opens the files. @throws InputError if a file cannot be written; the message names it
    DeckOutputs(const std::filesystem::path& folder, OutputMode mode, OutputNames names = OutputNames::own);

    // All write functions throw UnstableRun instead of writing a number that is not finite.

    /// Writes output.dat, cont.dat and cont2.dat. Forces must be current. @param order bodies in deck order
    void write_frame(const World& world, std::span<const BodyIndex> order);
    /// Writes energy.dat and velocity_y.dat. @param bodies bodies whose velocity is written
    void write_energy_row(const World& world, std::span<const BodyIndex> bodies);
    /// Writes f-d_curve.dat. @param bodies bodies selected by npfd
    void write_force_rows(const World& world, std::span<const BodyIndex> bodies);
    /// Writes bonds.dat.
    void write_bond_row(const World& world);
    /// Writes events.csv.
    void write_breaks(const World& world, std::span<const BreakEvent> breaks);
    /// Writes buffered output. @throws InputError if a file could not be written (for example, because the disc is
    /// full)
    void flush();

    /// Renames from staged to final names; empty if the outputs already have their final names.
    Renames renames() const;
    /// Call this once the files have been renamed or are certain to be renamed.
    void have_own_names() { suffix_ = ""; }

  private:
    enum Which { positions, contact_forces, contact_details, energies, force_displacement, velocities, bonds, events };

    void write(Which which, const World& world, const std::string& text);

    std::filesystem::path path(std::size_t which) const;

    std::filesystem::path folder_;
    std::string suffix_;
    std::array<FileStream, deck_output_names.size()> files_;
};

/// Truncates the outputs of an earlier part after the last complete row or frame whose step is at most `step`. An
/// earlier part that failed or was killed may have written rows beyond the step from which the run is resumed. Missing
/// files are skipped.
/// @throws InputError if a file was not written by this program; all files are then unchanged
void drop_rows_after(const std::filesystem::path& folder, std::int64_t step);

/// Checks the first line of each existing output. @throws InputError if a file was not written by this program
void refuse_foreign_outputs(const std::filesystem::path& folder);

}  // namespace crackle
