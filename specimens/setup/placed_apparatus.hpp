// SPDX-License-Identifier: GPL-3.0-or-later
// The parts that hold and drive a specimen, as bodies of the world, and the definitions of its stress and strain.
// Tested by tests/specimens/setup/setup_test.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/world/world.hpp"
#include "specimens/kinds/test_kind.hpp"
#include "specimens/setup/platen.hpp"

namespace crackle {

/// A rigid body that holds or drives the specimen.
struct SetupPart {
    BodyIndex body = 0;
    std::uint32_t face = 2;  ///< number of corners, from the first, that form its face; only the face is drawn
    bool wall = false;       ///< whether it presses on a side instead of holding or driving the specimen

    CRACKLE_FIELDS(body, face, wall);
};

/// The parts of a test in the world, and the lengths by which their forces and displacements are divided to obtain
/// stress and strain.
struct PlacedApparatus {
    LoadingKind kind = LoadingKind::compression;
    /// Whether stress and strain describe the rock, as in TestKind; false for the Brazilian test, for example.
    bool uniaxial = true;
    bool compression = true;             ///< whether the driving part moves in the negative direction of its axis
    int axis = 1;                        ///< axis along which the driving part moves: 0 x, 1 y
    double section = 0.0, length = 0.0;  // divisors for nominal stress and strain, m, as in Apparatus
    double stress_intensity = 0.0;       ///< sqrt(m), K_I divided by the nominal stress; 0 without a notch
    double span = 0.0;                   // m; 0 if absent
    double normal_force = 0.0;           // force on the driving part perpendicular to its motion, N
    double normal_spring = 0.0;          // N/m; increase of the normal force per rise of the driving part
    int bottom_id = 0, top_id = 0;       // ids as in the outputs
    BodyIndex bottom = 0, top = 0;       // indices of the first support and the driving part in the world
    std::vector<SetupPart> parts;        ///< all parts: a support first, the driving part last
    double top_start = 0.0;              // m, initial coordinate of the driving part's centroid along its axis
    double top_height = 0.0;             // m, initial y of the driving part's centroid
    double confining_pressure = 0.0;     // pressure on the sides, N/m; 0: no pressure

    /// Whether a pressure acts on the specimen's sides.
    bool confined() const { return confining_pressure > 0.0; }
    /// Whether walls press on the specimen's sides.
    bool has_walls() const { return std::ranges::any_of(parts, &SetupPart::wall); }
    /// Whether a pressure or normal force does work on the specimen, in addition to the driving part.
    bool pressed() const { return confined() || test_kind(kind).shear_box; }
    /// Whether a body holds or drives the specimen.
    bool is_platen(BodyIndex body) const {
        return std::ranges::any_of(parts, [&](const SetupPart& part) { return part.body == body; });
    }
    /// 1 if the driving part moves in the negative direction of its axis, else -1.
    double sense() const { return compression ? 1.0 : -1.0; }
    /// Displacement of the driving part along its axis divided by `length`; positive in the direction of loading.
    double axial_strain(const World& world) const;
    /// Makes the driving part's current position the reference for strains.
    void strains_begin_at(const World& world);
};

/// Finds the parts in the world. Requires that they are in place.
PlacedApparatus place_apparatus(const World& world, const Platens& platens, LoadingKind kind);

/// Forces on the driving part and on all supports, along the driving part's axis, N. Requires compute_forces().
struct PartForces {
    double driver = 0.0, supports = 0.0;
};
/// Forces on the parts from the last compute_forces(), N.
PartForces forces_on_parts(const World& world, const PlacedApparatus& apparatus);

}  // namespace crackle
