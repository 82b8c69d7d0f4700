// SPDX-License-Identifier: GPL-3.0-or-later
// in_gm.dat, DEMseg's geometry file: time step, gravity, materials, domain, bodies. Formats: FORMATS.md beside this
// file.
//
// Units are whatever consistent set the deck uses (the guide's are cgs). A body's number runs on through circle bodies,
// segment bodies (nseg1) and large segment bodies (nseg2); the last two are alike here, only written back apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "solver/scene/scene.hpp"

namespace crackle {

class DeckReader;

/// Width that gives mass to open chains where thick is 0 (deck units; inferred from the guide's sample f-d_curve.dat).
inline constexpr double deck_bare_segment_width = 0.1;

/// Mode 1: everything is given.
struct DeckGeometry {
    Scene scene;                     ///< validated; polygons counter-clockwise
    std::size_t large_segments = 0;  ///< nseg2: so many of the last chain bodies
};

/// Mode 0: circles are to be made at random.
struct RandomGeometry {
    double time_step = unset;  ///< 0: derived from the stiffness bound (ours)
    Vec2 gravity;
    std::vector<Material> materials;
    Domain domain;
    double thick = 0.0;
    double radius_min = unset, radius_max = unset;
    int material = 0;           ///< index into materials
    double void_ratio = unset;  ///< (area - area of circles) / area of circles
};

/// The file's first number. @throws InputError if it is neither 0 nor 1; a file of another kind is named.
int read_geometry_mode(const std::filesystem::path& path);
/// The same of a text, from its beginning.
int read_geometry_mode(const DeckReader& reader);

/// Reads a file of mode 1 into a validated scene: deck conventions (full first kick, width of bare segments) are set.
/// @throws InputError with file, line, key, what was found and expected.
Scene read_geometry(const std::filesystem::path& path);
/// The same with the nseg1/nseg2 grouping kept.
DeckGeometry read_deck_geometry(const std::filesystem::path& path);
DeckGeometry read_deck_geometry(DeckReader& reader);

/// Reads a file of mode 0.
RandomGeometry read_random_geometry(const std::filesystem::path& path);
RandomGeometry read_random_geometry(DeckReader& reader);

/// Writes a file of mode 1; numbers read back to the same bits. Circle bodies come first, then chains, each in scene
/// order.
/// @param large_segments so many of the last chain bodies are written as nseg2.
/// @throws InputError on what the format has no place for: a damping ratio, a missing or infinitely far domain wall.
void write_geometry(std::ostream& out, const Scene& scene, std::size_t large_segments = 0);

}  // namespace crackle
