// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/allocation_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "solver/faces/bond_faces.hpp"
#include "solver/scene/bond_strength.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Which points are bonded, and the strengths of the bonds.
struct Bonding {
    double thick = 0.0;  ///< segment thickness, m
    /// Largest gap at which two discs are bonded, as a fraction of their mean radius; bonds across a gap have δ0 < 0.
    double range = 0.0;
    /// Largest gap at which a corner and an outline are bonded, m. Each point has its own δ0.
    double gap = 0.0;
    StrengthFactors factors;
    /// Strengths of a law with BondLawFacts::strengths_are_given, as factors on the mean of k_n δ0 over all bonds; they
    /// replace the materials' strengths.
    std::optional<double> tensile_factor, cohesion_factor;
    /// Whether the bond at a given position between two bodies is unbreakable. If not set, all bonds can break.
    std::function<bool(Vec2 position, BodyIndex i, BodyIndex j)> holds;
    /// Whether two bodies are left unbonded, as if their bonds had already broken; only with
    /// BondLawFacts::from_rest_overlap. If not set, all are bonded.
    std::function<bool(BodyIndex i, BodyIndex j)> leaves;
    /// Whether linear solutions treat open joints without an aperture as closed and sticking, as under compression.
    bool pressed = true;
};

/// Bonds points between bodies, after setting the segment thickness. For back-tension bonds the overlap δ must be > 0.
/// Each bonded point gets δ0 = δ, and its shear force is set to 0. Contacts with walls are not bonded, nor are the
/// faces of open joints. Such faces transmit pressure and friction from their current positions on, after the joint's
/// aperture has closed. @return the number of bonded points
/// @throws InputError if the resulting strengths have μT > C, or if strength factors are given but the mean
/// back-tension is not positive
std::int64_t bond_all(World& world, const Bonding& bonding);
/// Bonds points with a given segment thickness, m, and otherwise default values.
std::int64_t bond_all(World& world, double thick);
/// Bonds the polygons of a world by faces, BondLaw::face. @return the number of faces that are intact
/// @throws InputError under the same conditions as bond_faces()
std::int64_t bond_by_faces(World& world, const FaceBonding& bonding, FaceQuality* quality = nullptr);
/// Bonds points between the given pairs of bodies if they are unbonded and have an overlap above -gap. Strengths that
/// are not given follow from the overlap, as in bond_all(). The energy stored in the springs of these points is
/// discarded, and the energy account restarts. @return the number of bonded points
/// @throws InputError if a body is paired with itself, if bonds of the pair already share its face
/// (Settings::own_shares()), or if gap > 0 without BondLawFacts::bonds_across_gaps @throws UnstableRun if a given time
/// step is too large for the new bonds
std::int64_t bond_pairs(World& world, std::span<const BodyPair> pairs, double gap);
/// Completes bonding after bonds have been written to the points (flags, bond_overlap), by bond_all() or from a file of
/// back-tensions. It counts the bonds, clears values stored before bonding, and restarts the energy account.
void finish_bonding(World& world);
/// Changes the segment thickness and invalidates the neighbour list.
void set_thickness(World& world, double thick);

}  // namespace crackle
