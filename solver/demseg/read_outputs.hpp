// SPDX-License-Identifier: GPL-3.0-or-later
// Reads back what a deck run wrote: the frames of output.dat, cont.dat and cont2.dat, and events.csv. Formats:
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

struct DeckCircle {
    int id = 0;
    double radius = 0.0;
    Vec2 centre;
    double angle = 0.0;  // rad
};

struct DeckSegment {
    int id = 0;
    Vec2 start, end;
};

struct DeckContact {
    int id = 0, other = 0;  ///< bodies; other -1, -2, -3, -4: left, right, bottom, top wall
    Vec2 place, force;      ///< force on body `id`, dashpots included
    double normal_force = 0.0, shear_force = 0.0, back_tension = 0.0;  ///< of the springs
};

/// The complete lines of events.csv, under the names of its columns; empty where the run wrote none.
struct DeckBreaks {
    std::string table;
    int names_line = 1;  ///< 0 of a later part, whose file begins with its rows
};

/// One of the files as a list of frames: a line `step time count [count]`, then as many lines as the counts add up to.
class DeckFrameFile {
  public:
    struct Head {
        std::int64_t step = 0;
        double time = 0.0;
        std::vector<std::int64_t> counts;
        std::int64_t offset = 0;  ///< of the first line after the head, bytes
        std::int64_t bytes = 0;   ///< of those lines
        int line = 0;             ///< of the head
    };

    /// Walks through the file once; a last frame that a killed run left incomplete is not listed.
    /// @param counts  that a head has @throws InputError naming file and line
    DeckFrameFile(std::filesystem::path path, int counts);

    const std::vector<Head>& heads() const { return heads_; }
    const std::filesystem::path& path() const { return path_; }
    /// The lines of a frame. @throws InputError if it cannot be read
    std::string lines(const Head& head) const;

  private:
    std::filesystem::path path_;
    mutable std::ifstream file_;  // open all the while: another file that gets its name is none of this list
    std::vector<Head> heads_;
};

class DeckFrames {
  public:
    /// Ends a replacement of the folder's files that was stopped.
    /// @param folder  holds output.dat; the others may be absent
    /// @throws InputError on files that are none of ours, or that a run replaces meanwhile
    explicit DeckFrames(const std::filesystem::path& folder);

    const std::vector<DeckFrameFile::Head>& heads() const { return positions_.heads(); }
    struct Positions {
        std::vector<DeckCircle> circles;
        std::vector<DeckSegment> segments;
    };
    /// Of frame k. @throws InputError naming file and line
    Positions positions(std::size_t k) const;
    /// Of the same step; none where the run wrote none.
    std::vector<DeckContact> contacts(std::size_t k) const;
    const DeckBreaks& breaks() const { return breaks_; }
    /// @throws InputError if another run has replaced the outputs since these were opened
    void require_unchanged() const;

  private:
    /// Device and number of each file; zeros where there is none.
    using Identities = std::array<std::array<std::uint64_t, 2>, 4>;
    static Identities identities(const std::filesystem::path& folder);
    static Identities whole_set(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    Identities opened_;  // before the others are
    DeckFrameFile positions_;
    std::optional<DeckFrameFile> forces_, details_;
    DeckBreaks breaks_;
};

}  // namespace crackle
