// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the kinds of test: formulas against published values, shapes and parts, and refusals. Closed forms of discs and
// beams are claims (tests/bench/verify/laboratory).

#include "specimens/kinds/test_kind.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/errors.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "tests/bench/verify/scenes/lattice_case.hpp"
#include "tests/support/claim.hpp"

namespace crackle::test_kind_test {
namespace {

using testing::within;

constexpr double degree = std::numbers::pi / 180.0;

TEST(TestKinds, TheCaseKnowsEveryKindByItsName) {
    EXPECT_EQ(find_parameter("loading", "kind")->choices, names_of<LoadingKind>());
    for (const std::string& name : names_of<LoadingKind>()) {
        const LoadingKind value = *from_name<LoadingKind>(name);
        const TestKind& kind = test_kind(value);
        EXPECT_EQ(kind.apparatus == nullptr, kind.uniaxial) << name;
        for (const KindKey& one : kind.keys) {
            const std::string key = one.key, table = key.substr(0, key.find('.'));
            EXPECT_NE(find_parameter(table, key.substr(table.size() + 1)), nullptr) << name << ": " << key;
        }
        EXPECT_EQ(kind.valid_failure == ValidFailure::between_platens, kind.uniaxial) << name;
    }
}

TEST(TestKinds, FormulasHaveTheirPublishedValues) {
    // The tolerance of 5e-5 is half of the last digit given.
    const double beam[][2] = {{0.2, 1.1749}, {0.3, 1.5212}, {0.4, 1.9818}, {0.5, 2.6625}};
    for (const auto& [ratio, expected] : beam)
        EXPECT_TRUE(within(fmt::format("f({})", ratio), notched_beam_factor(ratio), expected, 5e-5));
    const double half_disc[][2] = {{0.4, 2.905}, {0.5, 3.680}, {0.6, 4.820}};
    for (const auto& [ratio, expected] : half_disc)
        EXPECT_TRUE(within(fmt::format("Y'({})", ratio), semicircle_factor(ratio, 0.5), expected, 5e-4));
    const double disc[][2] = {{0.5, 0.9999}, {5.0, 0.9911}, {7.5, 0.9800}, {10.0, 0.9645}, {15.0, 0.9203}};
    for (const auto& [angle, expected] : disc)
        EXPECT_TRUE(within(fmt::format("k({})", angle), brazilian_factor(angle * degree), expected, 1e-4));
}

TEST(TestKinds, ANotchPartsWhatLiesOnEitherSideOfIt) {
    const Notch notch{{0.0, -1.0}, {0.0, 1.0}};
    EXPECT_TRUE(notch.parts({-1.0, 0.0}, {1.0, 0.5}));
    EXPECT_FALSE(notch.parts({-1.0, 1.5}, {1.0, 1.5}));  // above the tip of the notch
    EXPECT_FALSE(notch.parts({-1.0, 0.0}, {-0.5, 0.5}));
    EXPECT_EQ(notch.distance({0.5, 0.0}), 0.5);
    EXPECT_EQ(notch.distance({0.0, 2.0}), 1.0);
}

/// Checks that jaws are at the positions given by the parts of a test: the outline and the face of each jaw differ by
/// the distance at which contact begins.
TEST(TestKinds, JawsThatAreNotBondedJustTouchTheDisc) {
    ResolvedCase test;
    test.loading.kind = LoadingKind::brazilian;
    test.loading.platens = PlatenKind::frictional;
    constexpr double reach = 1e-5;
    KindRequest request{test, {0.0, 0.1, 0.0, 0.1, {}}, 0.005};
    const TestKind& disc = test_kind(LoadingKind::brazilian);
    const Shape shape = disc.shape(request);
    for (const Vec2 corner : shape.outline) request.surface.push_back({corner, reach});
    for (const JawShape jaws : {JawShape::arc, JawShape::flat, JawShape::curved}) {
        test.loading.jaws = jaws;
        const Apparatus apparatus = disc.apparatus(request, shape);
        ASSERT_EQ(apparatus.parts.size(), 2U);
        for (const LoadingPart& part : apparatus.parts) {
            double nearest = 1e300;
            for (std::uint32_t k = 0; k + 1 < part.face; ++k)
                for (const Vec2 corner : shape.outline)
                    nearest = std::min(nearest, Notch{part.corners[k], part.corners[k + 1]}.distance(corner));
            // The jaw allows for the whole depth of a cell's side, of which a corner uses only a part: 1/8
            // (side/radius)².
            EXPECT_GE(nearest, reach * (1.0 - 1e-9)) << name_of(jaws);
            EXPECT_LE(nearest, reach + 1e-4 * shape.width) << name_of(jaws);
        }
    }
}

VirtualTest prepared(int columns, int rows, const std::string& loading) {
    return verification::LatticeCase{.columns = columns, .rows = rows, .loading = loading}.bonded();
}

TEST(TestKinds, SupportsOfABeamCarryHalfTheLoadEachAndNoThrust) {
    const VirtualTest test = prepared(100, 21,
                                      "[loading]\nkind = \"bending\"\npad_width = 0.008\naxial_strain_rate = 0.01\n"
                                      "max_axial_strain = 0.001\n");
    ASSERT_TRUE(test.small_strain);
    const std::vector<BodyMotion>& reaction = test.small_strain->moduli.solution.reaction;
    ASSERT_EQ(reaction.size(), 3U);
    const double load = reaction.back().y;
    // The lattice is symmetric about midspan, except that odd rows are half a disc shorter at both ends.
    EXPECT_TRUE(within("left support over the load", -reaction[0].y / load, 0.5, 1e-3));
    EXPECT_TRUE(within("right support over the load", -reaction[1].y / load, 0.5, 1e-3));
    for (const BodyMotion& one : reaction) EXPECT_TRUE(within("thrust over the load", one.x / load, 0.0, 1e-6));
    for (const BodyMotion& one : reaction)
        EXPECT_TRUE(
            within("moment over load and depth", one.rotation / (load * test.setup.specimen.height), 0.0, 1e-6));
}

TEST(TestKinds, BadInputOfAKindIsRefusedByName) {
    const std::string rest = "axial_strain_rate = 0.01\nmax_axial_strain = 0.001\n";
    const std::string cases[][2] = {
        {"[shape]\ndiameter = 1.0\n[loading]\nkind = \"brazilian\"\n" + rest, "shape.diameter: found 1 m"},
        {"[shape]\nnotch = 1.0\n[loading]\nkind = \"bending\"\n" + rest, "shape.notch: found 1 m"},
        {"[loading]\nkind = \"bending\"\nspan = 1.0\n" + rest, "loading.span: found 1 m"},
        {"[loading]\nkind = \"scb\"\nspan = 0.001\n" + rest, "loading.span: found 0.001 m"},
        {"[shape]\nnotch = 0.001\n[loading]\nkind = \"scb\"\n" + rest, "shape.notch: found 0.001 m"},
        {"[loading]\nkind = \"direct_shear\"\n" + rest, "loading.normal_stress: found nothing"},
        {"[loading]\nkind = \"direct_shear\"\nnormal_stress = -1\n" + rest, "loading.normal_stress: found -1"},
        {"[loading]\nkind = \"direct_shear\"\nnormal_stress = 1\nbox_gap = 0.5\n" + rest,
         "loading.box_gap: found 0.5 m"},
        {"[loading]\nkind = \"bending\"\nplatens = \"frictional\"\nplaten_friction_angle = 10\n" + rest,
         "loading.platens: found \"frictional\""},
        {"[loading]\nkind = \"compression\"\nspan = 0.1\n" + rest,
         "loading.span needs loading.kind = \"bending\" or \"scb\""},
        {"[loading]\nkind = \"brazilian\"\njaws = \"flat\"\n" + rest, "loading.jaws: found \"flat\""},
    };
    for (const auto& [loading, expected] : cases) {
        try {
            prepared(40, 21, loading);
            FAIL() << "not refused: " << loading;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(expected), std::string::npos)
                << "expected " << expected << ", got " << error.what();
        }
    }
}

}  // namespace
}  // namespace crackle::test_kind_test
