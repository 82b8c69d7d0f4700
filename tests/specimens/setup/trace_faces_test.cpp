// SPDX-License-Identifier: GPL-3.0-or-later
// Tests faces on traces: faces cover all of a trace, and their opening and slip are the relative displacements of the
// two sides, whatever common motion they have.

#include "specimens/setup/trace_faces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/measures/trace_motion.hpp"
#include "specimens/results/files.hpp"
#include "specimens/results/make_summary.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/results/trace_figures.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

constexpr double pi = std::numbers::pi;

/// A face in the middle between two bodies at (0, 0) and (1, 1), with its normal at 45 degrees.
TestSetup one_face(BodyIndex i, BodyIndex j) {
    TestSetup setup;
    setup.bonds.traces.push_back({"one", 0.2});
    setup.bonds.start.resize(2);
    setup.bonds.start[i] = {0.0, 0.0, 0.3};
    setup.bonds.start[j] = {1.0, 1.0, -0.1};
    const double sign = i < j ? 1.0 : -1.0;
    setup.bonds.trace_faces.push_back({.trace = 0,
                                       .i = 0,
                                       .j = 1,
                                       .bonds = 2,
                                       .length = 0.2,
                                       .middle = {0.5, 0.5},
                                       .normal = {sign * std::sqrt(0.5), sign * std::sqrt(0.5)}});
    return setup;
}

TEST(TraceFaces, OpenAndSlipByWhatTheirSidesMoveApart) {
    const double opening = 3e-3, slip = -2e-3;
    const Vec2 normal{std::sqrt(0.5), std::sqrt(0.5)};
    for (const auto& [lower, upper] : {std::pair<BodyIndex, BodyIndex>{0, 1}, {1, 0}}) {
        const TestSetup setup = one_face(lower, upper);
        for (const double turn : {0.0, 0.7, -2.0}) {  // rotation of both about the origin, plus a displacement
            const Vec2 shift{0.4, -0.1};
            const auto moved = [&](const StartPlace& start, Vec2 own) {
                const double c = std::cos(turn), s = std::sin(turn);
                const Vec2 p = Vec2{start.x, start.y} + own;
                return StartPlace{c * p.x - s * p.y + shift.x, s * p.x + c * p.y + shift.y, start.angle + turn};
            };
            std::vector<StartPlace> now(2);
            now[lower] = moved(setup.bonds.start[lower], {});
            now[upper] = moved(setup.bonds.start[upper], opening * normal + slip * perpendicular(normal));
            const FaceMotion face = motion_of(setup.bonds.trace_faces[0],
                                              setup.bonds.start_of(setup.bonds.trace_faces[0]), {now[0], now[1]});
            fmt::print("  turn {}: opening expected {} m, got {:.17g}; slip expected {}, got {:.17g}\n", turn, opening,
                       face.opening, slip, face.slip);
            EXPECT_NEAR(face.opening, opening, 1e-15);
            EXPECT_NEAR(face.slip, slip, 1e-15);
            EXPECT_NEAR(norm(face.end - face.begin), 0.2, 1e-15);
        }
    }
}

/// If one body rotates, the middle of the face moves with it, and half of the rotation counts as rotation of the face.
TEST(TraceFaces, TurnWithTheMeanOfTheirBodies) {
    const TestSetup setup = one_face(0, 1);
    const double turn = 0.2;
    const StartPlace i = setup.bonds.start[0];
    const StartPlace j{1.0, 1.0, -0.1 + turn};
    const FaceMotion face =
        motion_of(setup.bonds.trace_faces[0], setup.bonds.start_of(setup.bonds.trace_faces[0]), {i, j});
    // The middle is at a = (-½, -½) from j and rotates about it: R(turn) a - a is a chord perpendicular to the mean
    // normal.
    EXPECT_NEAR(face.opening, 0.0, 1e-15);
    EXPECT_NEAR(face.slip, -2.0 * std::sqrt(0.5) * std::sin(0.5 * turn), 1e-15);
    EXPECT_NEAR(std::atan2((face.end - face.begin).y, (face.end - face.begin).x), 0.75 * pi + 0.5 * turn, 1e-14);
}

/// A trace with two faces, 0.2 m with bonds that are all broken and 0.6 m without bonds, and a second trace with one
/// face of 0.4 m.
TEST(TraceFigures, OfOpenAndBondedFacesAreByHand) {
    TestSetup setup = one_face(0, 1);
    setup.bonds.traces = {{"survey", 0.8}, {"survey", 0.4}};
    setup.bonds.trace_faces.push_back(setup.bonds.trace_faces[0]);
    setup.bonds.trace_faces[1].bonds = 0;
    setup.bonds.trace_faces[1].length = 0.6;
    setup.bonds.trace_faces.push_back(setup.bonds.trace_faces[0]);
    setup.bonds.trace_faces[2].trace = 1;
    setup.bonds.trace_faces[2].length = 0.4;
    setup.bonds.face_of_bond = {0, 0, 2, 2};
    TestState state;
    for (const PointIndex bond : {0U, 1U, 2U}) state.history.cracks.push_back({.bond = bond});
    World world;
    world.bodies.state.resize(2);
    for (BodyIndex b = 0; b < 2; ++b) {
        const StartPlace& place = setup.bonds.start[b];
        world.bodies.state[b].x = place.x, world.bodies.state[b].y = place.y, world.bodies.state[b].angle = place.angle;
    }
    const JointedFigures figures = trace_figures(setup.bonds, state, world);
    const JointFigures& first = figures.traces->front();
    EXPECT_EQ(first.faces, 2);
    EXPECT_NEAR(*first.length_of_faces, 0.8, 1e-15);
    EXPECT_NEAR(*first.bonded_share, 0.25, 1e-15);
    EXPECT_NEAR(*first.at_end->failed_share, 1.0, 1e-15) << "all faces that had bonds";
    EXPECT_TRUE(first.at_peak.stated() && !first.at_peak);
    const JointFigures& both = figures.joints->front();
    EXPECT_EQ(both.traces, 2);
    EXPECT_NEAR(*both.length, 1.2, 1e-15);
    EXPECT_NEAR(*both.bonded_share, 0.5, 1e-15);
    EXPECT_NEAR(*both.at_end->failed_share, 0.2 / 0.6, 1e-15) << "the second has a bond left";
    EXPECT_EQ(figures.bonds_broken_on_joints, 3);
}

class JointedTest : public ::testing::Test {
  protected:
    /// Cells with a trace from side to side and another that ends inside; one of them behaves like the rock.
    VirtualTest jointed(const std::string& of_first = "friction_angle = 20.0", const char* mesh = "voronoi",
                        const char* kind = "compression") const {
        testing::SmallCase wanted;
        wanted.kind = kind;
        wanted.mesh = mesh;
        wanted.material =
            "units = \"area\"\ncontact_modulus = 1e7\nstiffness_ratio = 2.5\ntensile_strength = 1.5e4\ncohesion = 5e4";
        wanted.bond = "law = \"coulomb\"" + std::string(wanted.mesh.empty() ? "\nrange = 0.3" : "");
        wanted.minerals =
            "[[trace]]\npoints = [0.0, 0.15, 0.3, 0.3]\n" + of_first + "\n[[trace]]\npoints = [0.05, 0.3, 0.15, 0.4]";
        return prepare_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
    }

    testing::ScratchFolder scratch_;
};

TEST_F(JointedTest, AllOfATraceIsFacesWithBonds) {
    const VirtualTest test = jointed();
    const TestSetup& setup = test.setup;
    ASSERT_EQ(setup.bonds.traces.size(), 2u);
    EXPECT_NEAR(setup.bonds.traces[1].length, std::hypot(0.1, 0.1), 1e-12);
    std::vector<double> lengths(2, 0.0);
    std::int64_t bonds = 0;
    for (const TraceFace& face : setup.bonds.trace_faces) {
        lengths[static_cast<std::size_t>(face.trace)] += face.length;
        bonds += face.bonds;
        const Vec2 along = face.trace == 0 ? Vec2{0.3, 0.15} : Vec2{0.1, 0.1};
        if (face.length > 0.0) {
            EXPECT_LT(std::abs(dot(face.normal, (1.0 / norm(along)) * along)), 1e-9);
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        fmt::print("  trace {}: expected {:.9f} m of faces, got {:.9f}\n", k, setup.bonds.traces[k].length, lengths[k]);
        EXPECT_NEAR(lengths[k], setup.bonds.traces[k].length, 1e-9 * setup.bonds.traces[k].length);
    }
    ASSERT_EQ(setup.bonds.face_of_bond.size(), setup.bonds.points.size());
    const auto on_faces = std::ranges::count_if(setup.bonds.face_of_bond, [](std::int32_t face) { return face >= 0; });
    EXPECT_EQ(on_faces, bonds);
    EXPECT_GT(bonds, 20);
    EXPECT_LT(static_cast<std::size_t>(bonds), setup.bonds.points.size() / 2);
}

TEST_F(JointedTest, WhatAnUpperPartMovesIsTheTracesOpeningAndSlip) {
    VirtualTest test = jointed();
    const TestSetup& setup = test.setup;
    const Vec2 along = (1.0 / std::hypot(0.3, 0.15)) * Vec2{0.3, 0.15}, up = perpendicular(along);
    const double opening = 1e-4, right = 2e-4;  // m
    for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
        BodyState& body = test.world.bodies.state[b];
        if (cross(along, Vec2{body.x, body.y - 0.15}) <= 0.0) continue;
        const Vec2 moved = opening * up + right * along;
        body.x += moved.x, body.y += moved.y;
    }
    // Breaks all bonds of the first trace's first face and some of its second face.
    ContactHistory history;
    std::vector<std::size_t> faces;
    for (std::size_t k = 0; k < setup.bonds.trace_faces.size() && faces.size() < 2; ++k)
        if (setup.bonds.trace_faces[k].trace == 0 && setup.bonds.trace_faces[k].length > 0.0 &&
            setup.bonds.trace_faces[k].bonds > 1)
            faces.push_back(k);
    bool spared = false;
    for (PointIndex bond = 0; bond < setup.bonds.points.size(); ++bond) {
        const auto face = static_cast<std::size_t>(setup.bonds.face_of_bond[bond]);
        if (face == faces[0] || (face == faces[1] && std::exchange(spared, true)))
            history.cracks.push_back({.bond = bond});
    }
    const std::vector<TraceMotion> motions =
        trace_motions(setup.bonds, places_of_faces(test.world, setup.bonds), history.cracks);
    ASSERT_EQ(motions.size(), 2u);
    fmt::print("  opening expected {}, got {:.9g}; slip expected {}, got {:.9g}\n", opening, motions[0].opening, -right,
               motions[0].slip);
    EXPECT_NEAR(motions[0].opening, opening, 1e-9 * opening);
    EXPECT_NEAR(motions[0].slip, -right, 1e-9 * right) << "the far side has gone to the right";
    EXPECT_NEAR(motions[0].largest_slip, -right, 1e-9 * right);
    EXPECT_NEAR(motions[1].opening, 0.0, 1e-16);
    EXPECT_EQ(motions[1].failed, 0.0);
    EXPECT_NEAR(motions[0].failed, setup.bonds.trace_faces[faces[0]].length, 1e-15);
    EXPECT_NEAR(motions[0].bonded, motions[0].length, 1e-15);
    EXPECT_EQ(breaks_on_traces(setup.bonds, history.cracks), std::ssize(history.cracks));
    TraceMotion both = motions[0];
    both.add(motions[1]);
    EXPECT_NEAR(both.opening, opening * motions[0].length / (motions[0].length + motions[1].length), 1e-9 * opening);
    EXPECT_EQ(both.largest_slip, motions[0].largest_slip);
}

TEST_F(JointedTest, AnOpenTraceHasFacesWithoutBonds) {
    const VirtualTest test = jointed("bonded = false");
    double open = 0.0;
    for (const TraceFace& face : test.setup.bonds.trace_faces) {
        if (face.trace != 0) continue;
        EXPECT_EQ(face.bonds, 0);
        open += face.length;
    }
    EXPECT_NEAR(open, test.setup.bonds.traces[0].length, 1e-9 * open);
    const std::vector<TraceMotion> motions =
        trace_motions(test.setup.bonds, places_of_faces(test.world, test.setup.bonds), {});
    EXPECT_EQ(motions[0].bonded, 0.0);
    EXPECT_NEAR(motions[0].opening, 0.0, 1e-16);
}

TEST_F(JointedTest, FlatFacesOfCirclesAreFacesOfTheirTrace) {
    VirtualTest test = jointed("friction_angle = 20.0", "");
    const TestSetup& setup = test.setup;
    ASSERT_EQ(setup.bonds.traces.size(), 2u);
    const Vec2 along = (1.0 / std::hypot(0.3, 0.15)) * Vec2{0.3, 0.15}, up = perpendicular(along);
    double length = 0.0;
    for (const TraceFace& face : setup.bonds.trace_faces) {
        ASSERT_EQ(face.trace, 0) << "one without mechanics has no faces";
        EXPECT_EQ(face.bonds, 1);
        length += face.length;
        EXPECT_NEAR(std::abs(dot(face.normal, up)), 1.0, 1e-12);
        EXPECT_NEAR(dot(face.middle - Vec2{0.0, 0.15}, up), 0.0, 1e-12);
    }
    fmt::print("  expected {} m of faces, got {}\n", setup.bonds.traces[0].length, length);
    EXPECT_NEAR(length, setup.bonds.traces[0].length, 2e-3 * length) << "but for what hardly laps";
    EXPECT_EQ(std::ranges::count_if(setup.bonds.face_of_bond, [](std::int32_t face) { return face >= 0; }),
              std::ssize(setup.bonds.trace_faces));
    const double opening = 1e-4, right = 2e-4;  // m
    for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
        BodyState& body = test.world.bodies.state[b];
        if (cross(along, Vec2{body.x, body.y - 0.15}) <= 0.0) continue;
        body.x += opening * up.x + right * along.x, body.y += opening * up.y + right * along.y;
    }
    const std::vector<TraceMotion> motions = trace_motions(setup.bonds, places_of_faces(test.world, setup.bonds), {});
    EXPECT_NEAR(motions[0].opening, opening, 1e-9 * opening);
    EXPECT_NEAR(motions[0].slip, -right, 1e-9 * right);
    EXPECT_EQ(motions[1].faces, 0);
}

TEST_F(JointedTest, WhatTracesHaveComeToAtThePeakIsThatOfThePeaksFrame) {
    VirtualTest test = jointed("friction_angle = 20.0\nstrength_factor = 0.5", "voronoi", "tension");
    test.state.failure.share_of_peak = 0.8;
    const OutputFolder output = OutputFolder::create(scratch_ / "out", Earlier::refused, {});
    TestFiles files(output, "", test.state, {});
    load_specimen(test, {}, &files);
    const TestSetup& setup = test.setup;
    const Frame& frame = test.state.peak_frame;
    ASSERT_EQ(frame.row, test.state.failure.peak_row);
    ASSERT_LT(frame.row + 1, std::ssize(test.state.rows)) << "it is not the end";
    std::vector<FacePlaces> places;
    const auto place = [&](BodyIndex b) {
        return StartPlace{frame.bodies[b].x, frame.bodies[b].y, frame.bodies[b].angle};
    };
    for (const TraceFace& face : setup.bonds.trace_faces) places.push_back({place(face.i), place(face.j)});
    const auto to_peak =
        static_cast<std::size_t>(test.state.breaks_in_shear_to_peak + test.state.breaks_in_tension_to_peak);
    const std::vector<Crack>& cracks = test.state.history.cracks;
    ASSERT_LT(to_peak, cracks.size());
    const auto motions = trace_motions(setup.bonds, places, std::span(cracks).first(to_peak));
    const Summary summary = make_summary(test.description, setup, test.state, test.world, {});
    const std::vector<JointFigures>& traces = *summary.jointed.traces;
    for (std::size_t k = 0; k < 2; ++k) {
        const JointMotion& got = *traces[k].at_peak;
        fmt::print("  trace {}: slip at peak expected {}, got {}, at the end {}\n", k, motions[k].slip, *got.slip,
                   *traces[k].at_end->slip);
        EXPECT_EQ(got.slip, motions[k].slip);
        EXPECT_EQ(got.opening, motions[k].opening);
        EXPECT_EQ(got.failed_share, motions[k].failed / motions[k].bonded);
        EXPECT_NE(*got.slip, *traces[k].at_end->slip);
    }
}

}  // namespace
}  // namespace crackle
