// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/stepping/allocation_test.cpp.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "solver/scene/bond_strength.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Which points are bonded, and how strongly.
struct Bonding {
    double thick = 0.0;  ///< segment thickness, m
    /// Share of the mean radius of two discs up to whose gap they are bonded; such bonds have δ0 < 0.
    double range = 0.0;
    /// m; corners whose gap to an outline is at most this are bonded, at their own δ0.
    double gap = 0.0;
    StrengthFactors factors;
    /// Strengths of BondLaw::coulomb as factors of k_n δ0 averaged over all bonds, in place of the materials' own.
    std::optional<double> tensile_factor, cohesion_factor;
    /// Whether a bond at a place between two bodies can never break; none where not given.
    std::function<bool(Vec2 position, BodyIndex i, BodyIndex j)> holds;
    /// Whether two bodies are left without bonds, as if theirs had broken, under BondLaw::coulomb; none where not
    /// given.
    std::function<bool(BodyIndex i, BodyIndex j)> leaves;
    /// Whether linear solutions take open joints without an aperture for closed and sticking, as under pressure.
    bool pressed = true;
};

/// Bonds points between bodies, by back-tension those of overlap δ > 0; each gets δ0 = δ and loses its shear spring.
/// Walls stay unbonded, as do the faces of open joints, which may push and rub from where they lie, once an aperture
/// has closed. Sets the segment thickness first. @return points bonded.
/// @throws InputError where the strengths that result have μT > C, and factors that no mean overlap makes a strength of
std::int64_t bond_all(World& world, const Bonding& bonding);
std::int64_t bond_all(World& world, double thick);
/// Bonds the points of these pairs of bodies that have no bond, where the overlap is more than -gap: as bond_all()
/// does, by back-tension as strong as they overlap, under BondLaw::coulomb with the laws' own strengths. What their
/// springs have stored until then is gone: the account of energy begins again. @return points bonded
/// @throws InputError for a pair of one body, one with bonds that share its face (Settings::own_shares()), and a gap >
/// 0 under back-tension, whose bonds would have a strength < 0; UnstableRun where a given time step is too large for
/// them
std::int64_t bond_pairs(World& world, std::span<const BodyPair> pairs, double gap);
/// After bonds have been entered in the points (flags, bond_overlap), by bond_all() or a reader of back-tensions:
/// counts them, clears what was remembered of the time before, and starts the account of energy again.
void finish_bonding(World& world);
/// Changes the segment thickness and invalidates the list.
void set_thickness(World& world, double thick);

}  // namespace crackle
