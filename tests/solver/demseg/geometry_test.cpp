// SPDX-License-Identifier: GPL-3.0-or-later
// Tests in_gm.dat: contents of the guide's examples, exact values after writing and reading, and messages for invalid
// decks.

#include "solver/demseg/geometry.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

const std::string guide_circle =
    "1 0 0\n5.0d-5 0.0 -980.0d0\n1\n2.5d0 1.0d8 0.25d8 0.0d0 0.0d0 0.0d0\n-10.0d0 10.0d0 0.0d0 10.0d0 0.0d0\n1 0 0\n1 "
    "1 1\n"
    "0.0d0 0.0d0 0.0d0\n1 2.0d0\n0.0d0 5.0d0 0.0d0\n";

DeckGeometry parse(const std::string& text) {
    DeckReader reader("in_gm.dat", text);
    return read_deck_geometry(reader);
}

std::string refusal(const std::string& text) {
    try {
        parse(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string with(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

TEST(Geometry, ReadsTheGuidesCircle) {
    const Scene scene = parse(guide_circle).scene;
    EXPECT_EQ(scene.time_step, 5e-5);
    EXPECT_EQ(scene.gravity, (Vec2{0.0, -980.0}));
    EXPECT_EQ(scene.materials[0].shear_stiffness, 0.25e8);
    EXPECT_EQ(scene.domain.x1, -10.0);
    EXPECT_EQ(scene.domain.y2, 10.0);
    EXPECT_EQ(scene.circles[0].radius, 2.0);
    EXPECT_EQ(scene.circles[0].centre, (Vec2{0.0, 5.0}));
    EXPECT_EQ(scene.first_kick, FirstKick::full);
    EXPECT_TRUE(agrees("mass", mass_properties(scene, scene.bodies[0]).mass, 2.5 * std::numbers::pi * 4.0, 1e-15));
}

TEST(Geometry, ValuesOfAReadMayStandOnSeveralLinesWithAnyBlanksAndFortranExponents) {
    const std::string spread =
        " 1\t0\r\n0\n\n5.0E-05 +0 -9.80D+2\n1\n2.5 100000000 2.5d7\n 0 .0 0.\n-10 10 0 10 0\n1 0 0\n1\n1\n1\n0 0 0\n"
        "1 2\n0 5\n0";
    std::ostringstream a, b;
    write_geometry(a, parse(guide_circle).scene);
    write_geometry(b, parse(spread).scene);
    EXPECT_EQ(a.str(), b.str());
}

TEST(Geometry, BareSegmentWeighsLengthTimesATenthAsInTheGuidesSample) {
    const Scene scene =
        parse(
            "1 0 0\n2d-5 0 -980\n1\n2.5 1d8 .25d8 0 0 0\n-10 10 0 10 0\n1 1 0\n1 1 1\n0 0 0\n1 2\n0 5 0\n"
            "2 1 1\n0 0 0\n1 -3 1 -3 6")
            .scene;
    const MassProperties segment = mass_properties(scene, scene.bodies[1]);
    EXPECT_TRUE(agrees("mass", segment.mass, 1.25, 1e-15));
    EXPECT_TRUE(agrees("moment", segment.moment, 1.25 * 25.0 / 12.0, 1e-14));
    EXPECT_FALSE(scene.bodies[1].closed);
}

TEST(Geometry, ClosedChainsBecomeCounterClockwisePolygonsThatKeepTheirFirstSegment) {
    const std::string head = "1 0 0\n2d-5 0 -980\n1\n2.5 1d8 .25d8 0 0 0\n-10 10 0 10 0\n0 1 0\n1 1 3\n0 0 0\n";
    const Scene clockwise = parse(head + "1 2 4 -2 2\n2 -2 2\n1 7\n3 1 7\n2 4").scene;
    ASSERT_TRUE(clockwise.bodies[0].closed);
    ASSERT_EQ(clockwise.vertices.size(), 3u);
    EXPECT_EQ(clockwise.vertices[0], (Vec2{-2.0, 2.0}));
    EXPECT_EQ(clockwise.vertices[1], (Vec2{2.0, 4.0}));
    const Scene counter = parse(head + "1 -2 2\n2 4\n2 2 4 1 7\n3 1 7 -2 2.0000001").scene;
    ASSERT_TRUE(counter.bodies[0].closed);
    EXPECT_EQ(counter.vertices, clockwise.vertices);
    EXPECT_TRUE(agrees("mass", mass_properties(counter, counter.bodies[0]).mass, 2.5 * 7.0, 1e-14));
}

TEST(Geometry, WritingAndReadingLosesNoBit) {
    const std::string deck =
        "1 0 0\n0.00012345678901234567 0.1 -980.6649999999999\n2\n2.5 1d8 .25d8 3 4 27.123456789\n1.1 1e9 0 0 0 0\n"
        "-10.000000000000002 10 0 1e300 1.08d-3\n2 1 1\n"
        "4 1 2\n1e-300 -0.0 3\n1 0.022250738585072014\n0 0.30000000000000004 6.283185307179586\n2 1\n2 6 0\n"
        "9 2 1\n0 0 0\n1 3.3333333333333335\n5 5 5\n"
        "2 1 3\n0 0 0\n1 -2 2 2 4\n2 2 4 1 7.1\n3 1 7.1 -2 2\n"
        "583 1 2\n0 0 0\n1 0 -.1 80.1 -.1\n2 80.1 -.1 80.1 4";
    const DeckGeometry first = parse(deck);
    EXPECT_EQ(first.large_segments, 1u);
    std::ostringstream once, twice;
    write_geometry(once, first.scene, first.large_segments);
    const DeckGeometry second = parse(once.str());
    write_geometry(twice, second.scene, second.large_segments);
    EXPECT_EQ(once.str(), twice.str());
    EXPECT_EQ(first.scene.vertices, second.scene.vertices);
    EXPECT_EQ(first.scene.materials, second.scene.materials);
    EXPECT_EQ(first.scene.circles[0].radius, second.scene.circles[0].radius);
    EXPECT_EQ(first.scene.time_step, second.scene.time_step);
    EXPECT_EQ(second.large_segments, 1u);
}

TEST(Geometry, RefusalsNameFileLineKeyFindingAndExpectation) {
    EXPECT_EQ(refusal(with(guide_circle, "1 2.0d0", "1 -2.0d0")),
              "in_gm.dat:9: body 1: radius: found '-2.0d0', expected a number > 0");
    EXPECT_EQ(refusal(with(guide_circle, "5.0d-5", "nan")),
              "in_gm.dat:2: dt: found 'nan', expected a finite number such as 2.5, 1e8 or 1.0d8");
    EXPECT_EQ(refusal(with(guide_circle, "1 0 0\n5", "1 2 0\n5")),
              "in_gm.dat:1: mode2: found '2', expected 0 (other values are not supported)");
    EXPECT_EQ(refusal(with(guide_circle, "1 1 1\n", "1 2 1\n")), "in_gm.dat:7: body 1: imat: found '2', expected 1");
    EXPECT_EQ(refusal(guide_circle.substr(0, guide_circle.size() - 6)),
              "in_gm.dat:10: body 1: angle: found the end of the file, expected a number; the file is cut off or a "
              "count in it is too "
              "large");
    EXPECT_EQ(refusal(with(guide_circle, "1 0 0\n1", "0 0 0\n1")),
              "in_gm.dat:6: ncir nseg1 nseg2: found 0 0 0, expected at least one body");
    EXPECT_EQ(refusal(with(guide_circle, "10.0d0 0.0d0 10", "-11.0d0 0.0d0 10")),
              "in_gm.dat:5: x2: found '-11.0d0', expected more than x1 = -10");
    EXPECT_EQ(refusal(with(guide_circle, "\n1\n2.5d0", "\n1.5\n2.5d0")),
              "in_gm.dat:3: nmat: found '1.5', expected a whole number from 1 to 2147483647");
}

TEST(Geometry, ScenesThatTheFormatCannotHoldAreRefusedNotCutDown) {
    Scene scene = parse(guide_circle).scene;
    scene.materials[0].damping_ratio = 0.2;
    std::ostringstream out;
    EXPECT_THROW(write_geometry(out, scene), InputError);
    scene.materials[0].damping_ratio.reset();
    scene.domain.wall_present[0] = false;
    EXPECT_THROW(write_geometry(out, scene), InputError);
}

TEST(Geometry, ReadsTheGuidesRandomGeneration) {
    DeckReader reader(
        "in_gm.dat",
        "0 0 0\n5.0d-5 0.0 -980.0d0\n1\n2.5d0 1.0d8 0.25d8 1.0d2 0.5d2 27.0d0\n0.0d0 80.0d0 0.0d0 80.0d0 0.0d0\n"
        "1.0 2.0\n1\n0.5\n");
    const RandomGeometry geometry = read_random_geometry(reader);
    EXPECT_EQ(geometry.radius_min, 1.0);
    EXPECT_EQ(geometry.radius_max, 2.0);
    EXPECT_EQ(geometry.material, 0);
    EXPECT_EQ(geometry.void_ratio, 0.5);
    EXPECT_EQ(geometry.domain.x2, 80.0);
}

}  // namespace
}  // namespace crackle
