// SPDX-License-Identifier: GPL-3.0-or-later
// Tests flat faces of circles at a trace: how the trace is divided among circles, and the forces between two faces.

#include "solver/geometry/flat_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <utility>
#include <vector>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/state_hash.hpp"
#include "tests/support/jointed_circles.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::flat_faces_test {
namespace {

using testing::bonded_circles;
using testing::JointedCircles;
using testing::scene_of;

constexpr auto flat = static_cast<std::size_t>(PointKind::face_face);

PointIndex begin_of_faces(const World& world) { return world.points.kind_begin[flat]; }
PointIndex end_of_faces(const World& world) { return world.points.kind_begin[flat + 1]; }

Joint open_joint(double friction) {
    Joint joint;
    joint.bonded = false;
    joint.friction_angle = friction;
    return joint;
}

TEST(FlatFaces, ShareATraceByPower) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> foot(-0.1, 1.1), distance(0.0, 0.2), radius(0.03, 0.06);
    std::vector<CircleAtTrace> circles;
    for (int k = 0; k < 60; ++k) circles.push_back({foot(random), distance(random), radius(random)});
    const auto shares = share_trace(circles, 1.0);
    const auto power = [&](std::size_t k, double p) {
        const CircleAtTrace& c = circles[k];
        return (p - c.foot) * (p - c.foot) + c.distance * c.distance - c.radius * c.radius;
    };
    double covered = 0.0;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        if (!shares[k]) continue;
        EXPECT_LE(shares[k]->from, shares[k]->to);
        covered += shares[k]->to - shares[k]->from;
        const double middle = 0.5 * (shares[k]->from + shares[k]->to);
        for (std::size_t other = 0; other < circles.size(); ++other)
            EXPECT_GE(power(other, middle), power(k, middle) - 1e-12) << k << " against " << other;
    }
    EXPECT_NEAR(covered, 1.0, 1e-12);
}

TEST(FlatFaces, LieFlushAndLapOverTheWholeTrace) {
    JointedCircles circles;
    circles.from = {0.008, 0.076};  // does not coincide with ends of rows
    circles.to = {0.232, 0.124};
    const World world = bonded_circles(scene_of(circles));
    double laps = 0.0;
    for (PointIndex k = begin_of_faces(world); k < end_of_faces(world); ++k) {
        const FlatFaceContact g = flat_face_contact(BodyView(world), world.points.contact[k]);
        laps += g.lap();
        EXPECT_NEAR(g.nx, -std::sin(std::atan2(0.06, 0.28)) * (g.ny > 0.0 ? 1.0 : -1.0), 1e-12);
        if ((world.points.state[k].flags & point_bonded) != 0) {
            EXPECT_NEAR(g.closed, 0.0, 1e-15);
            EXPECT_EQ(world.points.lap[k], g.lap());
        }
    }
    EXPECT_NEAR(laps, norm(circles.to - circles.from), 1e-12);
    // There are no other contacts between circles on opposite sides.
    for (PointIndex k = 0; k < begin_of_faces(world); ++k) {
        const auto i = world.bodies.flat_faces_of(world.points.contact[k].body_i),
                   j = world.bodies.flat_faces_of(world.points.contact[k].body_j);
        if (!i.empty() && !j.empty()) {
            EXPECT_EQ(i.front().side, j.front().side);
        }
    }
}

TEST(FlatFaces, AreOfCirclesThatTheirSideHolds) {
    for (const double degrees : {0.0, 10.0, 17.0, 40.0}) {
        JointedCircles circles;
        circles.turn = degrees * std::numbers::pi / 180.0;
        const World world = bonded_circles(scene_of(circles));
        std::size_t over = 0, without = 0;
        for (const FlatFace& face : world.bodies.flat_faces) {
            const BodyState& body = world.bodies.state[face.body];
            const Vec2 from = circles.from, along{face.along_x, face.along_y};
            const bool right = cross(along, Vec2{body.x, body.y} - from) < 0.0;
            over += right != ((face.side & 1) != 0) ? 1 : 0;
            without += face.from == face.to ? 1 : 0;
            if (face.from == face.to || face.height == body.shape[0]) continue;
            int neighbours = 0;
            for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
                const BodyState& other = world.bodies.state[b];
                const auto faces = world.bodies.flat_faces_of(b);
                if (b == face.body || (!faces.empty() && faces.front().side != face.side)) continue;
                const double radii = body.shape[0] + other.shape[0];
                neighbours += std::hypot(body.x - other.x, body.y - other.y) < 1.15 * radii ? 1 : 0;
            }
            EXPECT_GE(neighbours, 2) << "a circle at " << body.x << ", " << body.y;
        }
        std::cout << degrees << " degrees: " << over << " of " << world.bodies.flat_faces.size()
                  << " circles have changed sides, " << without << " have none of the trace\n";
    }
}

TEST(FlatFaces, EndWithTheirTrace) {
    JointedCircles circles;
    circles.from = {0.05, 0.09};
    circles.to = {0.15, 0.09};
    const World world = bonded_circles(scene_of(circles));
    EXPECT_GT(end_of_faces(world), begin_of_faces(world));
    std::size_t across = 0;
    for (PointIndex k = 0; k < begin_of_faces(world); ++k) {
        const BodyState &i = world.bodies.state[world.points.contact[k].body_i],
                        &j = world.bodies.state[world.points.contact[k].body_j];
        if ((i.y - 0.09) * (j.y - 0.09) > 0.0) continue;
        ++across;
        EXPECT_TRUE(std::min(i.x, j.x) < 0.05 || std::max(i.x, j.x) > 0.15);
        EXPECT_NE(world.points.state[k].flags & point_bonded, 0) << "the rock beyond a tip holds";
    }
    EXPECT_GT(across, 5U);
}

TEST(FlatFaces, PartCirclesBeyondAnEndOutside) {
    // The trace cuts off a corner of the specimen; some circles there project beyond its end.
    const auto crossing = [](bool outside) {
        Scene scene = scene_of({});
        const Vec2 from{-0.01, 0.05}, to{0.23, 0.19};
        scene.trace_pieces = {{0, from, from + 0.9 * (to - from), true, outside}};
        const World world = bonded_circles(scene);
        std::size_t count = 0;
        for (PointIndex k = 0; k < begin_of_faces(world); ++k) {
            const auto side = [&](BodyIndex b) {
                return cross(to - from, Vec2{world.bodies.state[b].x, world.bodies.state[b].y} - from);
            };
            if (side(world.points.contact[k].body_i) * side(world.points.contact[k].body_j) < 0.0) ++count;
        }
        return count;
    };
    EXPECT_EQ(crossing(true), 0u);
    EXPECT_GT(crossing(false), 1u);
}

TEST(FlatFaces, FollowABendOnBothSides) {
    Scene scene = scene_of({});
    scene.trace_pieces = {{0, {-0.02, 0.05}, {0.11, 0.05}}, {0, {0.11, 0.05}, {0.26, 0.15}}};
    const World world = bonded_circles(scene);
    for (PointIndex k = 0; k < begin_of_faces(world); ++k) {
        const auto left = [&](BodyIndex b) {
            const auto faces = world.bodies.flat_faces_of(b);
            const BodyState& body = world.bodies.state[b];
            if (!faces.empty()) return (faces.front().side & 1) == 0;
            return body.y > (body.x < 0.11 ? 0.05 : 0.05 + (body.x - 0.11) * 0.1 / 0.15);
        };
        EXPECT_EQ(left(world.points.contact[k].body_i), left(world.points.contact[k].body_j))
            << "an ordinary contact bridges the bend";
    }
}

/// Gives bodies random velocities and spins.
void stir(World& world, double speed) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> v(-speed, speed);
    for (BodyState& body : world.bodies.state) {
        body.vx = v(random);
        body.vy = v(random);
        body.omega = v(random) / body.shape[0];
    }
    velocities_changed(world);
}

struct Momenta {
    double x = 0.0, y = 0.0, turning = 0.0, scale = 0.0;
};

Momenta momenta_of(const World& world) {
    Momenta sum;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const double mass = world.bodies.inertia[b].mass;
        sum.x += mass * body.vx;
        sum.y += mass * body.vy;
        sum.turning += mass * (body.x * body.vy - body.y * body.vx) + world.bodies.info(b).moment * body.omega;
        sum.scale += mass * std::hypot(body.vx, body.vy);
    }
    return sum;
}

TEST(FlatFaces, ConserveLinearAndAngularMomentum) {
    for (const bool bonded : {true, false}) {
        JointedCircles circles;
        circles.joint = bonded ? Joint{} : open_joint(20.0);
        World world = bonded_circles(scene_of(circles));
        stir(world, 0.05);
        const Momenta before = momenta_of(world);
        while (world.stepping.steps < 3000) step(world);
        const Momenta after = momenta_of(world);
        EXPECT_NEAR(after.x, before.x, 1e-12 * before.scale);
        EXPECT_NEAR(after.y, before.y, 1e-12 * before.scale);
        EXPECT_NEAR(after.turning, before.turning, 1e-12 * before.scale) << (bonded ? "bonded" : "open");
    }
}

TEST(FlatFaces, EnergyClosesToSecondOrderInTheStep) {
    double errors[2];
    for (const int refinement : {0, 1}) {
        JointedCircles circles;
        circles.damping_ratio = 0.0;
        circles.joint.normal_stiffness = 2e11;
        circles.joint.shear_stiffness = 1e11;
        Scene scene = scene_of(circles);
        scene.step_scale = refinement == 0 ? 0.2 : 0.1;
        scene.intact.no_breaking = true;
        World world = bonded_circles(scene);
        stir(world, 0.05);
        const double end = 6e-4;
        double worst = 0.0;
        compute_forces(world);
        const double scale = measure_ledger(world).kinetic;
        while (world.stepping.time < end) {
            step(world);
            compute_forces(world);
            worst = std::max(worst, std::abs(measure_ledger(world).closing_error) / scale);
        }
        errors[refinement] = worst;
    }
    std::cout << "largest closing error over the energy: " << errors[0] << ", at half the step " << errors[1] << "\n";
    EXPECT_LT(errors[0], 1e-2);
    EXPECT_LT(errors[1], 0.35 * errors[0]);
}

/// Two blocks with a joint along x between them; the upper one is pressed down. @param pressed force, N
Scene pressed_scene(Joint joint, double friction, double pressed, double turn = 0.0) {
    JointedCircles circles;
    circles.turn = turn;
    circles.damping_ratio = 0.4;
    circles.from = {-0.02, 0.5 * 0.01 + 0.08};
    circles.to = {0.26, 0.5 * 0.01 + 0.08};
    joint.friction_angle = friction;
    circles.joint = joint;
    Scene scene = scene_of(circles);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const double y = scene.circles[b].centre.y;
        const DofControl still{Drive::velocity, 0.0};
        if (y < 0.01) scene.controls.push_back({static_cast<int>(b), still, still, still, 0});
        if (y > 0.18) scene.controls.push_back({static_cast<int>(b), still, {Drive::force, 0.0}, still, 0});
    }
    const auto is_pressed = [](const Control& control) { return control.y.drive == Drive::force; };
    const auto count = static_cast<double>(std::ranges::count_if(scene.controls, is_pressed));
    for (Control& control : scene.controls)
        if (is_pressed(control)) control.y.value = -pressed / count;
    return scene;
}

/// Moves the upper block along the joint after it has come to rest. @param speed m/s
void push(World& world, double speed, std::int64_t rest_steps = 3000) {
    while (world.stepping.steps < rest_steps) step(world);
    for (const ControlState& control : world.bodies.controls)
        if (control.dof[1].drive == Drive::force) change_velocity(world, control.body, 0, speed);
}

double pull_on(const World& world) {
    double sum = 0.0;
    for (const ControlState& control : world.bodies.controls)
        if (control.dof[1].drive == Drive::force) sum -= world.bodies.force[control.body].fx;
    return sum;
}

TEST(FlatFaces, SlideFartherThanACircleAtCoulombsLimit) {
    constexpr double pressed = 2e5, friction = 25.0, speed = 0.1;  // N, degrees, m/s
    for (const double degrees : {0.0, 17.0, 40.0}) {               // angle between joint and rows
        const double turn = degrees * std::numbers::pi / 180.0;
        World world = bonded_circles(pressed_scene(open_joint(friction), friction, pressed, turn));
        push(world, speed);
        const double limit = pressed * std::tan(friction * std::numbers::pi / 180.0), start = world.stepping.time;
        double least = limit, most = limit;
        for (double slid = 0.0; slid < 0.05; slid = speed * (world.stepping.time - start)) {  // 2.5 diameters
            for (int n = 0; n < 50; ++n) step(world);
            compute_forces(world);
            if (slid < 0.005) continue;
            least = std::min(least, pull_on(world));
            most = std::max(most, pull_on(world));
        }
        const Ledger ledger = measure_ledger(world);
        const double work = std::abs(ledger.displacement_work) + std::abs(ledger.force_work);
        std::cout << degrees << " degrees: pull over the limit " << least / limit << " to " << most / limit
                  << ", closing error over work " << ledger.closing_error / work << ", of the law "
                  << ledger.law_loss / work << ", broken " << world.bonds.broken << "\n";
        EXPECT_GT(least, 0.99 * limit);
        EXPECT_LT(most, 1.01 * limit);
        EXPECT_EQ(world.bonds.broken, 0);
        EXPECT_NEAR(ledger.closing_error / work, 0.0, 1e-5);
    }
}

// Faces that separate because circles rotate must not touch again at once. Blocks are pressed together by an open joint
// and their circles are set spinning; without friction and damping the energy must be conserved.
TEST(FlatFaces, GainNoEnergyAsTurningOpensThem) {
    Scene scene = pressed_scene(open_joint(0.0), 0.0, 2e5);
    scene.materials[0].damping_ratio = 0.0;
    scene.intact.no_breaking = true;
    scene.step_scale = 0.1;
    World world = bonded_circles(scene);
    push(world, 5.0, 1000);  // at 5 m/s, until faces meet other faces than initially
    for (const double start = world.stepping.time; world.stepping.time < start + 0.015 / 5.0;) step(world);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> spin(-2000.0, 2000.0);  // rad/s
    for (BodyState& body : world.bodies.state)
        if (body.y > 0.01 && body.y < 0.18) body.omega = spin(random);
    velocities_changed(world);
    compute_forces(world);
    const Ledger begin = measure_ledger(world);  // its account does not include the spins
    double worst = 0.0;
    for (int n = 0; n < 20000; ++n) {
        step(world);
        compute_forces(world);
        const double error = measure_ledger(world).closing_error - begin.closing_error;
        worst = std::max(worst, std::abs(error) / begin.kinetic);
    }
    std::cout << "largest closing error over the energy: " << worst << "\n";
    EXPECT_LT(worst, 1e-2);
}

TEST(FlatFaces, KeepTheirLapWhileTheyAreBonded) {
    World world = bonded_circles(scene_of({}));
    for (BodyState& body : world.bodies.state) body.vx += 5.0 * (body.y - 0.1);
    velocities_changed(world);
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    const auto bonded_laps = [&] {
        std::map<Pair, double> laps;  // keyed by pairs of faces
        for (PointIndex k = begin_of_faces(world); k < end_of_faces(world); ++k) {
            const ContactPoint point = world.points.contact[k];
            if ((world.points.state[k].flags & point_bonded) != 0)
                laps[{point.element_i, point.feature_j}] = world.points.lap[k];
        }
        return laps;
    };
    const std::map<Pair, double> before = bonded_laps();
    for (int n = 0; n < 200; ++n) step(world);
    double moved = 0.0;  // m, displacement of faces along each other
    for (PointIndex k = begin_of_faces(world); k < end_of_faces(world); ++k)
        if ((world.points.state[k].flags & point_bonded) != 0)
            moved = std::max(
                moved, std::abs(flat_face_contact(BodyView(world), world.points.contact[k]).lap() -
                                before.at({world.points.contact[k].element_i, world.points.contact[k].feature_j})));
    EXPECT_GT(moved, 1e-7);
    const std::map<Pair, double> after = bonded_laps();
    EXPECT_GT(after.size(), 10U);
    for (const auto& [faces, lap] : after) EXPECT_EQ(lap, before.at(faces));
}

TEST(FlatFaces, MoveAlikeWheneverTheListIsBuilt) {
    const auto run = [](bool often) {
        Scene scene = pressed_scene(open_joint(25.0), 25.0, 2e5);
        scene.time_step = 1e-6;  // fixed, since an automatic step depends on the list
        World world = bonded_circles(scene);
        push(world, 2.0, 1000);
        while (world.stepping.steps < 6000) {
            if (often && world.stepping.steps % 7 == 0) bodies_moved(world);
            step(world);
        }
        compute_forces(world);
        return world;
    };
    const World rarely = run(false), often = run(true);
    EXPECT_GT(often.list.builds, 5 * rarely.list.builds);
    EXPECT_GT(rarely.list.builds, 2);
    for (BodyIndex b = 0; b < rarely.bodies.size(); ++b) {
        EXPECT_NEAR(rarely.bodies.state[b].x, often.bodies.state[b].x, 1e-12);
        EXPECT_NEAR(rarely.bodies.state[b].y, often.bodies.state[b].y, 1e-12);
    }
}

TEST(FlatFaces, GoOnFromACheckpointAndOnMoreThreadsToTheByte) {
    Joint joint = open_joint(25.0);
    joint.normal_stiffness = 3e11;
    joint.dilation_angle = 3.0;
    const auto start = [&](int threads) {
        World world = bonded_circles(pressed_scene(joint, 25.0, 2e5));
        set_threads(world, threads);
        push(world, 5.0, 100);
        return world;
    };
    const auto run_to = [](World& world, std::int64_t steps) {
        while (world.stepping.steps < steps) step(world);
    };
    World one = start(1), two = start(2), first = start(1);
    run_to(one, 800);
    run_to(two, 800);
    EXPECT_EQ(hash_state(one), hash_state(two));
    run_to(first, 400);
    std::stringstream file;
    save_world(first, file);
    World again = load_world(file.str(), "checkpoint", "");
    run_to(again, 800);
    EXPECT_EQ(hash_state(one), hash_state(again));
}

TEST(FlatFaces, OfAnOpenJointBearNothingUntilItsApertureHasClosed) {
    constexpr double aperture = 1e-4, stiffness = 2e11;  // m, Pa/m
    Joint joint = open_joint(30.0);
    joint.aperture = aperture;
    joint.normal_stiffness = stiffness;
    JointedCircles circles;
    circles.from = {-0.02, 0.085};
    circles.to = {0.26, 0.085};
    circles.joint = joint;
    World world = bonded_circles(scene_of(circles));
    const auto lower_the_upper_block = [&](double by) {
        for (BodyState& body : world.bodies.state)
            if (body.y > 0.085) body.y -= by;
        bodies_moved(world);
        compute_forces(world);
    };
    const auto force = [&] {
        double sum = 0.0;
        for (BodyIndex b = 0; b < world.bodies.size(); ++b)
            if (world.bodies.state[b].y > 0.085) sum += world.bodies.force[b].fy;
        return sum;
    };
    lower_the_upper_block(0.999 * aperture);
    EXPECT_NEAR(force(), 0.0, 1e-12);
    lower_the_upper_block(1.001 * aperture);
    // Each face in a row has E_c λ/(r_i + r_j) in series with K_n λ.
    double expected = 0.0;
    for (PointIndex k = begin_of_faces(world); k < end_of_faces(world); ++k) {
        const ContactPoint point = world.points.contact[k];
        const FlatFaceContact g = flat_face_contact(BodyView(world), point);
        const double radii = world.bodies.state[point.body_i].shape[0] + world.bodies.state[point.body_j].shape[0];
        expected += g.lap() / (radii / 5e9 + 1.0 / stiffness) * std::max(0.0, g.closed - aperture);
    }
    EXPECT_GT(expected, 1000.0);
    EXPECT_NEAR(force() / expected, 1.0, 1e-6);
}

TEST(FlatFaces, BrokenBondsRubAtTheResidualAngleOfTheJoint) {
    constexpr double pressed = 2e5, speed = 0.2;
    Joint joint;
    joint.cohesion = 1e5;
    joint.tensile_strength = 0.0;
    joint.residual_friction_angle = 15.0;
    World world = bonded_circles(pressed_scene(joint, 30.0, pressed));
    const std::int64_t bonds = [&] {
        std::int64_t count = 0;
        for (PointIndex k = begin_of_faces(world); k < end_of_faces(world); ++k)
            count += (world.points.state[k].flags & point_bonded) != 0 ? 1 : 0;
        return count;
    }();
    push(world, speed);
    const double start = world.stepping.time;
    while (speed * (world.stepping.time - start) < 0.02) step(world);
    compute_forces(world);
    EXPECT_EQ(world.bonds.broken, bonds) << "only that of the joint";
    EXPECT_NEAR(pull_on(world) / (pressed * std::tan(15.0 * std::numbers::pi / 180.0)), 1.0, 0.01);
}

TEST(FlatFaces, AreOfSingleCircles) {
    Scene scene = scene_of({});
    scene.bodies.front().circle_count = 2;
    scene.bodies[1].first_circle = 1;
    const std::string said = testing::refusal([&] { build_world(scene); });
    EXPECT_NE(said.find("found body 1, a clump, expected single circles"), std::string::npos) << said;
    scene = scene_of({});
    scene.trace_pieces.front().trace = 1;
    EXPECT_NE(testing::refusal([&] { build_world(scene); }).find("a trace number below 1"), std::string::npos);
    scene = scene_of({});
    scene.joints.front() = open_joint(20.0);
    scene.joints.front().aperture = 0.02;
    EXPECT_NE(testing::refusal([&] { build_world(scene); }).find("at most the radius of the smallest circle, 0.009 m"),
              std::string::npos);
}

}  // namespace
}  // namespace crackle::flat_faces_test
