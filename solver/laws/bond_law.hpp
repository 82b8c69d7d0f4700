// SPDX-License-Identifier: GPL-3.0-or-later
// The bond laws, and the facts about them that code outside the kernels needs. Each bond law is one type in a header of
// its own, listed in bond_laws.hpp.
// Tested by tests/solver/laws/bond_laws_test.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/names.hpp"
#include "solver/laws/bond_constants.hpp"

namespace crackle {

/// Strength and failure of bonds.
enum class BondLaw : std::uint8_t {
    back_tension,  ///< the DEMseg guide's law: the overlap at bonding determines the strength, and a bond may slide at
                   ///< its Coulomb limit (laws/back_tension_bond.hpp)
    coulomb,       ///< tension cut-off, cohesion and friction; no sliding before failure (laws/coulomb_bond.hpp)
    face           ///< one set of springs for a whole face between two polygons (laws/face_bond.hpp)
};

constexpr auto list_names(BondLaw) { return in_order("back_tension", "coulomb", "face"); }

/// Properties in which bond laws differ.
struct BondLawFacts {
    const char* meaning = "";                   ///< clause that describes the law in the text for the key bond.law
    std::span<const BondConstant> constants{};  ///< constants of the law's bonds that users give
    /// Member of ContactLaw that holds the coefficient computed from a material's friction angle. Unbonded contacts
    /// always use ContactLaw::friction.
    double ContactLaw::*friction = &ContactLaw::friction;
    /// Whether a material's tensile strength, cohesion and residual friction are given. Otherwise the strength follows
    /// from the overlap at bonding.
    bool strengths_are_given = false;
    bool bonds_across_gaps = false;  ///< whether a point can be bonded although its bodies do not touch
    /// Whether a bonded point never slides. Its shear stiffness is then greater than 0, and its world has friction.
    bool sticks = false;
    /// Whether forces are 0 at the point's Points::bond_overlap, while bonded and afterwards. Otherwise the bond adds a
    /// back-tension to the force of the contact.
    bool from_rest_overlap = false;
    bool own_shares = false;  ///< whether points have stiffness and strength factors for any choice of StiffnessUnits
    bool across_joints = false;        ///< whether joints can have bonds of this law
    bool with_guide_segments = false;  ///< whether the law can be combined with the DEMseg guide's segment law
    bool by_faces = false;             ///< whether whole faces are bonded (world/faces.hpp) instead of contact points
    /// Whether points store their forces in the last step in which they carried at least half their strength.
    bool remembers_strong_forces = false;

    /// The constant with this key, if the law has it.
    const BondConstant* constant(std::string_view key) const;
};

/// Facts of a law that is known only at run time. Kernels, compiled for one law, read the facts from its type.
const BondLawFacts& facts_of(BondLaw law);

/// The law that kernels apply to contact points in a world with the given law. In a world with bonded faces this is
/// `coulomb`: contact points that replace a face are unbonded and start without force, at a rest overlap.
constexpr BondLaw law_of_points(BondLaw law) { return law == BondLaw::face ? BondLaw::coulomb : law; }

/// Constants of all laws, each key once.
const std::vector<BondConstant>& all_bond_constants();

/// Names of the bond laws that have a given property, formatted for messages: "a" or "b".
std::string laws_with(bool BondLawFacts::*fact);

/// Checks the strengths of a law. @param what beginning of the message, for example the name of the material
/// @throws InputError for a tensile strength beyond_apex()
void check_strengths(const ContactLaw& law, const std::string& what);

}  // namespace crackle
