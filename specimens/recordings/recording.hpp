// SPDX-License-Identifier: GPL-3.0-or-later
// A recorded motion from any source: rigid cells, the bonds between them, and for each frame the positions and contact
// forces. The viewer's page is made from recordings. The frames of a test, the outputs of a deck and a single particle
// file can be read as recordings. Frames are read on request, because all of them may not fit into memory.
//
// Units are m, s, rad, N and N/m, or the units of the deck. Normal forces and stresses are positive in compression.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/names.hpp"
#include "solver/base/vec2.hpp"
#include "specimens/recordings/deck_curves.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle {

/// Values used instead of a cell index for contacts with the left, right, bottom and top wall of a deck's domain.
inline constexpr std::array<std::int32_t, 4> recorded_walls{-1, -2, -3, -4};

/// Point about which a cell rotates: centroid of the area of a polygon, or of the line of an open chain.
Vec2 centroid(const std::vector<Vec2>& corners, bool open);

/// A cell of a recording: a polygon, an open chain, or a circle. Each circle of a clump is a cell with the clump's id.
struct RecordedCell {
    int id = 0;  ///< id of the body in the input
    int material = 1;
    double radius = 0.0;  ///< 0 for polygons and chains
    bool open = false;    ///< whether the cell is an open chain, as platens and walls are
    bool platen = false;
    Vec2 centre;                ///< centroid() in the first frame
    std::vector<Vec2> outline;  ///< corners in the first frame; empty for circles
};

/// A point at which two cells are bonded in the first frame.
struct RecordedBond {
    std::int32_t i = 0, j = 0;        ///< indices of the cells
    Vec2 place;                       ///< position in the first frame
    Vec2 begin = place, end = place;  ///< ends of a face in the first frame; `place` for bonds that are not faces
};

/// State of a RecordedBond in a frame.
enum class BondState : std::uint8_t { intact = 0, slid = 1, broken = 2, touching_again = 3 };

/// Contact points that are not bonds in the first frame.
struct RecordedContacts {
    std::vector<std::int32_t> i, j;  ///< indices of cells, or recorded_walls
    std::vector<double> x, y, normal_force, shear_force;
};

/// Time, strain and other labels of a frame.
struct FrameHead {
    double time = 0.0;
    std::optional<double> axial_strain, axial_stress;
    std::optional<std::int64_t> step;
    std::vector<std::string> roles;  ///< which of "start", "peak" and "end" this frame shows
    std::string file;                ///< file of the frame, as shown to users
};

/// Values at one moment, for each cell or each bond. Values that the source lacks are empty; displacements always
/// exist.
struct RecordedFrame {
    std::vector<double> ux, uy, angle;  ///< displacement (m) and rotation (rad) since the first frame
    std::vector<double> vx, vy, rotation_rate;
    std::vector<double> stress_xx, stress_yy, stress_xy;
    std::vector<double> fragment;  ///< index of the cell's fragment
    std::vector<double> normal_force, shear_force;
    std::vector<double> state;                     ///< values of BondState
    std::vector<double> stress_begin, stress_end;  ///< normal stress at the ends of faces; empty without faces
    RecordedContacts contacts;
};

/// Results of a test, a deck's run or a particle file, in the form that pages and plots need.
struct Recording {
    /// Source of a recording.
    enum class Kind : std::uint8_t { test, deck, particles };

    std::string name;            ///< name of the folder or file
    std::filesystem::path path;  ///< absolute path of the folder or file
    Kind kind = Kind::particles;
    bool drawn_by_seed =
        false;            ///< whether the circles come from a particle file of mode 0, which generates them from a seed
    TestResults results;  ///< results of a test; for a deck, only the breaks
    DeckCurves curves;    ///< curves of a deck
    std::optional<std::array<double, 4>> walls;  ///< x1, x2, y1, y2 of the domain of a deck or particle file
    bool mean_velocities = false;  ///< whether velocities are computed from positions instead of taken from the solver
    std::vector<RecordedCell> cells;
    std::vector<RecordedBond> bonds;
    std::vector<FrameHead> frames;
    std::function<RecordedFrame(std::size_t)> frame;  ///< reads frame k of `frames`; fastest in ascending order
    std::vector<std::string> notices;                 ///< remarks on the files read, one sentence each
};
constexpr auto list_names(Recording::Kind) { return in_order("test", "deck", "particles"); }

/// Indices of about `most` of `count` frames, evenly spaced. The first frame, the last one and the frames in `kept` are
/// always included, even if these exceed `most`.
std::vector<std::size_t> chosen_frames(std::size_t count, std::size_t most, const std::vector<std::size_t>& kept);

/// Reads the results of a test. @param folder  results of `crackle test -o`; frames/ may be missing
/// @param most_frames  number of frames to keep, evenly spaced; the frames at start, peak and end are included
/// @throws InputError that names the file that is missing or invalid
Recording read_test_recording(const std::filesystem::path& folder, std::size_t most_frames);
/// Reads the output of a deck's run.
/// @param folder  output of `crackle run`; without output.dat, the deck's in_gm.dat is the only frame
Recording read_deck_recording(const std::filesystem::path& folder, std::size_t most_frames);
/// Reads a particle file. @param file  in_gm.dat in either mode; in mode 0, its circles are generated from `seed`
Recording read_particle_recording(const std::filesystem::path& file, std::uint64_t seed);
/// The folder of the run if the path is an output file of a deck or of a test; otherwise the path itself.
std::filesystem::path folder_of_run(const std::filesystem::path& path);
/// Reads the recording at `path`: the folder of a test or a deck, a file of such a run (folder_of_run()), or a particle
/// file.
/// @throws InputError if there is no recording at this path
Recording read_recording(const std::filesystem::path& path, std::size_t most_frames, std::uint64_t seed);

}  // namespace crackle
