// SPDX-License-Identifier: GPL-3.0-or-later
// in_gm.dat, DEMseg's geometry file: time step, gravity, materials, domain, bodies. Format: FORMATS.md in this folder.
//
// Any consistent set of units may be used (the decks in the DEMseg guide use cgs). Bodies are numbered consecutively:
// circle bodies, segment bodies (nseg1), large segment bodies (nseg2). The last two groups are treated alike, but
// written separately.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "solver/scene/scene.hpp"

namespace crackle {

class DeckReader;

/// Width used to compute the mass of open chains if thick is 0, in deck units. Inferred from the sample f-d_curve.dat
/// in the DEMseg guide.
inline constexpr double deck_bare_segment_width = 0.1;

/// Contents of a mode-1 file, which lists all bodies.
struct DeckGeometry {
    Scene scene;                     ///< validated, with counter-clockwise polygons
    std::size_t large_segments = 0;  ///< nseg2: number of large segment bodies, the last chain bodies of the scene
};

/// Contents of a mode-0 file, for which circles are generated at random.
struct RandomGeometry {
    double time_step = unset;  ///< 0: derived from the stable bound (an extension of DEMseg's format)
    Vec2 gravity;
    std::vector<Material> materials;
    Domain domain;
    double thick = 0.0;
    double radius_min = unset, radius_max = unset;
    int material = 0;           ///< index into the materials
    double void_ratio = unset;  ///< dimensionless: (area of the domain - area of circles)/area of circles
};

/// Reads the mode of a geometry file (its first number). @throws InputError if the mode is neither 0 nor 1; for another
/// kind of file, the message names the kind
int read_geometry_mode(const std::filesystem::path& path);
/// Reads the mode of a geometry text (its first number).
int read_geometry_mode(const DeckReader& reader);

/// Reads a mode-1 geometry file into a validated scene with the deck conventions (full first kick, width of bare
/// segments).
/// @throws InputError with file, line and key, and what was found and expected
Scene read_geometry(const std::filesystem::path& path);
/// Reads a mode-1 geometry file and keeps the division into nseg1 and nseg2.
DeckGeometry read_deck_geometry(const std::filesystem::path& path);
/// Reads a mode-1 geometry file from an open reader.
DeckGeometry read_deck_geometry(DeckReader& reader);

/// Reads a mode-0 geometry file, for circles that are generated at random.
RandomGeometry read_random_geometry(const std::filesystem::path& path);
/// Reads a mode-0 geometry file from an open reader.
RandomGeometry read_random_geometry(DeckReader& reader);

/// Writes a mode-1 file. Numbers are written so that reading them gives identical values. Circle bodies come first,
/// then chains, each in scene order.
/// @param large_segments number of chain bodies, at the end, that are written as nseg2
/// @throws InputError for values that the format cannot represent: a damping ratio, a missing or infinitely distant
/// domain wall
void write_geometry(std::ostream& out, const Scene& scene, std::size_t large_segments = 0);

}  // namespace crackle
