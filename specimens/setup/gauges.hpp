// SPDX-License-Identifier: GPL-3.0-or-later
// Gauge lengths of a specimen: the particles at their ends, and the initial distances between them.
// Tested by tests/specimens/setup/setup_test.cpp.
#pragma once

#include <span>
#include <vector>

#include "solver/world/world.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/setup/trace_faces.hpp"

namespace crackle {

/// The bodies at the ends of the two gauge lengths.
struct Gauges {
    std::vector<BodyIndex> left, right;  ///< bodies on each side, in the middle half of the height
    double lateral_length = 0.0;         ///< m, initial distance between the mean x of both sides; 0 if one is empty
    /// Bonded particles at the two ends of the axial gauge length. The gauge length excludes the grips or, without
    /// grips, the outer tenths of the specimen.
    std::vector<BodyIndex> bottom, top;
    double axial_length = 0.0;  ///< m, initial distance between the mean y of the ends; 0 if an end has no particles

    /// Finds the bodies on the sides. @param uniaxial  only those in the middle half of the height, away from platens
    void find_sides(const World& world, const Specimen& specimen, bool uniaxial);
    /// Finds the bodies whose centres lie within half a particle size of the ends of the axial gauge length.
    /// @param low, high  m, y of the ends @param particle  m, mean size
    void find_ends(const World& world, std::span<const BodyIndex> bodies, double low, double high, double particle);

    /// Relative increase of the mean width; NaN if a side has no particles.
    double lateral_strain(const World& world) const;
    /// As lateral_strain(), with medians of the displacements since the start instead of means, so that particles that
    /// have broken off do not affect it.
    double median_lateral_strain(const World& world, std::span<const StartPlace> start) const;
    /// Relative increase of the mean distance between the axial gauge's ends; NaN if an end has no particles.
    double axial_growth(const World& world) const;
    /// Makes the current distances the reference for strains.
    void strains_begin_at(const World& world);
};

}  // namespace crackle
