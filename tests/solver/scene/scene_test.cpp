// SPDX-License-Identifier: GPL-3.0-or-later
// Tests outlines and materials that a scene refuses.

#include "solver/scene/scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "solver/base/errors.hpp"
#include "specimens/making/materials.hpp"

namespace crackle {
namespace {

std::string answer_to(const std::vector<Vec2>& outline) {
    Scene scene;
    scene.materials = {undamped_rock(1e7, 27.0)};
    scene.domain = {-10.0, 10.0, -10.0, 10.0, {true, true, true, true}};
    scene.add_chain_body(1, 0, outline, true);
    scene.thick = 1e-3;
    try {
        validate(scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(Material, HasAFrictionAngleBelowNinetyDegrees) {
    const auto answer = [](double angle) -> std::string {
        Scene scene;
        scene.materials = {undamped_rock(1e7, angle)};
        scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
        scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.1, 0.0});
        try {
            validate(scene);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(answer(89.9), "accepted");
    for (const double angle : {90.0, -0.1, 135.0})  // the tangent is infinite or has the wrong sign
        EXPECT_NE(answer(angle).find("friction angle: found"), std::string::npos) << answer(angle);
}

TEST(Outline, IsRefusedWhereAnyTwoOfItsSegmentsCross) {
    const std::vector<Vec2> plain{{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}, {2.0, 3.0}, {0.0, 2.0}};
    EXPECT_EQ(answer_to(plain), "accepted");
    // If two neighbouring corners are exchanged, the segments before and after them cross. All starting corners are
    // tried, so that the crossing occurs between any two segments, including the first and the last.
    for (std::size_t swapped = 0; swapped < plain.size(); ++swapped) {
        std::vector<Vec2> outline = plain;
        std::swap(outline[swapped], outline[(swapped + 1) % plain.size()]);
        for (std::size_t start = 0; start < plain.size(); ++start) {
            const std::string answer = answer_to(outline);
            EXPECT_NE(answer.find("cross, expected a simple outline"), std::string::npos)
                << fmt::format("corners {} and the next, started at {}: {}", swapped, start, answer);
            std::rotate(outline.begin(), outline.begin() + 1, outline.end());
        }
    }
}

}  // namespace
}  // namespace crackle
