// SPDX-License-Identifier: GPL-3.0-or-later
// A recorded motion, whoever made it: rigid cells, what holds them together, and frame by frame where they are and what
// acts between them. The viewer's page is made from it. A test's frames, a deck's outputs and a single particle file
// become one; frames are read when they are asked for, since all of them may be more than fits into memory.
//
// m, s, rad, N, N/m, or the deck's own units. Normal forces and stresses are positive in compression.
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

#include "solver/base/vec2.hpp"
#include "specimens/recordings/test_results.hpp"

namespace crackle {

/// Where contacts with the walls of a deck's domain lie in place of a cell: left, right, bottom, top.
inline constexpr std::array<std::int32_t, 4> recorded_walls{-1, -2, -3, -4};

/// Where a cell turns about: the centroid of a polygon's area, of an open chain's length.
Vec2 centroid(const std::vector<Vec2>& corners, bool open);

/// One drawn cell: a polygon, an open chain, or a circle (a clump has several with its id).
struct RecordedCell {
    int id = 0;  ///< of the body, as in the input
    int material = 1;
    double radius = 0.0;  ///< 0 for polygons and chains
    bool open = false;    ///< an open chain: platen or wall
    bool platen = false;
    Vec2 centre;                ///< in the first frame: centroid()
    std::vector<Vec2> outline;  ///< corners in the first frame; none for circles
};

/// A point that held two cells together in the first frame.
struct RecordedBond {
    std::int32_t i = 0, j = 0;  ///< cells
    Vec2 place;                 ///< in the first frame
};

/// What one of RecordedBond does in a frame.
enum class BondState : std::uint8_t { intact = 0, slid = 1, broken = 2, touching_again = 3 };

/// Contact points that are not among the bonds.
struct RecordedContacts {
    std::vector<std::int32_t> i, j;  ///< cells, or recorded_walls
    std::vector<double> x, y, normal_force, shear_force;
};

struct FrameHead {
    double time = 0.0;
    std::optional<double> axial_strain, axial_stress;
    std::optional<std::int64_t> step;
    std::vector<std::string> roles;  ///< of start, peak and end those that a test names it as
    std::string file;                ///< for people
};

/// One moment. By cell or by bond; empty where the source does not know it, but for the motion.
struct RecordedFrame {
    std::vector<double> ux, uy, angle;  ///< of cells since the first frame, about RecordedCell::centre
    std::vector<double> vx, vy, rotation_rate;
    std::vector<double> stress_xx, stress_yy, stress_xy;
    std::vector<double> fragment;  ///< whole numbers
    std::vector<double> normal_force, shear_force;
    std::vector<double> state;  ///< BondState
    RecordedContacts contacts;
};

struct Recording {
    enum class Kind : std::uint8_t { test, deck, particles };

    std::string name;            ///< of the folder or file
    std::filesystem::path path;  ///< of it, absolute
    Kind kind = Kind::particles;
    TestResults results;                         ///< of a test
    std::optional<std::array<double, 4>> walls;  /// x1, x2, y1, y2 of a deck's domain
    bool mean_velocities = false;                ///< taken from the places of two frames, not the solver's own
    std::vector<RecordedCell> cells;
    std::vector<RecordedBond> bonds;
    std::vector<FrameHead> frames;
    std::function<RecordedFrame(std::size_t)> frame;  ///< reads frame k of `frames`; the quickest in order
    std::vector<std::string> notices;                 ///< on what was read, one sentence each
};

/// At most `most` of `count` frames, evenly chosen; the first, the last and those of `kept` always are among them.
std::vector<std::size_t> chosen_frames(std::size_t count, std::size_t most, const std::vector<std::size_t>& kept);

/// @param folder  what `crackle test -o` made; frames/ may be absent
/// @param most_frames  kept, evenly; those at start, peak and end are among them
/// @throws InputError naming the file that is missing or wrong
Recording read_test_recording(const std::filesystem::path& folder, std::size_t most_frames);
/// @param folder  with the outputs of `crackle run`; without output.dat the deck's in_gm.dat is one frame
Recording read_deck_recording(const std::filesystem::path& folder, std::size_t most_frames);
/// @param file  in_gm.dat of either mode (mode 0: its circles are made with `seed`)
Recording read_particle_recording(const std::filesystem::path& file, std::uint64_t seed);
/// What `path` is: a test's folder, a deck's, or a particle file. @throws InputError if it is none
Recording read_recording(const std::filesystem::path& path, std::size_t most_frames, std::uint64_t seed);

}  // namespace crackle
