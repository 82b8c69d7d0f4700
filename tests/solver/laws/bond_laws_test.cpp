// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/laws/bond_laws.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(BondLaws, EachValueHasItsTypeAndItsFacts) {
    for (std::size_t n = 0; n < bond_laws; ++n) {
        const auto law = static_cast<BondLaw>(n);
        EXPECT_EQ(with_law(law, []<class Bond>() { return Bond::law; }), law);
        EXPECT_EQ(with_law(law, []<class Bond>() { return &Bond::facts; }), &facts_of(law)) << name_of(law);
    }
    EXPECT_TRUE(facts_of(BondLaw::coulomb).strengths_are_given);
    EXPECT_FALSE(facts_of(BondLaw::back_tension).strengths_are_given);
}

}  // namespace
}  // namespace crackle
