// SPDX-License-Identifier: GPL-3.0-or-later
// Tests which values of the rock's law a joint replaces, and which it keeps.

#include "solver/contact/joint_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "solver/stepping/change_law.hpp"
#include "solver/stepping/step.hpp"
#include "tests/support/jointed_cells.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::joint_law_test {
namespace {

double tangent_of_degrees(double angle) { return std::tan(angle * std::numbers::pi / 180.0); }

ContactLaw rock_law() {
    ContactLaw law{};
    law.normal_stiffness = 5e9;
    law.shear_stiffness = 2e9;
    law.friction = tangent_of_degrees(30.0);
    law.bond_friction = tangent_of_degrees(35.0);
    law.tensile_strength = 2e6;
    law.cohesion = 6e6;
    return law;
}

TEST(JointLaw, OfAJointWithoutNumbersIsTheRocks) {
    const ContactLaw rock = rock_law(), law = law_across(rock, {}, {});
    EXPECT_EQ(law.friction, rock.friction);
    EXPECT_EQ(law.bond_friction, rock.bond_friction);
    EXPECT_EQ(law.tensile_strength, rock.tensile_strength);
    EXPECT_EQ(law.cohesion, rock.cohesion);
    EXPECT_EQ(law.normal_stiffness, rock.normal_stiffness);
    EXPECT_EQ(law.dilation, 0.0);
}

TEST(JointLaw, NumbersStandInPlaceOfTheRocks) {
    Joint joint;
    joint.strength_factor = 0.25;
    joint.friction_angle = 20.0;
    joint.dilation_angle = 4.0;
    ContactLaw law = law_across(rock_law(), joint, {});
    EXPECT_DOUBLE_EQ(law.tensile_strength, 0.5e6);
    EXPECT_DOUBLE_EQ(law.cohesion, 1.5e6);
    EXPECT_DOUBLE_EQ(law.bond_friction, tangent_of_degrees(20.0));
    EXPECT_DOUBLE_EQ(law.friction, tangent_of_degrees(20.0)) << "the residual friction is that of the joint";
    EXPECT_DOUBLE_EQ(law.dilation, tangent_of_degrees(4.0));
    joint.residual_friction_angle = 15.0;
    joint.tensile_strength = 0.0;
    joint.cohesion = 1e5;
    law = law_across(rock_law(), joint, {});
    EXPECT_DOUBLE_EQ(law.friction, tangent_of_degrees(15.0));
    EXPECT_EQ(law.tensile_strength, std::numeric_limits<double>::min()) << "holds without force, breaks when pulled";
    EXPECT_EQ(law.cohesion, 1e5);
    law = law_across(rock_law(), joint, {true, true, true});
    EXPECT_EQ(law.tensile_strength, 2e6) << "the rock's bonds do not break";
    EXPECT_EQ(law.friction, rock_law().friction);
}

TEST(JointLaw, StiffnessesAreInSeriesOverTheDistanceOfTheBodies) {
    Joint joint;
    joint.normal_stiffness = 1e12;
    constexpr double distance = 0.02;
    SeriesShares left = in_series_with(joint, rock_law(), distance);
    EXPECT_DOUBLE_EQ(left.normal, 1.0 / (1.0 + 5e9 / (1e12 * distance)));
    EXPECT_EQ(left.shear, 1.0);
    joint.shear_stiffness = 1e11;
    left = in_series_with(joint, rock_law(), distance);
    EXPECT_DOUBLE_EQ(left.shear, 1.0 / (1.0 + 2e9 / (1e11 * distance)));
    EXPECT_DOUBLE_EQ(left.root_of_shear(), std::sqrt(left.shear / left.normal));
    joint.normal_stiffness = joint.shear_stiffness = 1e30;
    left = in_series_with(joint, rock_law(), distance);
    EXPECT_EQ(left.normal, 1.0);
    EXPECT_EQ(left.shear, 1.0);
}

TEST(JointLaw, FollowsAChangeOfTheRocksWhereItHasNoneOfItsOwn) {
    testing::JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints.resize(1);
    cells.joints[0].friction_angle = 20.0;
    World world = jointed_world(cells);
    change_law(world, 0, 0, "cohesion", 9e6);
    change_law(world, 0, 0, "residual_friction_angle", 10.0);
    const ContactLaw& law = world.settings.laws[world.settings.joint_law(0, 0)];
    EXPECT_EQ(law.cohesion, 9e6);
    EXPECT_DOUBLE_EQ(law.friction, tangent_of_degrees(20.0));
}

TEST(JointLaw, ScenesWithJointsThatCannotBeAreRefused) {
    testing::JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.joints.resize(1);
    const auto refused = [&](auto change) {
        Scene scene = jointed_scene(cells);
        change(scene);
        return testing::refusal([&] { build_world(scene); });
    };
    const auto says = [](const std::string& text, const char* part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    says(refused([](Scene& s) {
             s.bond_law = BondLaw::back_tension, s.materials[0].tensile_strength = 0.0, s.materials[0].cohesion = 0.0;
         }),
         "expected the bond law \"coulomb\" or \"face\" and area units");
    says(refused([](Scene& s) { s.joints[0].aperture = 1e-6; }), "joint 1: aperture: found 1e-06, expected 0");
    says(refused([](Scene& s) { s.joints[0].bonded = false, s.joints[0].aperture = 1.0; }), "at most the thickness");
    says(refused([](Scene& s) { s.joints[0].dilation_angle = 31.0; }), "dilation angle: found 31");
    says(refused([](Scene& s) { s.joints[0].normal_stiffness = 0.0; }), "joint 1: normal stiffness");
    says(refused([](Scene& s) { s.joints[0].residual_friction_angle = 36.0; }), "residual friction angle: found 36");
    says(refused([](Scene& s) { s.trace_joints[0] = 1; }), "a joint that does not exist");
    says(refused([](Scene& s) { s.edge_sides.pop_back(); }), "sides of traces");
}

TEST(JointLaw, ATurnedOutlineKeepsItsFacesOnTraces) {
    testing::JointedCells cells;
    cells.above_row = {{1, 0}};
    cells.right_of_column = {{1, 0}};
    cells.joints.resize(1);
    cells.joints[0].strength_factor = 0.5;
    Scene scene = jointed_scene(cells);
    const World straight = build_world(scene);
    for (const Body& body : scene.bodies) {
        // The corners in clockwise order, starting at the same corner.
        const auto corners = scene.vertices.begin() + body.first_vertex;
        const auto sides = scene.edge_sides.begin() + body.first_vertex;
        std::reverse(corners + 1, corners + 4);
        std::reverse(sides, sides + 4);
    }
    const World turned = build_world(scene);
    const auto pairs_across = [](const World& world) {
        std::set<std::pair<int, int>> pairs;
        for (PointIndex k = 0; k < world.points.size(); ++k) {
            const ContactPoint point = world.points.contact[k];
            if (world.points.state[k].law >= world.settings.first_joint_law())
                pairs.insert(std::minmax(world.bodies.info(point.body_i).id, world.bodies.info(point.body_j).id));
        }
        return pairs;
    };
    EXPECT_EQ(pairs_across(turned), pairs_across(straight));
    EXPECT_FALSE(pairs_across(turned).empty());
    for (std::size_t e = 0; e < turned.bodies.element_sides.size(); ++e) {
        // The edge on the trace is still marked: for cells above the horizontal trace it is the lower edge, for cells
        // left of the vertical trace the right edge.
        const TraceSide side = turned.bodies.element_sides[e];
        if (side == no_side) continue;
        const Element &from = turned.bodies.elements[e], &to = turned.bodies.elements[e % 4 == 3 ? e - 3 : e + 1];
        const double middle = trace_of(side) == 0 ? from.y + to.y : -from.x - to.x;
        EXPECT_EQ(side % 2 == 0, middle < -1e-6) << e;
        EXPECT_EQ(side % 2 == 1, middle > 1e-6) << e;
    }
}

}  // namespace
}  // namespace crackle::joint_law_test
