// SPDX-License-Identifier: GPL-3.0-or-later
// Tests networks of traces: requested amounts are reached, and traces lie in the box and end on its sides. Random draws
// follow their laws for any box, and the same seed gives the same traces.

#include "specimens/joints/joint_network.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <vector>

#include "specimens/joints/clipping.hpp"
#include "specimens/joints/drawn_sets.hpp"
#include "tests/specimens/joints/cases.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::joint_network_test {
namespace {

using testing::agrees;
using testing::box;
using testing::joints_of;
using testing::refusal;
using testing::total_length;
using testing::within;

constexpr double degree = std::numbers::pi / 180.0;

std::string set_of(const std::string& keys) { return "[[joint_set]]\nname = \"a\"\n" + keys; }

const char* const lengths[] = {"length = \"fixed\"\nlength_mean = 0.3\n",
                               "length = \"uniform\"\nlength_mean = 0.3\nlength_deviation = 0.2\n",
                               "length = \"lognormal\"\nlength_mean = 0.3\nlength_deviation = 0.3\n",
                               "length = \"exponential\"\nlength_mean = 0.3\n",
                               "length = \"power_law\"\nlength_min = 0.05\nlength_max = 20.0\nlength_exponent = 2.3\n"};
const char* const directions[] = {"angle = 30.0\n",
                                  "orientation = \"uniform\"\nangle = 100.0\nangle_deviation = 90.0\n",
                                  "orientation = \"von_mises\"\nangle = -20.0\nkappa = 5.0\n"};

TEST(JointNetwork, P21IsReachedByEveryLaw) {
    const Domain domain = box(1.5, 2.5, -0.5, 10.0);
    for (const char* direction : directions) {
        for (const char* length : lengths) {
            const JointNetwork network =
                make_joints(joints_of(set_of(std::string(direction) + length + "p21 = 6.0\n")), domain);
            EXPECT_TRUE(agrees("P21", total_length(network) / 3.75, 6.0, 1e-9));
        }
        for (const char* line : {"", "length = \"gaps\"\nlength_mean = 0.4\ngap_mean = 0.2\n"}) {
            const JointNetwork network =
                make_joints(joints_of(set_of(std::string(direction) + line + "p21 = 6.0\n")), domain);
            EXPECT_TRUE(agrees("P21 of lines", total_length(network) / 3.75, 6.0, 1e-9));
        }
    }
}

TEST(JointNetwork, NumberP10AndP20AreReached) {
    const Domain domain = box(2.0, 1.0);
    const std::string short_ones = "angle = 30.0\nlength = \"exponential\"\nlength_mean = 0.3\n";
    EXPECT_EQ(make_joints(joints_of(set_of(short_ones + "number = 77\n")), domain).traces.size(), 77U);
    const JointNetwork by_midpoints = make_joints(joints_of(set_of(short_ones + "p20 = 40.3\n")), domain);
    EXPECT_EQ(std::count_if(by_midpoints.traces.begin(), by_midpoints.traces.end(),
                            [](const JointTrace& t) { return t.centred; }),
              81);
    const JointNetwork along_line =
        make_joints(joints_of(set_of(short_ones + "p10 = 8.0\nscan_line = 90.0\n")), domain);
    double across = 0.0;
    for (const JointTrace& t : along_line.traces) across += std::abs(t.points.back().x - t.points.front().x);
    EXPECT_TRUE(agrees("P10 along y: lengths across it over the area", across / 2.0, 8.0, 1e-9));
}

TEST(JointNetwork, TracesLieInTheBoxAndEndOnItsFacesExactly) {
    const Domain domain = box(0.7, 1.4, 0.1, 0.3);
    const JointNetwork network = make_joints(
        joints_of(set_of("orientation = \"uniform\"\nangle = 0.0\nangle_deviation = 90.0\nnumber = 300\n")), domain);
    for (const JointTrace& trace : network.traces) {
        for (const Vec2 p : trace.points) {
            EXPECT_TRUE(p.x >= domain.x1 && p.x <= domain.x2 && p.y >= domain.y1 && p.y <= domain.y2);
            EXPECT_TRUE(p.x == domain.x1 || p.x == domain.x2 || p.y == domain.y1 || p.y == domain.y2) << "persistent";
        }
        EXPECT_FALSE(trace.centred);
        EXPECT_TRUE(std::isinf(trace.whole_length));
    }
}

TEST(JointNetwork, TheSameSeedGivesTheSameTracesAndAnotherSetChangesNothing) {
    const std::string first = set_of(
        "orientation = \"von_mises\"\nangle = 10.0\nkappa = 9.0\nlength = \"lognormal\"\n"
        "length_mean = 0.2\nlength_deviation = 0.1\np21 = 5.0\n");
    const auto drawn = [&](const std::string& text) { return make_joints(joints_of(text), box(1.0, 1.0)).traces; };
    const auto once = drawn(first), again = drawn(first), seeded = drawn("[joints]\nseed = 2\n" + first),
               with_another = drawn(first + "[[joint_set]]\nname = \"b\"\nangle = 80.0\nspacing = 0.3\n");
    ASSERT_EQ(once.size(), again.size());
    ASSERT_GT(with_another.size(), once.size());
    for (std::size_t k = 0; k < once.size(); ++k) {
        EXPECT_EQ(once[k].points, again[k].points);
        EXPECT_EQ(once[k].points, with_another[k].points);
    }
    EXPECT_NE(once.front().points, seeded.front().points);
}

TEST(JointNetwork, LinesAtAFixedSpacingLieThroughThePoint) {
    const JointNetwork network =
        make_joints(joints_of(set_of("angle = 90.0\nspacing = 0.125\nthrough = [0.5, 0.0]\n")), box(1.0, 2.0));
    std::vector<double> places;
    for (const JointTrace& t : network.traces) places.push_back(t.points.front().x);
    std::sort(places.begin(), places.end());
    // Lines on the side walls, at 0 and 1, may or may not be included because of round-off.
    for (int k = 1; k < 8; ++k) {
        EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](double x) {
            return std::abs(x - 0.125 * k) < 1e-12;
        })) << k;
    }
    EXPECT_LE(places.size(), 9U);
}

// The starting points of lines, and of joints along lines, are random: over many seeds all phases of a cycle are
// equally likely. The standard error of a mean of n phases, uniform in [0, 1), is 1/sqrt(12 n).
TEST(JointNetwork, LinesAndTheJointsAlongThemBeginAnywhere) {
    constexpr int seeds = 400;
    double across = 0.0, along = 0.0, lines = 0.0, squares_across = 0.0, squares_along = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
        const JointNetwork network = make_joints(
            joints_of(fmt::format("[joints]\nseed = {}\n", seed) +
                      set_of("angle = 0.0\nlength = \"gaps\"\nlength_mean = 0.3\ngap_mean = 0.1\nspacing = 0.5\n")),
            box(2.0, 2.0));
        double last = -1.0;
        for (const JointTrace& t : network.traces) {
            const Vec2 end = t.points.back();
            if (end.y == last || end.x == 2.0) continue;  // counts only the first end in the box of each line
            const double phase = end.x / 0.4 - std::floor(end.x / 0.4);
            along += phase;
            squares_along += phase * phase;
            lines += 1.0;
            if (last < 0.0) {
                const double first = end.y / 0.5 - std::floor(end.y / 0.5);
                across += first;
                squares_across += first * first;
            }
            last = end.y;
        }
    }
    EXPECT_TRUE(within("mean place of lines", across / seeds, 0.5, 4.0 / std::sqrt(12.0 * seeds)));
    EXPECT_TRUE(within("mean place of joints", along / lines, 0.5, 4.0 / std::sqrt(12.0 * lines)));
    // The expected mean square is 1/3, and its variance is 1/5 - 1/9.
    EXPECT_TRUE(within("mean square, lines", squares_across / seeds, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / seeds)));
    EXPECT_TRUE(within("mean square, joints", squares_along / lines, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / lines)));
}

TEST(JointNetwork, DistancesBetweenLinesFollowTheirLaw) {
    for (const auto& [law, mean_square] :
         {std::pair{"spacing_law = \"uniform\"\nspacing_deviation = 0.01\n", 0.01 * 0.01 / 3.0},
          {"spacing_law = \"exponential\"\n", 0.02 * 0.02},
          {"spacing_law = \"lognormal\"\nspacing_deviation = 0.008\n", 0.008 * 0.008}}) {
        const JointNetwork network =
            make_joints(joints_of(set_of(std::string("angle = 0.0\nspacing = 0.02\n") + law)), box(1.0, 100.0));
        double last = network.traces.front().points.front().y, sum = 0.0, squares = 0.0;
        double n = 0.0;
        for (std::size_t k = 1; k < network.traces.size(); ++k, ++n) {
            const double y = network.traces[k].points.front().y, d = y - last;
            last = y;
            sum += d;
            squares += (d - 0.02) * (d - 0.02);
        }
        EXPECT_TRUE(within("mean", sum / n, 0.02, 4.0 * std::sqrt(mean_square / n)));
        EXPECT_TRUE(agrees("variance", squares / n, mean_square, 0.15));  // 3 standard errors of 5000
    }
}

// Σ l cos d divided by the area, with d relative to the mean direction. For lines at equal offsets this is 1/spacing
// for any scatter, if no line that meets the box is omitted. Each line adds x <= sqrt(2) m, so the variance of the sum
// is at most sqrt(2) times the sum.
TEST(JointNetwork, LinesAtASpacingThatScatterHaveItsFrequencyAcrossTheirMean) {
    const double spacing = 5e-5;
    for (const double deviation : {60.0, 85.0}) {
        for (const char* through : {"", "through = [0.3, 0.9]\n"}) {
            const JointRequest test = joints_of(
                set_of(fmt::format("orientation = \"uniform\"\nangle = 20.0\nangle_deviation = {}\nspacing = {}\n{}",
                                   deviation, spacing, through)));
            double across = 0.0;
            for (const JointTrace& t : make_joints(test, box(1.0, 1.0)).traces)
                across += length_across(t, 110.0 * degree);
            EXPECT_TRUE(agrees("P10", across, 1.0 / spacing, 4.0 * std::sqrt(std::sqrt(2.0) * spacing)));
        }
    }
}

TEST(JointNetwork, GapsLeaveThePersistence) {
    const JointNetwork network = make_joints(
        joints_of(set_of("angle = 0.0\nlength = \"gaps\"\nlength_mean = 0.3\nlength_deviation = 0.1\ngap_mean = 0.1\n"
                         "gap_deviation = 0.05\nspacing = 0.05\n")),
        box(10.0, 10.0));
    // 200 lines of 25 cycles each: the relative standard deviation is below 0.1/sqrt(5000).
    EXPECT_TRUE(within("persistence", total_length(network) / (200.0 * 10.0), 0.75, 0.005));
}

// Traces that are independent of lines have the lengths and positions of traces in an unbounded plane. Lengths of
// traces with midpoints in the box follow the law, and the density is the same near the boundary and in the middle.
TEST(JointNetwork, TheRimIsNoDifferentFromTheMiddle) {
    for (const char* length : {lengths[3], lengths[4]}) {
        const std::string text = set_of(std::string(directions[1]) + length + "number = 30000\n");
        const JointRequest test = joints_of(text);
        const Domain domain = box(1.0, 1.0);
        const JointNetwork network = make_joints(test, domain);
        const LengthLaw law = std::get<LengthLaw>(test.sets.front().length);
        std::vector<double> whole;
        double rim = 0.0, all = 0.0;
        const Domain core = box(0.5, 0.5, 0.25, 0.25);
        for (const JointTrace& t : network.traces) {
            if (t.centred) whole.push_back(t.whole_length);
            all += t.length();
            rim += t.length();
            for (const auto& piece : clipped(t.points, core)) rim -= norm(piece.back() - piece.front());
        }
        // A quarter of the area contains a quarter of the length. The tolerance is for 30,000 traces, few of which make
        // up most of the length.
        EXPECT_TRUE(within("share of the length in the core", 1.0 - rim / all, 0.25, 0.01));
        std::sort(whole.begin(), whole.end());
        double furthest = 0.0;
        const double n = static_cast<double>(whole.size());
        for (std::size_t k = 0; k < whole.size(); ++k)
            furthest = std::max(furthest, std::abs(law.share_below(whole[k]) - (static_cast<double>(k) + 0.5) / n));
        EXPECT_TRUE(
            within(fmt::format("Kolmogorov's sqrt(n) D of {} midpoints", n), std::sqrt(n) * furthest, 0.0, 1.95));
    }
}

TEST(JointNetwork, LinesMeetTheBoxAsOftenAsTheirWidthSays) {
    // Directions of lines through a box of 4 by 1, drawn from all directions, have a density proportional to the box's
    // width across them, |4 sin| + |cos|.
    const JointNetwork network =
        make_joints(joints_of(set_of(std::string(directions[1]) + "number = 20000\n")), box(4.0, 1.0));
    double steep = 0.0;
    for (const JointTrace& t : network.traces) {
        const Vec2 d = t.points.back() - t.points.front();
        steep += std::abs(d.y) > std::abs(d.x) ? 1.0 : 0.0;
    }
    // ∫ over 45..135 of (4 sin + |cos|) / ∫ over 0..180 = (4·√2 + 2 - √2)/(8 + 2).
    const double expected = (4.0 * std::sqrt(2.0) + 2.0 - std::sqrt(2.0)) / 10.0;
    EXPECT_TRUE(within("share of steep lines", steep / 20000.0, expected, 4.0 * 0.5 / std::sqrt(20000.0)));
}

TEST(JointNetwork, MeasuredTracesAreScaledMovedAndClipped) {
    const testing::ScratchFolder folder;
    std::ofstream(folder / "survey.txt") << "100 0 100 400 300 400\n900 0 900 100\n";
    std::ofstream(folder / "joints.toml") << "[[trace]]\nfile = \"survey.txt\"\nscale = 0.01\noffset = [-0.5, -1.0]\n"
                                             "[[trace]]\nname = \"own\"\npoints = [0.0, 1.0, 2.0, 1.0]\n";
    const JointNetwork network = make_joints(CaseFiles(folder / "joints.toml").joints().joints, box(2.0, 2.0));
    ASSERT_EQ(network.traces.size(), 2U);
    EXPECT_EQ(network.traces[0].points, (std::vector<Vec2>{{0.5, 0.0}, {0.5, 2.0}}));
    EXPECT_EQ(network.traces[0].whole_length, 6.0);
    EXPECT_EQ(network.traces[1].points, (std::vector<Vec2>{{0.0, 1.0}, {2.0, 1.0}}));
    EXPECT_EQ(network.sources[0].name, "survey");
    EXPECT_EQ(network.sources[1].name, "own");
    ASSERT_EQ(network.notices.size(), 1U);
    EXPECT_EQ(network.notices[0], "survey: 1 of 2 traces lie outside of the box");
}

TEST(JointNetwork, ShortTracesAreLeftOutAndSaidSo) {
    const JointNetwork network =
        make_joints(joints_of("[joints]\nshortest = 0.3\n[[trace]]\npoints = [0.5, 0.5, 0.9, 0.5]\n"
                              "[[trace]]\npoints = [0.8, 0.2, 1.5, 0.2]\n"),
                    box(1.0, 1.0));
    ASSERT_EQ(network.traces.size(), 1U);
    EXPECT_EQ(network.traces[0].source, 0U);
    ASSERT_EQ(network.notices.size(), 1U);
    EXPECT_EQ(network.notices[0], "1 traces shorter than 0.3 m (joints.shortest) are left out, 0.2 m in all");
}

TEST(JointNetwork, ForAMeshTracesShorterThanItsSpacingAreLeftOut) {
    const std::string traces = "[[trace]]\npoints = [0.5, 0.5, 0.62, 0.5]\n[[trace]]\npoints = [0.5, 0.2, 0.58, 0.2]\n";
    // The spacing is 0.1.
    const JointNetwork network = make_joints(joints_of(traces), box(1.0, 1.0), 100);
    ASSERT_EQ(network.traces.size(), 1U);
    EXPECT_EQ(network.traces[0].source, 0U);
    ASSERT_EQ(network.notices.size(), 1U);
    EXPECT_EQ(
        network.notices[0],
        "1 traces shorter than 0.1 m (the mean spacing of the cells; joints.shortest sets another limit) are left out, "
        "0.08 m in all");
    EXPECT_EQ(make_joints(joints_of("[joints]\nshortest = 0.01\n" + traces), box(1.0, 1.0), 100).traces.size(), 2U);
    EXPECT_EQ(make_joints(joints_of(traces), box(1.0, 1.0)).traces.size(), 2U) << "drawn alone";
}

TEST(JointNetwork, ATraceInPiecesIsCountedOnceWithTheLongest) {
    const std::string trace = "[[trace]]\npoints = [0.95, 0.4, 1.05, 0.4, 1.05, 0.5, 0.1, 0.5]\n";
    for (const char* shortest : {"", "[joints]\nshortest = 0.3\n"}) {
        const JointNetwork network = make_joints(joints_of(shortest + trace), box(1.0, 1.0));
        ASSERT_FALSE(network.traces.empty());
        for (const JointTrace& t : network.traces) EXPECT_EQ(t.centred, t.length() > 0.5) << t.length();
        EXPECT_TRUE(agrees("whole length", network.traces.back().whole_length, 1.15, 1e-12));
    }
}

// 1 m of the trace is to the left of the box and 0.2 m below it; its midpoint is at x = 0.1.
TEST(JointNetwork, TheMidpointOfATraceLiesHalfwayAlongIt) {
    for (const auto& [points, centred] : {std::pair{"[-1.0, 0.5, 1.0, 0.5, 1.0, 0.3]", true},
                                          {"[-1.0, 0.5, 0.9, 0.5]", false},
                                          {"[0.9, 0.9, 0.9, 3.0, 3.0, 3.0]", false},
                                          {"[3.0, 3.0, 0.9, 3.0, 0.9, 0.9, 0.1, 0.9, 0.1, 5.0]", true}}) {
        const JointNetwork network =
            make_joints(joints_of(fmt::format("[[trace]]\npoints = {}\n", points)), box(1.0, 1.0));
        ASSERT_EQ(network.traces.size(), 1U);
        EXPECT_EQ(network.traces[0].centred, centred) << points;
    }
}

TEST(JointNetwork, ATraceThatLeavesTheBoxAndComesBackIsTwo) {
    const auto pieces = clipped({{0.5, 0.5}, {1.5, 0.5}, {1.5, 0.8}, {0.5, 0.8}, {0.2, 0.9}}, box(1.0, 1.0));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0], (std::vector<Vec2>{{0.5, 0.5}, {1.0, 0.5}}));
    EXPECT_EQ(pieces[1], (std::vector<Vec2>{{1.0, 0.8}, {0.5, 0.8}, {0.2, 0.9}}));
    EXPECT_TRUE(clipped({{-1.0, 1.0}, {0.0, 1.0}}, box(1.0, 1.0)).empty()) << "touches a corner";
}

TEST(JointNetwork, LengthsThatWouldBeDrawnWithoutEndAreRefused) {
    const auto refused = [](const std::string& keys) {
        return refusal([&] { make_joints(joints_of(set_of("angle = 30.0\n" + keys)), box(1.0, 1.0)); });
    };
    const std::string fixed = "length = \"fixed\"\nlength_mean = ", power_law = "length = \"power_law\"\n";
    for (const char* far : {"1e6\nnumber = 1000\n", "1e5\np20 = 50.0\n", "1e9\np21 = 50.0\n"})
        EXPECT_NE(refused(fixed + far).find("joint_set[1].length_mean: found 1"), std::string::npos);
    EXPECT_NE(refused(power_law + "length_min = 0.1\nlength_max = 1e9\nlength_exponent = 1.0\nnumber = 100\n")
                  .find("joint_set[1].length_max: found 1000000000 m, expected lengths closer"),
              std::string::npos);
    for (const char* amount : {"number = 5\n", "p20 = 5.0\n"})
        EXPECT_NE(refused(fixed + "1e-20\n" + amount).find("joint_set[1].length_mean: found 1e-20 m"),
                  std::string::npos);
    EXPECT_NE(refused(power_law + "length_min = 1e-12\nlength_max = 0.1\nlength_exponent = 3.0\nnumber = 100\n")
                  .find("joint_set[1].length_min: found 1e-12 m"),
              std::string::npos);
    const std::string gaps = "length = \"gaps\"\nnumber = 5\nlength_mean = ";
    EXPECT_NE(refused(gaps + "1e-20\ngap_mean = 0.1\n").find("joint_set[1].length_mean: found 1e-20 m"),
              std::string::npos);
    EXPECT_NE(refused(gaps + "0.1\ngap_mean = 1e9\n").find("joint_set[1].gap_mean: found"), std::string::npos);
    // Traces are drawn in an area a hundred times that of the box.
    EXPECT_EQ(
        make_joints(joints_of(set_of("angle = 30.0\n" + fixed + "100.0\nnumber = 50\n")), box(1.0, 1.0)).traces.size(),
        50U);
}

TEST(JointNetwork, WhatCannotBeDrawnIsRefused) {
    const auto refused = [](const std::string& text) {
        return refusal([&] { make_joints(joints_of(text), box(1.0, 1.0)); });
    };
    EXPECT_NE(refused(set_of("angle = 0.0\np10 = 3.0\nscan_line = 180.0\n")).find("crosses none of it"),
              std::string::npos);
    EXPECT_NE(refused(set_of("angle = 0.0\nlength = \"fixed\"\nlength_mean = 1e-6\np21 = 6.0\n"))
                  .find("more than 100000 traces"),
              std::string::npos);
    EXPECT_NE(refused(set_of("angle = 0.0\nspacing = 1e-7\n")).find("joint_set[1].spacing: found 1e-07 m"),
              std::string::npos);
    EXPECT_NE(
        refused(set_of("angle = 0.0\nlength = \"fixed\"\nlength_mean = 0.1\np20 = 0.2\n")).find("half a midpoint"),
        std::string::npos);
    EXPECT_NE(refused("[[trace]]\npoints = [5.0, 5.0, 6.0, 6.0]\n").find("trace[1]: found all of its traces outside"),
              std::string::npos);
    EXPECT_NE(refused("[[trace]]\nfile = \"none.csv\"\n").find("found no file"), std::string::npos);
    const std::string line = "[[trace]]\npoints = [0.1, 0.1, 0.9, 0.8]\n";
    for (const char* snap : {"1.0", "0.11", "1e-300", "1e-12"})
        EXPECT_NE(refused(std::string("[joints]\nsnap = ") + snap + '\n' + line).find("joints.snap: found "),
                  std::string::npos)
            << snap;
    EXPECT_NE(refused("[joints]\nsnap = 0.1\n[[trace]]\npoints = [0.01, 0.01, 0.02, 0.02]\n").find("no trace left"),
              std::string::npos);
    EXPECT_NE(refused("[joints]\nsection_trend = 0.0\n" +
                      set_of("orientation = \"fisher\"\ndip = 90.0\ndip_direction = 90.0\n"
                             "fisher_k = 10.0\nspacing = 0.1\n"))
                  .find("joint_set[1].dip: found a mean plane that lies in the section"),
              std::string::npos);
}

}  // namespace
}  // namespace crackle::joint_network_test
