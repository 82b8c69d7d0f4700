// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the effect of a case's keys on particles that it packs or reads.

#include "specimens/making/make_specimen.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "solver/demseg/geometry.hpp"
#include "solver/scene/scene.hpp"
#include "specimens/case/case_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

/// Given in N s/m, although the packing itself has a damping ratio.
TEST(Specimen, DashpotsOfTheCaseReplaceTheRatioThatAPackingHasByItself) {
    ResolvedCase test;
    test.source =
        parts::Packing{parts::CircleCount{30, 2.0}, parts::MeanOverlap{7.74e-5}, UniformRadii{0.015, 0.025}, 1};
    test.material.density = 2500.0;
    test.material.normal_stiffness = 1e7;
    test.material.shear_stiffness = 2.5e6;
    test.material.friction_angle = 27.0;
    test.material.damping_ratio = default_damping_ratio;
    ASSERT_TRUE(make_specimen(test, {}).scene.materials.at(0).damping_ratio.has_value());
    test.material.normal_damping = 120.0;
    test.material.shear_damping = 40.0;
    const Material stated = make_specimen(test, {}).scene.materials.at(0);
    EXPECT_FALSE(stated.damping_ratio.has_value()) << "a damping ratio would replace the dashpots";
    EXPECT_EQ(stated.normal_damping, 120.0);
    EXPECT_EQ(stated.shear_damping, 40.0);
    test.damping_scale = 0.5;  // as in a companion test of --verify
    const Material halved = make_specimen(test, {}).scene.materials.at(0);
    EXPECT_EQ(halved.normal_damping, 60.0);
    EXPECT_EQ(halved.shear_damping, 20.0);
}

TEST(Specimen, IsAtRestWithoutGravityWhateverTheFileSays) {
    const testing::ScratchFolder folder;
    const std::filesystem::path file = testing::write_small_case(folder / "", {});
    Scene particles = testing::small_rock_scene();
    particles.gravity = {0.0, -9.81};
    for (Body& body : particles.bodies) body.velocity = {0.1, 0.2}, body.spin = 0.3;
    std::ofstream rock(folder / "rock.dat");
    write_geometry(rock, particles);
    rock.close();
    const Specimen specimen = make_specimen(read_case(file), {});
    EXPECT_EQ(specimen.scene.gravity.x, 0.0);
    EXPECT_EQ(specimen.scene.gravity.y, 0.0);
    for (const Body& body : specimen.scene.bodies) {
        EXPECT_EQ(body.velocity.x, 0.0);
        EXPECT_EQ(body.velocity.y, 0.0);
        EXPECT_EQ(body.spin, 0.0);
    }
    EXPECT_TRUE(std::ranges::any_of(
        specimen.notices, [](const std::string& notice) { return notice.find("gravity") != std::string::npos; }));
}

/// Message for the small rock after a change of its file.
std::string refusal_after(const std::function<void(Scene&)>& change) {
    const testing::ScratchFolder folder;
    const std::filesystem::path file = testing::write_small_case(folder / "", {});
    Scene particles = testing::small_rock_scene();
    change(particles);
    std::ofstream rock(folder / "rock.dat");
    write_geometry(rock, particles);
    rock.close();
    const std::string text = testing::refusal([&] { make_specimen(read_case(file), {}); });
    return text.substr(std::min(text.find("particles.file"), text.size()));
}

TEST(Specimen, IsRefusedWithABodyOutsideOrTwice) {
    const auto left_out = [](const std::string& text, const char* part) {
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    EXPECT_EQ(refusal_after([](Scene&) {}), "") << "the rock itself is read";
    for (const Vec2 by : {Vec2{4.0, 0.0}, Vec2{-4.0, 0.0}, Vec2{0.0, 4.0}, Vec2{0.0, -4.0}})
        left_out(refusal_after([by](Scene& rock) { rock.circles[2].centre = rock.circles[2].centre + by; }),
                 "outside of the domain");
    for (const double share : {0.0, 0.005}) {
        left_out(refusal_after([share](Scene& rock) {
                     CircleElement again = rock.circles[2];
                     again.centre.x += share * again.radius;
                     rock.add_circle_body(9999, 0, again);
                 }),
                 "and 9999 at the same place");
    }
    left_out(refusal_after([](Scene& rock) {
                 CircleElement within = rock.circles[2];
                 within.radius *= 0.5;
                 rock.add_circle_body(9999, 0, within);
             }),
             "and 9999 at the same place");
}

}  // namespace
}  // namespace crackle
