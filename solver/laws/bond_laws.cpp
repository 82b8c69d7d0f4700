// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/laws/bond_laws.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"

namespace crackle {

const BondConstant* BondLawFacts::constant(std::string_view key) const {
    const auto found = std::ranges::find(constants, key, &BondConstant::key);
    return found == constants.end() ? nullptr : &*found;
}

const BondLawFacts& facts_of(BondLaw law) { return known_facts(law); }

const std::vector<BondConstant>& all_bond_constants() {
    static const std::vector<BondConstant> all = [] {
        std::vector<BondConstant> found;
        for (std::size_t law = 0; law < table_of_names<BondLaw>.size(); ++law)
            for (const BondConstant& one : facts_of(static_cast<BondLaw>(law)).constants)
                if (std::ranges::count(found, std::string_view(one.key), &BondConstant::key) == 0) found.push_back(one);
        return found;
    }();
    return all;
}

std::string laws_with(bool BondLawFacts::*fact) {
    std::string names;
    for (std::size_t law = 0; law < table_of_names<BondLaw>.size(); ++law)
        if (facts_of(static_cast<BondLaw>(law)).*fact)
            names += fmt::format("{}\"{}\"", names.empty() ? "" : " or ", name_of(static_cast<BondLaw>(law)));
    return names;
}

void check_strengths(const ContactLaw& law, const std::string& what) {
    if (!beyond_apex(law.bond_friction, law.tensile_strength, law.cohesion)) return;
    throw InputError(
        fmt::format("{}: found a tensile strength of {:.6g} beyond the apex of the envelope, cohesion over friction, "
                    "{:.6g}, expected at most that; give more cohesion, or less tensile strength",
                    what, law.tensile_strength, law.cohesion / law.bond_friction));
}

}  // namespace crackle
