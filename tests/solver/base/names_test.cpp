// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/names.hpp"

#include <gtest/gtest.h>

#include "solver/base/errors.hpp"
#include "solver/base/instruction_set.hpp"
#include "solver/scene/bond_strength.hpp"
#include "solver/scene/scene.hpp"
#include "tests/support/named_values.hpp"

namespace crackle {
namespace {

TEST(Names, OfTheSolverLeadThereAndBack) {
    testing::expect_names_of<SegmentLaw, BondLaw, StiffnessUnits, Integrator, StrengthDistribution, InstructionSet>();
    static_assert(!HasNames<Wall>);
    static_assert(is_known(StiffnessUnits::area) && !is_known(static_cast<StiffnessUnits>(2)));
}

TEST(Names, StandInAnErrorInTheirOrder) {
    EXPECT_EQ(value_named<SegmentLaw>("--law", "demseg_mean"), SegmentLaw::demseg_mean);
    try {
        value_named<SegmentLaw>("--law", "Rounded");
        FAIL() << "found a law of that name";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--law: found \"Rounded\", expected \"rounded\", \"demseg\" or \"demseg_mean\"");
    }
    try {
        value_named<BondLaw>("bond.law", "");
        FAIL() << "found a law without a name";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "bond.law: found \"\", expected \"back_tension\", \"coulomb\" or \"face\"");
    }
}

}  // namespace
}  // namespace crackle
