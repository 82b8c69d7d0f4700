// SPDX-License-Identifier: GPL-3.0-or-later
// The bond laws, and the facts about them that code outside the kernels needs. Each law is one header with one type,
// listed in bond_laws.hpp.
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
    back_tension,  ///< the guide's law: the overlap at bonding determines the strength, and a bond may slide at its
                   ///< Coulomb limit (laws/back_tension_bond.hpp)
    coulomb,       ///< tension cut-off, cohesion and friction; no sliding before failure (laws/coulomb_bond.hpp)
    face           ///< one set of springs for a whole face between two polygons (laws/face_bond.hpp)
};

constexpr auto list_names(BondLaw) { return in_order("back_tension", "coulomb", "face"); }

/// Properties in which bond laws differ.
struct BondLawFacts {
    const char* meaning = "";                   ///< a clause for the key bond.law
    std::span<const BondConstant> constants{};  ///< constants of its bonds that users give
    /// Member for the coefficient that follows from a material's friction angle. Unbonded contacts always use
    /// ContactLaw::friction.
    double ContactLaw::*friction = &ContactLaw::friction;
    /// Whether materials state tensile strength, cohesion and residual friction. Otherwise strength follows from the
    /// overlap at bonding.
    bool strengths_are_given = false;
    bool bonds_across_gaps = false;  ///< whether a point with a gap can be bonded
    /// Whether a bonded point never slides. Its shear stiffness is then greater than 0, and its world has friction.
    bool sticks = false;
    /// Whether forces are 0 at the point's Points::bond_overlap, while bonded and afterwards. Otherwise the bond adds a
    /// back-tension to the force of the contact.
    bool from_rest_overlap = false;
    bool own_shares = false;           ///< whether points have stiffness and strength factors with either of
                                       ///< StiffnessUnits
    bool across_joints = false;        ///< whether joints can have bonds of this law
    bool with_guide_segments = false;  ///< whether it can be combined with the guide's segment law
    bool by_faces = false;             ///< whether whole faces are bonded (world/faces.hpp), and no points
    /// Whether a point remembers its forces in the last step in which it carried at least half its strength.
    bool remembers_strong_forces = false;

    /// The constant with this key, if the law has it.
    const BondConstant* constant(std::string_view key) const;
};

/// Facts of a law of a scene. Kernels read them from the law's type.
const BondLawFacts& facts_of(BondLaw law);

/// The law by which kernels treat points in a world of this law. With faces it is that of points whose bonds have
/// broken: they start without force where they take over from a face.
constexpr BondLaw law_of_points(BondLaw law) { return law == BondLaw::face ? BondLaw::coulomb : law; }

/// Constants of all laws, each key once.
const std::vector<BondConstant>& all_bond_constants();

/// Names of the bond laws for which `fact` is true, formatted for messages: "a" or "b".
std::string laws_with(bool BondLawFacts::*fact);

/// Checks the strengths of a law. @param what names their owner, for the message @throws InputError for a tensile
/// strength beyond_apex()
void check_strengths(const ContactLaw& law, const std::string& what);

}  // namespace crackle
