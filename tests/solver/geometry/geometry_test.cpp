// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the closest feature of outlines against a simple reference. The remembered edge must be only a starting guess,
// and forces must be the gradient of the stored energy.

#include "solver/geometry/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/plain_distance.hpp"

namespace crackle {
namespace {

using testing::distance_to_outline;
using verification::rock;

/// Corners on an ellipse at random angles: convex, including short edges and sharp corners.
std::vector<Vec2> random_convex(std::mt19937_64& generator) {
    const std::size_t n = 3 + uniform_below(generator, 8);
    std::vector<double> angles;
    while (angles.size() < n) {
        const double angle = uniform_number(generator, 0.0, 2.0 * std::numbers::pi);
        if (std::ranges::all_of(angles, [&](double a) { return std::abs(a - angle) > 1e-3; })) angles.push_back(angle);
    }
    std::ranges::sort(angles);
    const double flat = uniform_number(generator, 0.1, 1.0);
    std::vector<Vec2> corners;
    for (const double angle : angles) corners.push_back({std::cos(angle), flat * std::sin(angle)});
    return corners;
}

World world_of(const std::vector<Vec2>& outline, bool closed) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 0.01;
    scene.add_chain_body(1, 0, outline, closed);
    return build_world(scene);
}

TEST(ConvexOutline, EdgeFacedLastIsAMereHint) {
    std::mt19937_64 generator(7);
    double worst_distance = 0.0, worst_normal = 0.0, worst_hint = 0.0;
    int inside = 0, total = 0;
    for (int polygon = 0; polygon < 300; ++polygon) {
        const std::vector<Vec2> corners = random_convex(generator);
        const World world = world_of(corners, true);
        ASSERT_EQ(world.bodies.pieces.size(), 1u);
        const Piece& piece = world.bodies.pieces[0];
        const Vec2 centroid{world.bodies.state[0].x, world.bodies.state[0].y};
        for (int k = 0; k < 200; ++k) {
            Vec2 p{uniform_number(generator, -1.5, 1.5), uniform_number(generator, -1.5, 1.5)};
            if (k % 10 == 0) p = corners[static_cast<std::size_t>(k) % corners.size()];  // exactly on a corner
            if (k % 10 == 1) {                                                           // slightly outside an edge
                const std::size_t e = static_cast<std::size_t>(k) % corners.size();
                p = 0.5 * (corners[e] + corners[(e + 1) % corners.size()]);
            }
            const Vec2 local = p - centroid;
            const OutlineFacing plain = detail::face_every_edge(world.bodies.edges.data(), piece, local.x, local.y);
            const double expected = distance_to_outline(p, corners, true);
            worst_distance = std::max(worst_distance, std::abs(plain.distance - expected));
            inside += expected < 0.0 ? 1 : 0;
            ++total;
            for (std::uint32_t hint = 0; hint <= piece.edge_count; ++hint) {  // includes one beyond the last
                const OutlineFacing quick =
                    detail::face_convex(world.bodies.edges.data(), piece, hint, local.x, local.y);
                worst_hint = std::max(worst_hint, std::abs(quick.distance - plain.distance));
                if (std::abs(plain.distance) > 1e-6) {
                    worst_normal =
                        std::max(worst_normal, std::hypot(quick.gx - plain.gx, quick.gy - plain.gy) * plain.distance);
                }
            }
        }
    }
    fmt::print("  {} points, {} inside: distance off the plain one by {:.2g}, over hints by {:.2g}, normal by {:.2g}\n",
               total, inside, worst_distance, worst_hint, worst_normal);
    EXPECT_GT(inside, total / 10);
    EXPECT_LT(worst_distance, 1e-14);
    EXPECT_LT(worst_hint, 1e-14);
    EXPECT_LT(worst_normal, 1e-14);
}

TEST(ConvexOutline, DistanceAndNormalAreContinuousAroundEveryCorner) {
    std::mt19937_64 generator(8);
    double worst = 0.0;
    for (int polygon = 0; polygon < 50; ++polygon) {
        const std::vector<Vec2> corners = random_convex(generator);
        const World world = world_of(corners, true);
        const Vec2 centroid{world.bodies.state[0].x, world.bodies.state[0].y};
        const double reach = 1.2, step = 1e-4;
        OutlineFacing last{};
        Vec2 before;
        for (int k = 0; k <= 62832; ++k) {
            const Vec2 p{reach * std::cos(step * k), reach * std::sin(step * k)};
            const OutlineFacing now =
                face_outline(BodyView(world), world.bodies.info(0), last.edge, p.x - centroid.x, p.y - centroid.y);
            if (k > 0) {
                // |∇d| = 1, and the normal rotates no faster than around a corner at that distance.
                const double way = norm(p - before);
                worst = std::max({worst, std::abs(now.distance - last.distance) / way,
                                  std::hypot(now.gx - last.gx, now.gy - last.gy) * now.distance / way});
            }
            last = now;
            before = p;
        }
    }
    fmt::print("  largest change of distance, or of normal times distance, over the way: {:.6f} (at most 1)\n", worst);
    EXPECT_LT(worst, 1.0 + 1e-6);
}

const std::vector<Vec2> comb{{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 2}, {2.2, 1}, {1, 1}, {1, 3}, {0, 3}};

TEST(NonConvexOutline, DistanceOutsideIsThatOfTheWholeOutline) {
    std::mt19937_64 generator(9);
    const World closed = world_of(comb, true), open = world_of(comb, false);
    EXPECT_GT(closed.bodies.info(0).piece_count, 1u);
    double worst_closed = 0.0, worst_open = 0.0;
    int outside = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec2 p{uniform_number(generator, -1.0, 6.0), uniform_number(generator, -1.0, 4.0)};
        const double expected = distance_to_outline(p, comb, true);
        const auto facing = [&](const World& world) {
            return face_outline(BodyView(world), world.bodies.info(0), 0, p.x - world.bodies.state[0].x,
                                p.y - world.bodies.state[0].y);
        };
        worst_open = std::max(worst_open, std::abs(facing(open).distance - distance_to_outline(p, comb, false)));
        if (expected >= 0.0) {
            ++outside;
            worst_closed = std::max(worst_closed, std::abs(facing(closed).distance - expected));
        } else {
            EXPECT_LT(facing(closed).distance, 0.0) << p.x << ' ' << p.y;
        }
    }
    fmt::print("  {} outside points of 20000: closed off by {:.2g}, open by {:.2g}\n", outside, worst_closed,
               worst_open);
    EXPECT_GT(outside, 5000);
    EXPECT_LT(worst_closed, 1e-13);
    EXPECT_LT(worst_open, 1e-13);
}

/// Two close bodies without friction: force and moment must be minus the gradient of the stored energy. @return largest
/// error
double gradient_error(Scene scene, int samples) {
    std::mt19937_64 generator(10);
    scene.materials = {rock(0.0)};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 0.2;
    const World start = build_world(scene);
    double worst = 0.0;
    int touching = 0;
    for (int k = 0; k < samples; ++k) {
        World world = start;
        world.bodies.state[0].x += uniform_number(generator, -3.0, 3.0);
        world.bodies.state[0].y += uniform_number(generator, -3.0, 3.0);
        verification::turn_body(world, 0, uniform_number(generator, -3.0, 3.0));
        const auto energy = [](World w) {
            w.list.valid = false;
            w.stepping.forces_current = false;
            compute_forces(w);
            return measure_ledger(w).strain;
        };
        if (energy(world) == 0.0) continue;
        world.list.valid = false;
        compute_forces(world);
        bool deep = false;  // inside, the gradient of the distance jumps where the closest edge changes
        for (PointIndex p = 0; p < world.points.size(); ++p) {
            const PointView view = view_point(world, p);
            deep = deep || view.overlap > 0.19;
        }
        if (deep) continue;
        ++touching;
        const double h = 1e-6;
        const double scale = std::hypot(world.bodies.force[0].fx, world.bodies.force[0].fy);
        for (int d = 0; d < 3; ++d) {
            World plus = world, minus = world;
            if (d == 0) plus.bodies.state[0].x += h, minus.bodies.state[0].x -= h;
            if (d == 1) plus.bodies.state[0].y += h, minus.bodies.state[0].y -= h;
            if (d == 2) verification::turn_body(plus, 0, h), verification::turn_body(minus, 0, -h);
            const double slope = (energy(plus) - energy(minus)) / (2.0 * h);
            const double force = d == 0   ? world.bodies.force[0].fx
                                 : d == 1 ? world.bodies.force[0].fy
                                          : world.bodies.force[0].torque;
            worst = std::max(worst, std::abs(force + slope) / scale);
        }
    }
    fmt::print("  {} touching positions: force off the energy's gradient by {:.3g}\n", touching, worst);
    EXPECT_GT(touching, samples / 100);
    return worst;
}

TEST(ContactForce, IsTheGradientOfTheStoredEnergyForPolygons) {
    Scene scene;
    scene.add_chain_body(1, 0, {{-0.6, -0.3}, {0.5, -0.4}, {0.4, 0.5}}, true);
    scene.add_chain_body(2, 0, {{-1.0, -1.0}, {1.0, -1.2}, {1.5, 0.5}, {0.0, 1.1}}, true);
    EXPECT_LT(gradient_error(scene, 4000), 1e-8);
}

TEST(ContactForce, IsTheGradientOfTheStoredEnergyForAnOpenChainAndAClump) {
    Scene scene;
    scene.add_circle_body(1, 0, {{-0.2, 0.0}, 0.3, 0.0});
    scene.circles.push_back({{0.3, 0.1}, 0.2, 0.0});
    scene.bodies.back().circle_count = 2;
    scene.add_chain_body(2, 0, {{-1.0, -1.0}, {1.0, -0.8}, {1.2, 1.5}}, false);
    EXPECT_LT(gradient_error(scene, 4000), 1e-8);
}

}  // namespace
}  // namespace crackle
