// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "specimens/calibration/judgement.hpp"
#include "specimens/campaign/plan.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/emission/source.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/measures/parting.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/support/named_values.hpp"

namespace crackle {
namespace {

TEST(Choices, OfACaseAndItsResultsHaveNamesThatLeadThereAndBack) {
    testing::expect_names_of<RadiusLaw, MeshKind, Boundary, MineralAssignment, JointSection, JointOrientation,
                             JointLength, JointSpacing, LoadingKind, PlatenKind, JawShape, LoadingControl,
                             ConfiningSide, FramePrecision>();
    testing::expect_names_of<SpecimenKind, PartingPlace, Recording::Kind, SourceType, Spacing, Sequence, Keep, Variant,
                             TargetVerdict>();
}

/// Tests that every word accepted by a key is written back unchanged.
TEST(Choices, OfEveryKeyAreSetAndReadByTheirNames) {
    std::size_t keys = 0;
    for (const Parameter& p : case_parameters()) {
        if (p.choices.empty()) continue;
        ++keys;
        TestCase test;
        test.joint_set.resize(1);
        for (const std::string& word : p.choices) {
            p.set(test, word, 0);
            EXPECT_EQ(std::get<std::string>(p.get(test, 0).value()), word) << p.full_key();
        }
    }
    EXPECT_EQ(keys, 19U);
}

}  // namespace
}  // namespace crackle
