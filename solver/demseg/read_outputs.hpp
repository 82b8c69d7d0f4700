// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the outputs of a deck run: the frames of output.dat, cont.dat and cont2.dat, and events.csv. Formats:
// FORMATS.md. Tested by tests/tools/commands/view_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle {

/// A circle in output.dat, in the units of the deck.
struct DeckCircle {
    int id = 0;
    double radius = 0.0;
    Vec2 centre;
    double angle = 0.0;  // rad
};

/// A segment in output.dat, in the units of the deck.
struct DeckSegment {
    int id = 0;
    Vec2 start, end;
};

/// A contact in cont.dat and cont2.dat, in the units of the deck.
struct DeckContact {
    int id = 0, other = 0;  ///< ids of the two bodies; `other` is -1, -2, -3, -4 for the left, right, bottom, top wall
    Vec2 place, force;      ///< position, and force on body `id`, including dashpot forces
    double normal_force = 0.0, shear_force = 0.0, back_tension = 0.0;  ///< spring forces, without dashpots
};

/// The complete lines of events.csv and the names of its columns; empty if the run has not written it.
struct DeckBreaks {
    std::string table;
    int names_line = 1;  ///< line number of the column names; 0 for a later part of a run, whose file starts with rows
};

/// An output file as a list of frames. Each frame begins with a line `step time count [count]`, called its head,
/// followed by as many lines as the sum of the counts.
class DeckFrameFile {
  public:
    /// First line of a frame.
    struct Head {
        std::int64_t step = 0;
        double time = 0.0;
        std::vector<std::int64_t> counts;
        std::int64_t offset = 0;  ///< bytes, position in the file of the first line after the head
        std::int64_t bytes = 0;   ///< bytes, total length of these lines
        int line = 0;             ///< line number of the head
    };

    /// Scans the whole file once; an incomplete last frame of a killed run is skipped.
    /// @param counts number of counts in a head @throws InputError naming file and line
    DeckFrameFile(std::filesystem::path path, int counts);

    /// Heads of all frames, in file order.
    const std::vector<Head>& heads() const { return heads_; }
    /// Path of the file.
    const std::filesystem::path& path() const { return path_; }
    /// The lines of a frame as text. @throws InputError if the file cannot be read
    std::string lines(const Head& head) const;

  private:
    std::filesystem::path path_;
    mutable std::ifstream file_;  // kept open, so that the frame list stays valid if another file takes this name
    std::vector<Head> heads_;
};

/// Frames of a deck run.
class DeckFrames {
  public:
    /// Opens the outputs. If a replacement of files in the folder was interrupted, it is completed first.
    /// @param folder must contain output.dat; the other files are optional
    /// @throws InputError if a file was not written by this program, or if a run replaces the files at the same time
    explicit DeckFrames(const std::filesystem::path& folder);

    /// Heads of the frames of output.dat.
    const std::vector<DeckFrameFile::Head>& heads() const { return positions_.heads(); }
    /// Bodies in a frame.
    struct Positions {
        std::vector<DeckCircle> circles;
        std::vector<DeckSegment> segments;
    };
    /// Positions of the bodies in frame k. @throws InputError naming file and line
    Positions positions(std::size_t k) const;
    /// Contacts at the step of frame k; empty if the run has not written any.
    std::vector<DeckContact> contacts(std::size_t k) const;
    /// Bond breaks of the run.
    const DeckBreaks& breaks() const { return breaks_; }
    /// Checks that the outputs are still those that were opened. @throws InputError if another run has replaced them
    void require_unchanged() const;

  private:
    /// Device and inode number of each file; zeros for a missing file.
    using Identities = std::array<std::array<std::uint64_t, 2>, 4>;
    static Identities identities(const std::filesystem::path& folder);
    static Identities whole_set(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    Identities opened_;  // must be initialised before the other members
    DeckFrameFile positions_;
    std::optional<DeckFrameFile> forces_, details_;
    DeckBreaks breaks_;
};

}  // namespace crackle
