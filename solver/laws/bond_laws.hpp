// SPDX-License-Identifier: GPL-3.0-or-later
// The list of bond laws. A law is a type with static members, in a header of its own:
//
//     law                     its BondLaw
//     facts                   BondLawFacts
//     fails()                 whether the bonds of one point, or of several in lanes, break in this step
//     with_back_tension()     normal force of a bonded point
//     shear_limit()           largest shear force of every point of a world with bonds, bonded or not
//     carries_half_strength() whether a bond carries at least half its strength; only with remembers_strong_forces
//     break_bond()            state and forces after a break, and the energy released. It is called twice: in the
//                             force pass, without BondMemory, for the remaining forces; for the event, with it.
//                             Forces must not depend on the memory
//     elastic_limits()        strains at which a bond breaks or slides in a linear solution
//
// A new law needs a value and a name in BondLaw, a header, and an entry in BondLaws. Kernels are compiled for every
// law.
//
// The law of faces between polygons (face_bond.hpp) is not in the list, since it bonds no contact points, so the
// kernels for points are not compiled for it.
#pragma once

#include <cstddef>
#include <tuple>

#include "solver/laws/back_tension_bond.hpp"
#include "solver/laws/bond_law.hpp"
#include "solver/laws/coulomb_bond.hpp"
#include "solver/laws/face_bond.hpp"

namespace crackle {

/// The types of all laws that bond points, in the order of the first enumerators of BondLaw.
using BondLaws = std::tuple<BackTensionBond, CoulombBond>;
inline constexpr std::size_t bond_laws = std::tuple_size_v<BondLaws>;
static_assert(bond_laws == static_cast<std::size_t>(BondLaw::face));

/// Whether every law whose facts refer to values of a point keeps such values.
template <class... Bonds>
constexpr bool points_have_what_facts_need(const std::tuple<Bonds...>&) {
    return ((Bonds::facts.own_shares || !(Bonds::facts.strengths_are_given || Bonds::facts.from_rest_overlap)) && ...);
}
static_assert(points_have_what_facts_need(BondLaws{}),
              "a law with strengths_are_given or from_rest_overlap must also have own_shares");

/// The type that implements a law.
template <BondLaw law>
using BondLawType = std::tuple_element_t<static_cast<std::size_t>(law), BondLaws>;

/// Calls visit's template operator() with the type of law_of_points(), and returns its result. @tparam N index of the
/// first law to try
template <std::size_t N = 0, class Visit>
constexpr decltype(auto) with_law(BondLaw law, const Visit& visit) {
    using Bond = std::tuple_element_t<N, BondLaws>;
    static_assert(static_cast<std::size_t>(Bond::law) == N);
    if constexpr (N + 1 < bond_laws) {
        if (law_of_points(law) != Bond::law) return with_law<N + 1>(law, visit);
    }
    return visit.template operator()<Bond>();
}

/// Like facts_of(), but usable in constant expressions.
constexpr const BondLawFacts& known_facts(BondLaw law) {
    if (law == BondLaw::face) return FaceBond::facts;
    return with_law(law, []<class Bond>() -> const BondLawFacts& { return Bond::facts; });
}

/// The first bond law that has a given property.
constexpr BondLaw first_law_with(bool BondLawFacts::*fact) {
    std::size_t n = 0;
    while (!(known_facts(static_cast<BondLaw>(n)).*fact)) ++n;
    return static_cast<BondLaw>(n);
}

}  // namespace crackle
