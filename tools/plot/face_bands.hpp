// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of faces as bands across them. With n the normal of a face, t = n turned by +90°, σ the normal stress there
// (compression positive) and τ the mean shear stress, a point of the face is drawn from -v to v with
//     v = reach (σ n - τ t)
// The sides of a band are thus parallel to the force, its width is the normal stress, a trapezoid shows the moment, and
// a slant the shear. Where σ changes its sign, the band ends and a band of the other colour begins.
// Tested by tests/tools/plot/face_bands_test.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "solver/base/vec2.hpp"
#include "specimens/recordings/recording.hpp"
#include "tools/plot/canvas.hpp"

namespace crackle::plot {

/// Colours of contact forces on the report page (tools/viewer/src/colours/theme.ts).
inline const Colour compressive_colour = colour("#1d2125"), tensile_colour = colour("#cc3d8f");

/// A face and its stress at one moment.
struct FaceBand {
    Vec2 begin, end;                                   // m
    double at_begin = 0.0, at_end = 0.0, shear = 0.0;  // N/m: σ at both ends, τ
    bool broken = false;                               ///< whether the face is broken and carries no tension

    /// Largest stress at the ends of the face, N/m.
    double largest() const { return std::hypot(std::max(std::abs(at_begin), std::abs(at_end)), shear); }
};

/// Part of a band, with one sign of the normal stress.
struct BandPart {
    std::vector<Vec2> corners;  // m
    bool compression = true;
};

/// The band of a face in a frame, with the given ends; empty if the face is open or has no length. @param bond index
/// into Recording::bonds
std::optional<FaceBand> face_band(const RecordedFrame& frame, std::size_t bond, Vec2 begin, Vec2 end);

/// Colour of the inside of a band, lighter than its edge.
Colour band_fill(bool compression);

/// The parts of a band to draw. @param reach m per N/m
std::vector<BandPart> parts_of(const FaceBand& band, double reach);

/// Stress that is exceeded at only a few ends of faces, N/m; 0 without bands.
double high_stress(const std::vector<const FaceBand*>& bands);

/// Whether a test's frames have the stresses of faces.
bool has_faces(const Recording& recording);

}  // namespace crackle::plot
