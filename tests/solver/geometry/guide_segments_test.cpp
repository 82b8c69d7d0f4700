// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the guide's segment law against results by hand: rules (i) to (iv), their resultant, corners, joints and free
// ends.

#include "solver/geometry/guide_segments.hpp"

#include <algorithm>
#include <cmath>

#include "solver/geometry/overlap_gradient.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace crackle::guide_segments_test {
namespace {

using testing::agrees;
using testing::within;
using verification::rock;

// A disc of radius 5 with its centre 3 above or below the line has l = 4; a segment of length 20 has h_s = 10.
constexpr double radius = 5.0, height = 3.0;
const Bar bar{{0.0, 0.0}, {1.0, 0.0}, 20.0};

struct Expected {
    const char* name;
    Vec2 centre;
    DiscRule rule;
    double overlap;
    Vec2 normal, at;
};

TEST(DiscAgainstSegment, FollowsTheGuidesFourRules) {
    const double far = std::sqrt(10.0);  // from (-1, 3) to the end at (0, 0)
    const Expected cases[] = {
        {"(iv) middle", {10.0, height}, DiscRule::face, 2.0, {0.0, -1.0}, {10.0, 0.0}},
        {"(iv) below", {10.0, -height}, DiscRule::face, 2.0, {0.0, 1.0}, {10.0, 0.0}},
        {"(iv) h_p = h_s - l", {4.0, height}, DiscRule::face, 2.0, {0.0, -1.0}, {4.0, 0.0}},
        {"(iii) one inside", {1.0, height}, DiscRule::ramp, 2.0 * 1.0 / 4.0, {0.0, -1.0}, {1.0, 0.0}},
        {"(iii) three inside, far end", {17.0, height}, DiscRule::ramp, 2.0 * 3.0 / 4.0, {0.0, -1.0}, {17.0, 0.0}},
        {"(ii) one outside", {-1.0, height}, DiscRule::end, 5.0 - far, {1.0 / far, -3.0 / far}, {0.0, 0.0}},
        {"(ii) far end, below", {21.0, -height}, DiscRule::end, 5.0 - far, {-1.0 / far, 3.0 / far}, {20.0, 0.0}},
        {"between (ii) and (iii)", {0.0, height}, DiscRule::end, 1.0, {0.0, -1.0}, {0.0, 0.0}},
        {"(ii) on the line", {-2.0, 0.0}, DiscRule::end, 3.0, {1.0, 0.0}, {0.0, 0.0}},
        {"(i) beyond l", {-4.001, height}, DiscRule::none, 0.0, {}, {}},
        {"(i) too high", {10.0, 5.001}, DiscRule::none, 0.0, {}, {}},
    };
    for (const Expected& e : cases) {
        const DiscCase c = disc_case(bar, e.centre, radius);
        EXPECT_EQ(c.rule, e.rule) << e.name;
        EXPECT_TRUE(within(fmt::format("{}: overlap", e.name), c.overlap, e.overlap, 1e-14));
        if (e.rule == DiscRule::none) continue;
        EXPECT_TRUE(within(fmt::format("{}: normal", e.name), norm(c.normal - e.normal), 0.0, 1e-14));
        EXPECT_TRUE(within(fmt::format("{}: position", e.name), norm(c.at - e.at), 0.0, 1e-14));
    }
}

TEST(DiscAgainstSegment, OnTheLineIsPushedOutwardAndBehindItIsPushedOnBehind) {
    // α is unsigned, so a disc that has passed through is not pushed back. For counter-clockwise outlines, the outside
    // of this bar is below.
    EXPECT_TRUE(within("normal on the line, y", disc_case(bar, {10.0, 0.0}, radius).normal.y, 1.0, 0.0));
    EXPECT_TRUE(within("normal just inside, y", disc_case(bar, {10.0, 1e-9}, radius).normal.y, -1.0, 0.0));
}

/// Force divided by stiffness, y component, on a disc that moves along the bars at constant height, summed over all
/// bars.
double push(const std::vector<Bar>& bars, double x) {
    double sum = 0.0;
    for (const Bar& b : bars) {
        const DiscCase c = disc_case(b, {x, height}, radius);
        sum -= c.overlap * c.normal.y;
    }
    return sum;
}

double largest_jump(const std::vector<Bar>& bars, double from, double to, int samples) {
    double largest = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double x = from + (to - from) * k / samples, dx = (to - from) / samples;
        largest = std::max(largest, std::abs(push(bars, x + dx) - push(bars, x)));
    }
    return largest;
}

TEST(DiscAgainstSegment, JumpsAtAFreeEndButNotAtAStraightJoint) {
    const std::vector<Bar> joined{{{-20.0, 0.0}, {1.0, 0.0}, 20.0}, {{0.0, 0.0}, {1.0, 0.0}, 20.0}}, free{joined[1]};
    EXPECT_TRUE(
        within("jump of the force over k at a free end, r - |α|", push(free, -1e-9) - push(free, 1e-9), 2.0, 1e-8));
    EXPECT_TRUE(within("the same by sampling", largest_jump(free, -6.0, 6.0, 120001), 2.0, 1e-3));
    // The slope is largest at the transition between (iii) and (ii); in a thousandth of the distance, the force changes
    // at most by what that slope allows.
    const double coarse = largest_jump(joined, -6.0, 6.0, 12001), fine = largest_jump(joined, -6.0, 6.0, 120001);
    fmt::print("  straight joint: largest change of a step {:.3g} at 1e-3, {:.3g} at 1e-4\n", coarse, fine);
    EXPECT_LT(fine, 0.11 * coarse);
    EXPECT_TRUE(within("at the joint itself", push(joined, 0.0), 2.0, 1e-12));
}

struct Disc {
    Bar bar;
    Vec2 centre;
    double radius, sense;
};

DiscResultant::Contact resultant_of(const std::vector<Disc>& discs, bool mean) {
    const auto visit = [&](auto&& add) {
        for (const Disc& d : discs) add(d.bar, d.centre, d.radius, d.sense);
    };
    DiscResultant resultant;
    visit([&](const Bar& b, Vec2 centre, double r, double sense) { resultant.add(b, centre, r, sense); });
    return resultant.contact(mean, visit);
}

TEST(DiscResultant, AddsVectorsAtTheWeightedMeanPlaceAndCancels) {
    const Bar upright{{30.0, -10.0}, {0.0, 1.0}, 20.0};
    // The resultant of 2 downwards at (10, 0) and 1 to the right at (30, 0).
    const std::vector<Disc> two{{bar, {10.0, 3.0}, radius, 1.0}, {upright, {26.0, 0.0}, radius, 1.0}};
    const DiscResultant::Contact sum = resultant_of(two, false), mean = resultant_of(two, true);
    EXPECT_TRUE(agrees("overlap of the sum", sum.overlap, std::sqrt(5.0), 1e-14));
    EXPECT_TRUE(agrees("overlap of the mean", mean.overlap, 0.5 * std::sqrt(5.0), 1e-14));
    EXPECT_TRUE(within("direction", norm(sum.normal - (1.0 / std::sqrt(5.0)) * Vec2{1.0, -2.0}), 0.0, 1e-14));
    EXPECT_TRUE(within("place", norm(sum.at - Vec2{50.0 / 3.0, 0.0}), 0.0, 1e-13));

    const auto opposite = resultant_of({{bar, {10.0, 3.0}, radius, 1.0}, {bar, {10.0, -3.0}, radius, 1.0}}, false);
    EXPECT_TRUE(within("opposite cases cancel: overlap", opposite.overlap, 0.0, 0.0));

    const auto apart = resultant_of({{bar, {-30.0, 40.0}, 2.0, 1.0}, {bar, {-3.0, 4.0}, 2.0, -1.0}}, false);
    EXPECT_TRUE(within("apart: overlap is minus the nearest disc's distance", apart.overlap, -3.0, 1e-14));
    EXPECT_TRUE(within("apart: normal of a disc of j", norm(apart.normal - Vec2{-0.6, 0.8}), 0.0, 1e-14));
}

// ---- pairs of bodies

Scene empty_scene(SegmentLaw law) {
    Scene scene;
    scene.materials = {rock(0.0)};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 1.08e-3;
    scene.segment_law = law;
    return scene;
}

std::vector<Vec2> square_at(double x, double y) { return {{x, y}, {x + 0.04, y}, {x + 0.04, y + 0.04}, {x, y + 0.04}}; }

/// Force of i on j along x divided by the stiffness, m, and the overlaps of the touching points, in descending order.
std::pair<double, std::vector<double>> pressed(Scene scene) {
    World world = build_world(std::move(scene));
    compute_forces(world);
    std::vector<double> overlaps;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if (view.touching) overlaps.push_back(view.overlap);
    }
    std::ranges::sort(overlaps, std::greater<>());
    return {world.bodies.force[body_of_id(world, 2)].fx / 1e7, overlaps};
}

TEST(SegmentPairs, FacesAMillimetreApartCarryTheirFourDiscsTwice) {
    // Squares at a gap of 1 mm, shifted by 1 cm, t = 1.08 mm: two corners face the other square's edge, each with an
    // overlap of 0.08 mm. Each corner is the end of a facing edge and of an edge perpendicular to it. The rounded law
    // gives two points with 0.08 mm.
    const double once = 8e-5;
    for (const SegmentLaw law : {SegmentLaw::rounded, SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        Scene scene = empty_scene(law);
        scene.add_chain_body(1, 0, square_at(0.0, 0.0), true);
        scene.add_chain_body(2, 0, square_at(0.041, 0.01), true);
        const auto [force, overlaps] = pressed(scene);
        if (law == SegmentLaw::rounded) {
            EXPECT_TRUE(agrees("rounded: force over k_n, m", force, 2.0 * once, 1e-11));
            continue;
        }
        const bool sum = law == SegmentLaw::demseg;
        ASSERT_EQ(overlaps.size(), 3u) << "the two faces, and each corner's other edge with the opposite face";
        EXPECT_TRUE(agrees("facing pair", overlaps[0], sum ? 2.0 * once : once, 1e-11));
        EXPECT_TRUE(agrees("edge at right angles", overlaps[1], once, 1e-11));
        EXPECT_TRUE(agrees("edge at right angles", overlaps[2], once, 1e-11));
        EXPECT_TRUE(agrees("force over k_n, m", force, sum ? 4.0 * once : 3.0 * once, 1e-11));
    }
}

TEST(SegmentPairs, ACornerIsTwiceAsStiffAsASide) {
    // A circle of radius 2 cm that overlaps a side, or a corner along its bisector, by 0.1 mm at a distance of r + t.
    const double reach = 0.02 + 1.08e-3 - 1e-4;
    const auto force = [&](Vec2 centre) {
        Scene scene = empty_scene(SegmentLaw::demseg);
        scene.add_chain_body(1, 0, square_at(0.0, 0.0), true);
        scene.add_circle_body(2, 0, {centre, 0.02, 0.0});
        World world = build_world(scene);
        compute_forces(world);
        const BodyForce& f = world.bodies.force[body_of_id(world, 2)];
        return std::hypot(f.fx, f.fy) / 1e7;
    };
    const double side = force({0.02, 0.04 + reach}),
                 corner = force(Vec2{0.04, 0.04} + (reach / std::sqrt(2.0)) * Vec2{1.0, 1.0});
    EXPECT_TRUE(agrees("circle against a side: force over k_n, m", side, 1e-4, 1e-10));
    EXPECT_TRUE(agrees("against a corner", corner, 2e-4, 1e-10));
}

TEST(SegmentPairs, ASegmentOfItsOwnIsTwoThicknessesWide) {
    // Parallel open segments touch at a gap below t, from either side; in the guide, 2t is the width as seen from a
    // bare segment.
    for (const double gap : {1.07e-3, -1.07e-3, 1.09e-3}) {
        Scene scene = empty_scene(SegmentLaw::demseg);
        scene.add_chain_body(1, 0, {{0.0, 0.0}, {0.04, 0.0}}, false);
        scene.add_chain_body(2, 0, {{0.01, gap}, {0.03, gap}}, false);
        World world = build_world(scene);
        compute_forces(world);
        const double expected = std::abs(gap) < 1.08e-3 ? 2.0 * (1.08e-3 - std::abs(gap)) : 0.0;
        EXPECT_TRUE(within(fmt::format("gap {} m: force over k_n, m", gap),
                           world.bodies.force[body_of_id(world, 2)].fy / 1e7, std::copysign(expected, gap), 1e-15));
    }
}

TEST(SegmentPairs, GradientOfTheOverlapIsThatOfDifferences) {
    // Two polygons pushed into each other at random angles: every rule and combinations of rules occur.
    std::mt19937_64 generator(4);
    const auto uniform = [&](double low, double high) { return low + (high - low) * uniform_number(generator); };
    for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        Scene scene = empty_scene(law);
        scene.thick = 0.2;
        scene.add_chain_body(1, 0, {{-0.6, -0.3}, {0.5, -0.4}, {0.4, 0.5}}, true);
        scene.add_chain_body(2, 0, {{-1.0, -1.0}, {1.0, -1.2}, {1.5, 0.5}, {0.0, 1.1}}, true);
        scene.add_circle_body(3, 0, {{0.3, 0.1}, 0.4, 0.0});
        const World start = build_world(scene);
        double worst = 0.0;
        int several = 0, looked_at = 0;
        for (int k = 0; k < 600; ++k) {
            World world = start;
            for (std::size_t b = 0; b < 3; ++b) {
                world.bodies.state[b].x += uniform(-1.5, 1.5), world.bodies.state[b].y += uniform(-1.5, 1.5);
                verification::turn_body(world, b, uniform(-3.0, 3.0));
            }
            world.list.valid = false;
            compute_forces(world);
            for (PointIndex p = 0; p < world.points.size(); ++p) {
                const PointView view = view_point(world, p);
                if (!(view.overlap > 0.02)) continue;
                const auto slope = [&](BodyIndex b, int dof, double h) {
                    const auto moved = [&](double by) {
                        World w = world;
                        if (dof == 0) w.bodies.state[b].x += by;
                        if (dof == 1) w.bodies.state[b].y += by;
                        if (dof == 2) verification::turn_body(w, b, by);
                        return view_point(w, p).overlap;
                    };
                    return (moved(h) - moved(-h)) / (2.0 * h);
                };
                double error = 0.0;
                bool smooth = true;  // whether the rule stays the same within the finite difference
                for (std::size_t d = 0; d < 6; ++d) {
                    const BodyIndex b = d < 3 ? view.body_i : view.body_j;
                    const double once = slope(b, static_cast<int>(d % 3), 1e-6),
                                 half = slope(b, static_cast<int>(d % 3), 5e-7);
                    smooth = smooth && std::abs(once - half) < 1e-5 * (1.0 + std::abs(once));
                    error = std::max(error, std::abs(half - view.overlap_gradient[d]) / (1.0 + std::abs(half)));
                }
                if (!smooth) continue;
                ++looked_at;
                const OverlapGradient rounded = closing_gradient(view.normal, view.arm_i, view.arm_j);
                several += std::abs(view.overlap_gradient[0] - rounded[0]) > 0.1 ? 1 : 0;
                worst = std::max(worst, error);
            }
        }
        fmt::print("  {} points, {} of them with another gradient than the normal: off by {:.3g}\n", looked_at, several,
                   worst);
        EXPECT_GT(looked_at, 300);
        EXPECT_GT(several, 100);
        EXPECT_LT(worst, 1e-6);
    }
}

}  // namespace
}  // namespace crackle::guide_segments_test
