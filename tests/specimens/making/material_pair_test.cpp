// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the laws of contacts between two materials: which values a table for the pair replaces.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::odd_stiffness;

TEST(MaterialPair, OverridesStiffnessFrictionAndTheDashpotsThatHangOnIt) {
    Scene scene = disc_chain(3, 0.02, 0.0399, undamped_rock(1e7, 30.0));
    Material other = undamped_rock(4e7, 20.0);
    scene.materials[0].damping_ratio = 0.1;
    other.damping_ratio = 0.1;
    scene.materials.push_back(other);
    scene.bodies[1].material = 1;
    scene.bodies[2].material = 1;
    scene.material_pairs = {{1, 0, 5e6, 3e6, 35.0}};
    const World world = build_world(scene);
    const auto law = [&](int a, int b) {
        const auto of_id = [&](int id) {
            std::size_t body = 0;
            while (world.bodies.info(body).id != id) ++body;
            return static_cast<BodyIndex>(body);
        };
        return world.settings.laws[law_between(world, of_id(a), of_id(b))];
    };
    for (const auto& [a, b] : {std::pair(1, 2), std::pair(2, 1)}) {
        EXPECT_EQ(law(a, b).normal_stiffness, 5e6);
        EXPECT_EQ(law(a, b).shear_stiffness, 3e6);
        EXPECT_EQ(law(a, b).friction, std::tan(35.0 * std::numbers::pi / 180.0));
        EXPECT_EQ(law(a, b).normal_damping_ratio_term, 2.0 * 0.1 * std::sqrt(5e6));
        EXPECT_EQ(law(a, b).shear_damping_ratio_term, 2.0 * 0.1 * std::sqrt(3e6));
    }
    EXPECT_EQ(law(2, 3).normal_stiffness, 4e7) << "within the other material";
    EXPECT_EQ(law(2, 3).friction, std::tan(20.0 * std::numbers::pi / 180.0));
}

TEST(MaterialPair, OverridesTheStrengthsOfCoulombBonds) {
    Scene scene = disc_chain(3, 0.02, 0.0399, undamped_rock(1e7, 30.0));
    scene.bond_law = BondLaw::coulomb;
    Material& first = scene.materials[0];
    first.tensile_strength = 10.0, first.cohesion = 50.0, first.residual_friction_angle = 25.0;
    Material other = first;
    other.tensile_strength = 20.0, other.cohesion = 40.0, other.residual_friction_angle = 20.0;
    scene.materials.push_back(other);
    scene.bodies[1].material = 1;
    const auto law = [&] { return build_world(scene).settings.laws[1]; };  // law between the two materials
    const auto tangent = [](double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); };
    EXPECT_EQ(law().tensile_strength, 10.0) << "the weaker";
    EXPECT_EQ(law().cohesion, 40.0);
    EXPECT_EQ(law().friction, tangent(20.0));
    MaterialPair pair{1, 0};
    pair.bond = {30.0, 60.0, 28.0};
    scene.material_pairs = {pair};
    EXPECT_EQ(law().tensile_strength, 30.0);
    EXPECT_EQ(law().cohesion, 60.0);
    EXPECT_EQ(law().friction, tangent(28.0));
    EXPECT_EQ(law().bond_friction, tangent(30.0));
    scene.material_pairs[0].bond.residual_friction_angle = 31.0;
    EXPECT_NE(testing::refusal([&] { validate(scene); }).find("material pair 1: residual friction angle: found 31"),
              std::string::npos);
    scene.material_pairs[0] = {1, 0, {}, {}, {}, {{}, -1.0, {}}};
    EXPECT_NE(testing::refusal([&] { validate(scene); }).find("material pair 1: cohesion: found -1"),
              std::string::npos);
    scene.material_pairs[0] = {1, 0, {}, 0.0};
    EXPECT_NE(testing::refusal([&] { validate(scene); }).find("shear stiffness: found 0 with coulomb bonds"),
              std::string::npos);
    scene.material_pairs[0] = {1, 0, {}, {}, {}, {1.0, {}, {}}};
    scene.bond_law = BondLaw::back_tension;
    scene.materials[0].tensile_strength = scene.materials[0].cohesion = 0.0;
    scene.materials[1] = scene.materials[0];
    EXPECT_NE(testing::refusal([&] { validate(scene); }).find("expected the bond law \"coulomb\""), std::string::npos);
}

TEST(MaterialPair, OfEqualStiffnessHasItToTheBit) {
    Scene scene = disc_chain(2, 0.02, 0.0399, undamped_rock(odd_stiffness, 30.0, 1.0));
    scene.materials.push_back(scene.materials[0]);
    scene.bodies[1].material = 1;
    const World world = build_world(scene);
    const ContactLaw& law = world.settings.laws[law_between(world, 0, 1)];
    EXPECT_EQ(law.normal_stiffness, odd_stiffness);
    EXPECT_EQ(law.shear_stiffness, odd_stiffness);
}

TEST(MaterialPair, IsRefusedWhereItMakesNoSense) {
    const auto complaint = [](const MaterialPair& pair, const MaterialPair& second = {0, 0, 1e7, {}, {}}) {
        Scene scene = disc_chain(2, 0.02, 0.0399, undamped_rock(1e7, 30.0));
        scene.material_pairs = {second, pair};
        scene.materials.push_back(scene.materials[0]);
        return testing::refusal([&] { validate(scene); });
    };
    EXPECT_EQ(complaint({0, 1, 1e6, {}, {}}), "accepted");
    EXPECT_NE(complaint({0, 2, 1e6, {}, {}}).find("material pair 2: material: found 3"), std::string::npos);
    EXPECT_NE(complaint({0, 1, 0.0, {}, {}}).find("normal stiffness: found 0"), std::string::npos);
    EXPECT_NE(complaint({0, 1, {}, -1.0, {}}).find("shear stiffness: found -1"), std::string::npos);
    EXPECT_NE(complaint({0, 1, {}, {}, 90.0}).find("friction angle: found 90"), std::string::npos);
    EXPECT_NE(complaint({1, 0, 1e6, {}, {}}, {0, 1, 1e6, {}, {}}).find("a second time"), std::string::npos);
}

}  // namespace
}  // namespace crackle
