// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a failing run stops and names step, body and cause, and that an unusable time step is refused at the
// start.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using verification::rock;

Scene heap() {
    DisorderedDiscs request;
    request.columns = 6, request.rows = 6;
    Scene scene = disordered_discs(request, rock());
    scene.domain = {-0.05, 0.3, -0.05, 0.4, {true, true, true, true}};
    return scene;
}

/// Message of the UnstableRun that check_health() must throw; the body must be `id` (0: any).
std::string verdict(World& world, int id) {
    try {
        check_health(world);
    } catch (const UnstableRun& error) {
        EXPECT_EQ(error.step, world.stepping.steps);
        if (id != 0) {
            EXPECT_EQ(error.body, id) << error.what();
        }
        EXPECT_NE(std::string(error.what()).find(fmt::format("step {}, body {}", error.step, error.body)),
                  std::string::npos)
            << error.what();
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    ADD_FAILURE() << "expected the run to be stopped";
    return {};
}

TEST(Health, OfASoundRunIsGood) {
    World world = build_world(heap());
    bond_all(world, 0.0);
    verification::shake(world, 0.5 * verification::breaking_energy(world), 2);
    for (int n = 0; n < 2000; ++n) {
        compute_forces(world);
        EXPECT_NO_THROW(check_health(world));
        advance(world);
    }
    EXPECT_GT(world.bonds.broken, 0);
}

TEST(Health, NotANumberStopsTheRunAndNamesTheBody) {
    for (int component = 0; component < 3; ++component) {
        World world = build_world(heap());
        step(world);
        BodyState& body = world.bodies.state[body_of_id(world, 17)];
        (component == 0 ? body.vx : component == 1 ? body.omega : body.y) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_NE(verdict(world, 17).find("not a number"), std::string::npos);
    }
}

TEST(Health, NotANumberIsNoticedByTheStepItself) {
    World world = build_world(heap());
    step(world);
    world.bodies.state[body_of_id(world, 17)].vx = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(step(world), UnstableRun);
}

TEST(Health, ABodyBeyondAWallStopsTheRun) {
    World world = build_world(heap());
    step(world);
    world.bodies.state[body_of_id(world, 5)].y = -0.06;
    EXPECT_NE(verdict(world, 5).find("left the domain"), std::string::npos);
}

TEST(Health, ABodyTooFastForTheListStopsTheRunAtOnce) {
    Scene scene = heap();
    scene.bodies[7].velocity = {1e4, 0.0};
    World world = build_world(scene);
    try {
        step(world);
        FAIL() << "expected the run to be stopped";
    } catch (const UnstableRun& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_EQ(error.body, scene.bodies[7].id);
        EXPECT_EQ(error.step, 1);
    }
}

/// Message that stops a body thrown at a held one, slow enough for the list to notice it; the run ends at the latest
/// 0.2 m behind it.
std::string stopped_by(Scene scene, bool allow_unstable) {
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({1, held, held, held, 0});
    scene.materials = {rock(0.0)};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 1e-3;
    World world = build_world(std::move(scene));
    world.stepping.allow_unstable = allow_unstable;
    const BodyIndex b = body_of_id(world, 1);
    try {
        while (world.bodies.state[b].x < 0.2 && world.bodies.state[b].vx > 0.0) step(world);
    } catch (const UnstableRun& error) {
        EXPECT_EQ(error.body, 1);
        EXPECT_GT(error.step, 1);
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return world.bodies.state[b].vx > 0.0 ? "nothing" : "rebound";
}

TEST(Health, ACircleThroughASegmentStopsTheRun) {
    const auto shot = [](double speed) {
        Scene scene;
        scene.add_circle_body(1, 0, {{-0.05, 0.0}, 0.02, 0.0});
        scene.add_chain_body(2, 0, {{-0.01, -0.5}, {0.0, -0.1}, {0.0, 0.5}}, false);
        scene.bodies[0].velocity = {speed, 0.0};
        return scene;
    };
    EXPECT_EQ(stopped_by(shot(10.0), false), "rebound");
    const std::string stopped = stopped_by(shot(60.0), false);
    EXPECT_NE(stopped.find("it went through segment 2 of body 2"), std::string::npos);
    EXPECT_NE(stopped.find("four segments that form a closed box"), std::string::npos);
    EXPECT_EQ(stopped_by(shot(60.0), true), "nothing") << "requested with --allow-unstable";
}

TEST(Health, APolygonThroughAPolygonStopsTheRun) {
    const auto shot = [](double speed) {
        Scene scene;
        const auto square = [&](int id, Vec2 c) {
            scene.add_chain_body(
                id, 0, {c + Vec2{-0.02, -0.02}, c + Vec2{0.02, -0.02}, c + Vec2{0.02, 0.02}, c + Vec2{-0.02, 0.02}},
                true);
        };
        square(1, {-0.05, 0.003});
        square(2, {0.0, 0.0});
        scene.bodies[0].velocity = {speed, 0.0};
        return scene;
    };
    EXPECT_EQ(stopped_by(shot(1.0), false), "rebound");
    EXPECT_NE(stopped_by(shot(60.0), false).find("its centroid moved into body 2"), std::string::npos);
}

TEST(Health, RunawayEnergyStopsTheRun) {
    World world = build_world(heap());
    bond_all(world, 0.0);
    world.stepping.automatic_step = false;
    world.stepping.time_step = 1.3 * world.stepping.step_bound;  // above what build_world() accepts
    for (PointState& point : world.points.state) point.flags |= point_counted;
    verification::shake(world, 1e-4 * verification::breaking_energy(world), 2);
    std::string cause;
    for (int n = 0; n < 2000 && cause.empty(); ++n) {
        try {
            compute_forces(world);
            if (n % 10 == 0) check_health(world);
            advance(world);
        } catch (const UnstableRun& error) {
            cause = error.what();
            EXPECT_GT(error.step, 0);
            EXPECT_GE(error.body, 1);
        }
    }
    fmt::print("  {}\n", cause);
    EXPECT_NE(cause.find("runaway energy"), std::string::npos) << cause;
    EXPECT_NE(cause.find("bound"), std::string::npos);
}

TEST(Health, EnergyFromNowhereIsBorneUpToTheSupplyAndNamesTheBodyThatCarriesMost) {
    // Two discs that never meet; the energy supplied is their initial kinetic energy.
    Scene scene;
    scene.materials = {rock()};
    scene.domain = {-10.0, 10.0, -10.0, 10.0, {true, true, true, true}};
    scene.time_step = 1e-5;
    scene.add_circle_body(4, 0, {{-3.0, 0.0}, 0.5, 0.0});
    scene.add_circle_body(7, 0, {{3.0, 0.0}, 0.5, 0.0});
    scene.bodies[0].velocity = {0.1, 0.0};
    scene.bodies[1].velocity = {1.0, 0.0};
    for (const double share : {1.9, 2.1}) {
        World world = build_world(scene);
        compute_forces(world);
        check_health(world);
        for (BodyState& body : world.bodies.state) body.vx *= std::sqrt(share);
        if (share < 2.0)
            EXPECT_NO_THROW(check_health(world));
        else
            EXPECT_NE(verdict(world, 7).find("runaway energy"), std::string::npos);
    }
}

TEST(TimeStep, AboveTheBoundIsRefusedNamingBoth) {
    Scene scene = heap();
    const double bound = build_world(scene).stepping.step_bound;
    scene.time_step = 1.5 * bound;
    try {
        build_world(scene);
        FAIL() << "expected the time step to be refused";
    } catch (const InputError& error) {
        const std::string text = error.what();
        fmt::print("  {}\n", text);
        EXPECT_NE(text.find(fmt::format("{}", scene.time_step)), std::string::npos);
        EXPECT_NE(text.find(fmt::format("{:.6g}", bound)), std::string::npos);
        EXPECT_NE(text.find("--allow-unstable"), std::string::npos);
    }
    scene.allow_unstable = true;
    EXPECT_NO_THROW(build_world(scene));
    scene.allow_unstable = false;
    scene.time_step = bound;
    EXPECT_NO_THROW(build_world(scene));
}

TEST(TimeStep, ChosenByItselfIsTheSafeShareOfTheBound) {
    Scene scene = heap();
    scene.safety_factor = 0.3;
    World world = build_world(scene);
    bond_all(world, 0.0);
    EXPECT_TRUE(testing::agrees(
        "step over exact", world.stepping.time_step / critical_step(world, ClosedPoints::touching).step, 0.3, 1e-15));
    scene.safety_factor = 0.5 * loose_step_share;
    world = build_world(scene);
    EXPECT_TRUE(testing::agrees("smaller than the loose share", world.stepping.time_step / world.stepping.step_bound,
                                scene.safety_factor, 1e-15));
}

std::string refusal(Scene scene) {
    try {
        build_world(std::move(scene));
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return "accepted";
}

/// A disc with six others around it at a distance of `gap` between surfaces.
Scene ring(double gap) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    for (int k = 0; k < 6; ++k) {
        const double angle = std::numbers::pi / 3.0 * k, distance = 0.04 + gap;
        scene.add_circle_body(2 + k, 0, {{distance * std::cos(angle), distance * std::sin(angle)}, 0.02, 0.0});
    }
    return scene;
}

/// Moves the bodies of a ring until they touch.
void close_ring(World& world) {
    for (BodyState& body : world.bodies.state) {
        const double distance = std::hypot(body.x, body.y);
        if (distance < 0.01) continue;
        body.x *= 0.04 / distance;
        body.y *= 0.04 / distance;
    }
    world.list.valid = false;
    world.stepping.forces_current = false;
    compute_forces(world);
}

TEST(TimeStep, OutgrownByAPileStopsTheRunNamingBoth) {
    Scene scene = ring(0.01);
    scene.time_step = 0.95 * build_world(scene).stepping.step_bound;
    World world = build_world(scene);
    for (int n = 0; n < 3; ++n) step(world);
    try {
        close_ring(world);
        FAIL() << "expected the run to be stopped";
    } catch (const UnstableRun& error) {
        const std::string text = error.what();
        fmt::print("  {}\n", text);
        EXPECT_EQ(error.step, 3);
        EXPECT_EQ(error.body, 1) << "the disc in the middle";
        EXPECT_NE(text.find(fmt::format("{:.6g} s", world.stepping.time_step)), std::string::npos);
        EXPECT_NE(text.find(fmt::format("{:.6g} s", world.stepping.step_bound)), std::string::npos);
        EXPECT_NE(text.find("--allow-unstable"), std::string::npos);
    }
    scene.allow_unstable = true;
    world = build_world(scene);
    EXPECT_NO_THROW(close_ring(world));
}

TEST(TimeStep, ChosenByItselfIsLoweredAsBodiesPileUp) {
    World world = build_world(ring(0.01));
    const double before = world.stepping.time_step;
    close_ring(world);
    EXPECT_LT(world.stepping.time_step, before);
    EXPECT_TRUE(testing::agrees("step over bound", world.stepping.time_step / world.stepping.step_bound,
                                derived_step_share(world), 1e-15));
}

TEST(TimeStep, ChosenByItselfTakesTheLooseShareUntilThereAreBonds) {
    Scene scene = heap();
    scene.thick = 0.0;
    World world = build_world(scene);
    EXPECT_TRUE(testing::agrees("step over bound, loose", world.stepping.time_step / world.stepping.step_bound,
                                loose_step_share, 1e-15));
    bond_all(world, 0.0);
    EXPECT_TRUE(testing::agrees("step over exact, bonded",
                                world.stepping.time_step / critical_step(world, ClosedPoints::touching).step,
                                scene.safety_factor, 1e-15));
}

TEST(StableStep, OfGroupsApartIsTheLeastForAnyThreadsAndNamesItsBody) {
    double least = 1.0;
    Scene both;
    for (const double scale : {1.0, 0.3, 2.0}) {  // the step is determined by light discs between heavier ones
        Scene group = heap();
        for (CircleElement& circle : group.circles) {
            circle.centre = scale * circle.centre + Vec2{3.0 * scale, 0.0};
            circle.radius *= scale;
        }
        group.domain.wall_present = {false, false, false, false};
        least = std::min(least, build_world(group).stepping.step_bound);
        const std::size_t before = both.bodies.size();
        for (const CircleElement& circle : group.circles)
            both.add_circle_body(static_cast<int>(both.bodies.size()) + 1, 0, circle);
        both.materials = group.materials;
        both.domain = group.domain;
        both.skin = 0.0;
        EXPECT_EQ(both.bodies.size(), before + group.bodies.size());
    }
    const World one = build_world(both);
    both.threads = 3;
    const World three = build_world(both);
    EXPECT_EQ(one.stepping.step_bound, three.stepping.step_bound);
    BodyIndex limiting = 0;
    EXPECT_EQ(stable_step_bound(three, &limiting), one.stepping.step_bound);
    EXPECT_TRUE(testing::within("body of the second group", one.bodies.info(limiting).id, 54.5, 18.0));
    EXPECT_TRUE(testing::agrees("bound", one.stepping.step_bound, least,
                                1e-8));  // an eigenvalue may lose half its digits
}

TEST(TimeStep, CannotBeDerivedWhereEveryBodyIsHeld) {
    Scene scene;
    scene.materials = {rock()};
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    const DofControl held{Drive::velocity, 0.1};
    scene.controls.push_back({0, held, held, held, 0});
    EXPECT_NE(refusal(scene).find("time step: found 0 (automatic)"), std::string::npos);
    scene.time_step = 1e-5;
    EXPECT_EQ(refusal(scene), "accepted");
}

TEST(Health, RoundingAtRestIsNoRunaway) {
    Scene scene = heap();
    for (CircleElement& circle : scene.circles) circle.centre = circle.centre + Vec2{3.0, 7.0};
    scene.domain.wall_present = {false, false, false, false};
    World world = build_world(scene);
    bond_all(world, 0.0);
    for (double& overlap : world.points.bond_overlap)
        overlap = std::nextafter(overlap, 1.0);  // as a value may be after writing to a text file and reading
    double largest = 0.0;
    for (int n = 0; n < 20000; ++n) {
        compute_forces(world);
        ASSERT_NO_THROW(check_health(world)) << "step " << n;
        if (n % 100 == 0) largest = std::max(largest, measure_ledger(world).kinetic);
        advance(world);
    }
    fmt::print("  largest kinetic energy of the rounding: {:.3g} J\n", largest);
}

TEST(Health, AHeldBodyMayLieBeyondAWallAFreeOneIsRefused) {
    Scene scene = heap();
    // An L whose centroid is outside although its foot is inside.
    const auto wall = scene.add_chain_body(
        900, 0, {{-0.2, -0.04}, {-0.2, 0.3}, {-0.21, 0.3}, {-0.21, -0.05}, {0.3, -0.05}, {0.3, -0.04}}, true);
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({static_cast<int>(wall), held, held, held, 0});
    World world = build_world(scene);
    compute_forces(world);
    EXPECT_NO_THROW(check_health(world));
    scene.controls.clear();
    EXPECT_NE(refusal(scene).find("body 900: found its centroid at ("), std::string::npos);
}

TEST(Scene, SoFarFromTheOriginThatPositionsCannotMoveIsRefused) {
    Scene scene = heap();
    scene.domain.wall_present = {false, false, false, false};
    scene.circles[4].centre.x += 1e6;
    const std::string text = refusal(scene);
    EXPECT_NE(text.find(fmt::format("body {}: ", scene.bodies[4].id)), std::string::npos) << text;
    EXPECT_NE(text.find("move the origin"), std::string::npos) << text;
    scene.circles[4].centre.x -= 0.99e6;
    EXPECT_EQ(refusal(scene), "accepted");
    scene.add_chain_body(901, 0, {{1e9, 0.0}, {1e9 + 0.5, 0.0}, {1e9, 0.5}}, true);
    EXPECT_NE(refusal(scene).find("body 901: "), std::string::npos);
}

TEST(Scene, BareSegmentsAndCornersThatCannotTouchAreTold) {
    Scene scene = heap();
    scene.bare_segment_width = 0.1;
    EXPECT_TRUE(scene_notices(scene).empty());
    scene.add_chain_body(901, 0, {{-0.04, -0.04}, {0.2, -0.04}}, false);
    EXPECT_TRUE(scene_notices(scene).empty()) << "circles touch open segments at any thickness";
    scene.add_chain_body(902, 0, {{0.0, 0.3}, {0.02, 0.3}, {0.01, 0.32}}, true);
    const std::vector<std::string> notices = scene_notices(scene);
    ASSERT_EQ(notices.size(), 1u);
    fmt::print("  {}\n", notices[0]);
    EXPECT_NE(notices[0].find("thick: at a thickness of 0"), std::string::npos);
    EXPECT_NE(notices[0].find("body 901"), std::string::npos);
    scene.thick = 1e-3;
    EXPECT_TRUE(scene_notices(scene).empty());
}

}  // namespace
}  // namespace crackle
