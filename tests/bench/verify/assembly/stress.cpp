// SPDX-License-Identifier: GPL-3.0-or-later
// Stability under stress: long runs, extreme ratios, impacts, stacks, degenerate shapes. In every case the energy must
// stay bounded, or an error must state place and reason.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/time_step.hpp"
#include "tests/bench/verify/assembly/stress.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/bonded_bodies.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<ClaimRow> account_of(std::int64_t steps) {
    Rows rows;
    for (const StressScene& scene : stress_scenes()) {
        World world = scene.build();
        const Endured endured = endure(world, steps);
        rows.exactly(scene.name + (endured.error.empty() ? ": steps done" : ": " + endured.error),
                     static_cast<double>(endured.steps), static_cast<double>(steps));
        rows.absolute(scene.name + ": closing error over the energy", endured.closing_error, 0.0, open_account,
                      "loose_step_share");
    }
    return rows.take();
}

std::vector<ClaimRow> loose_bodies_in_a_box_keep_their_account() { return account_of(4000); }
std::vector<ClaimRow> loose_bodies_in_a_box_keep_their_account_for_long() { return account_of(50000); }

std::vector<ClaimRow> given_steps_up_to_the_bound_are_bounded_or_named() {
    Rows rows;
    for (const StressScene& scene : stress_scenes()) {
        for (const double share : {0.3, 0.9}) {
            World world = scene.build();
            set_time_step(world, share * world.stepping.step_bound);
            Endured endured;
            try {
                endured = endure(world, 3000);
            } catch (const InputError& error) {
                endured.error = error.what();
            }
            const std::string name = fmt::format("{}, {} of the bound", scene.name, share);
            if (share < 0.5) {  // the allowed error is open_account, scaled in proportion to the step
                rows.exactly(name + (endured.error.empty() ? ": steps done" : ": " + endured.error),
                             static_cast<double>(endured.steps), 3000.0);
                rows.at_most(name + ": closing error over the energy", endured.closing_error,
                             open_account * share / (0.9 * loose_step_share), "first order");
            } else if (endured.error.empty()) {  // check_health() accepts an error as large as the energy supplied
                rows.at_most(name + ": closing error over the energy", endured.closing_error, 1.0, "or named");
            } else {
                rows.exactly(name + ": " + endured.error,
                             endured.error.find("is above the stable bound") != std::string::npos ? 1.0 : 0.0, 1.0);
            }
        }
    }
    return rows.take();
}

std::vector<ClaimRow> bound_stays_near_the_exact_step() {
    Rows rows;
    for (const StressScene& scene : stress_scenes()) {
        World world = scene.build();
        if (world.points.size() < 10 || world.bodies.size() > 100) continue;  // few contacts, or many bodies
        const CriticalStep exact = critical_step(world, ClosedPoints::listed);
        const double share = stable_step_bound(world) / exact.root;
        rows.at_most(scene.name + ": bound over the exact step, listed points closed", share, 1.0 + 1e-9, "a bound");
        // If two equal bodies touch at a point, the bound counts the whole spring for each body, so it is 1/√2 of the
        // exact step; for a dashpot it is 1/2.
        rows.at_least(scene.name + ": the same, from below", share, 0.5, "of use");
    }
    return rows.take();
}

// ---- impacts

struct Impact {
    const char* name;
    bool polygon;  // whether the projectile is a polygon
    enum class Target { same, segment, wall } target;
};

/// 1: the projectile ends on its own side; 0: on the other side; -1: the run ended with an error.
int after_impact(const Impact& impact, double speed, std::string& words) {
    Scene scene;
    scene.materials = {rock(0.0)};
    scene.thick = 1e-3;
    scene.domain = {-1e3, 0.0, -1.0, 1.0, {false, impact.target == Impact::Target::wall, false, false}};
    const auto add = [&](int id, Vec2 c) {
        if (!impact.polygon) {
            scene.add_circle_body(id, 0, {c, 0.02, 0.0});
        } else {
            scene.add_chain_body(
                id, 0, {c + Vec2{-0.02, -0.02}, c + Vec2{0.02, -0.021}, c + Vec2{0.019, 0.02}, c + Vec2{-0.02, 0.019}},
                true);
        }
    };
    add(1, {-0.05, 0.003});
    scene.bodies[0].velocity = {speed, 0.0};
    const DofControl held{Drive::velocity, 0.0};
    if (impact.target == Impact::Target::same) {
        add(2, {0.0, 0.0});
        scene.controls.push_back({1, held, held, held, 0});
    } else if (impact.target == Impact::Target::segment) {
        scene.add_chain_body(2, 0, {{0.0, -0.5}, {0.0, 0.5}}, false);
        scene.controls.push_back({1, held, held, held, 0});
    }
    try {
        World world = build_world(std::move(scene));
        const BodyIndex b = body_of_id(world, 1);
        while (world.stepping.time < 0.3 / speed || world.stepping.time < 5e-3) {
            step(world);
            if (std::abs(world.bodies.state[b].x) > 0.2) break;
        }
        check_health(world);
        return world.bodies.state[b].x < 0.0 ? 1 : 0;
    } catch (const UnstableRun& error) {
        words = error.what();
        return -1;
    }
}

std::vector<ClaimRow> impacts_rebound_or_are_named() {
    Rows rows;
    using Target = Impact::Target;
    // Speed in m/s at which a body must rebound, since its penetration v sqrt(m/k) is only a tenth of its size.
    constexpr double slow_impact = 1.0;
    for (const Impact& impact :
         {Impact{"disc on a disc", false, Target::same}, Impact{"disc on a segment", false, Target::segment},
          Impact{"disc on a wall", false, Target::wall}, Impact{"square on a square", true, Target::same},
          Impact{"square on a segment", true, Target::segment}, Impact{"square on a wall", true, Target::wall}}) {
        for (const double speed : {1.0, 10.0, 30.0, 60.0, 100.0, 300.0, 1e3, 1e4, 1e6}) {
            std::string words;
            const int outcome = after_impact(impact, speed, words);
            rows.exactly(fmt::format("{} at {:g} m/s: {}", impact.name, speed,
                                     outcome == 1   ? "rebounds"
                                     : outcome == 0 ? "gets through"
                                                    : words),
                         outcome == 1 || (outcome != 0 && speed > slow_impact) ? 1.0 : 0.0, 1.0);
        }
    }
    return rows.take();
}

// ---- rest

struct Rest {
    double sunk = 0.0;   // m, largest displacement of any body
    double creep = 0.0;  // m, largest displacement in the second half of the run
    double speed = 0.0;  // m/s, largest speed at the end
    std::string error;
};

Rest stand(Scene scene, double time) {
    scene.gravity = {0.0, -9.81};
    World world = build_world(std::move(scene));
    const auto positions = [&] {
        std::vector<Vec2> all;
        all.reserve(world.bodies.size());
        for (const BodyState& body : world.bodies.state) all.push_back({body.x, body.y});
        return all;
    };
    const auto way = [&](const std::vector<Vec2>& from) {
        double most = 0.0;
        for (std::size_t b = 0; b < from.size(); ++b)
            most = std::max(most, norm(Vec2{world.bodies.state[b].x, world.bodies.state[b].y} - from[b]));
        return most;
    };
    Rest result;
    const std::vector<Vec2> start = positions();
    const auto half = static_cast<std::int64_t>(0.5 * time / world.stepping.time_step);
    Endured endured = endure(world, half);
    const std::vector<Vec2> middle = positions();
    if (endured.error.empty()) endured = endure(world, half);
    result.error = endured.error;
    result.creep = way(middle);
    result.sunk = way(start);
    for (const BodyState& body : world.bodies.state)
        result.speed = std::max(result.speed, std::hypot(body.vx, body.vy));
    return result;
}

Scene floor_scene() {
    Scene scene;
    scene.materials = {rock()};
    scene.materials[0].damping_ratio = 0.3;
    scene.thick = 1e-3;
    scene.domain = {-1.0, 1.0, 0.0, 2.0, {true, true, true, false}};
    return scene;
}

void add_brick(Scene& scene, int id, Vec2 low, double width, double height) {
    scene.add_chain_body(id, 0, {low, low + Vec2{width, 0.0}, low + Vec2{width, height}, low + Vec2{0.0, height}},
                         true);
}

std::vector<ClaimRow> stacks_stay_at_rest() {
    Rows rows;
    const auto check = [&](const std::string& name, Scene scene, double tallest) {
        const auto count = static_cast<double>(scene.bodies.size());
        const double mass = mass_properties(scene, scene.bodies[0]).mass;
        const Rest rest = stand(std::move(scene), 0.6);
        // Every contact of a column is compressed by the weight above it, twice as much after a sudden start. The same
        // amount is allowed sideways.
        const double settled = 4.0 * 0.5 * tallest * tallest * mass * 9.81 / 1e7 + 4.0 * mass * 9.81 / 1e7;
        rows.at_most(name + (rest.error.empty() ? "" : ", " + rest.error) + ": displacement from the start, m",
                     rest.sunk, settled, "its own weight");
        // Allows for the motion left in a column's slowest mode after 0.3 s of damping, and for round-off.
        rows.at_most(name + ": creep in the second half, m", rest.creep, 1e-3 * settled, "no creep");
        rows.at_most(name + ": largest speed at the end, m/s", rest.speed, 1e-6, "at rest");
        rows.shown(name + ": bodies", count);
    };
    Scene column = floor_scene();
    for (int k = 0; k < 10; ++k) add_brick(column, k + 1, {0.0, 0.041 * k}, 0.04, 0.04);
    check("column of ten squares", std::move(column), 10);
    Scene wall = floor_scene();
    for (int row = 0, id = 0; row < 6; ++row) {
        for (int k = 0; k < 6 - row % 2; ++k)
            add_brick(wall, ++id, {0.081 * k + 0.0405 * (row % 2), 0.041 * row}, 0.08, 0.04);
    }
    check("wall of bricks", std::move(wall), 6);
    // Without rolling resistance, a heap of more rows rolls apart; three discs are stable from μ = tan 15°.
    Scene heap = floor_scene();
    for (int k = 0; k < 2; ++k) heap.add_circle_body(k + 1, 0, {{0.04 * k, 0.02}, 0.02, 0.0});
    heap.add_circle_body(3, 0, {{0.02, 0.02 + 0.02 * std::numbers::sqrt3}, 0.02, 0.0});
    check("three discs", std::move(heap), 2);
    return rows.take();
}

// ---- degenerate shapes

std::string refusal(const std::vector<Vec2>& outline, bool closed) {
    Scene scene = floor_scene();
    scene.add_chain_body(7, 0, outline, closed);
    try {
        build_world(std::move(scene));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::vector<ClaimRow> degenerate_shapes_are_refused_or_handled() {
    Rows rows;
    const auto refused = [&](const char* name, const std::vector<Vec2>& outline, bool closed) {
        const std::string words = refusal(outline, closed);
        rows.exactly(fmt::format("{}: {}", name, words.empty() ? "accepted" : words),
                     words.starts_with("body 7: ") ? 1.0 : 0.0, 1.0);
    };
    refused("edge of no length", {{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.1}, {0.1, 0.2}}, true);
    refused("last corner on the first", {{0.1, 0.1}, {0.2, 0.1}, {0.1, 0.2}, {0.1, 0.1}}, true);
    refused("segment of no length", {{0.1, 0.1}, {0.1, 0.1}}, false);
    refused("no area", {{0.1, 0.1}, {0.2, 0.1}, {0.3, 0.1}}, true);
    refused("edge there and back", {{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.2, 0.2}, {0.1, 0.2}}, true);
    refused("crossing edges", {{0.1, 0.1}, {0.2, 0.2}, {0.2, 0.1}, {0.1, 0.2}}, true);
    refused("not a number", {{0.1, 0.1}, {0.2, std::nan("")}, {0.2, 0.2}}, true);

    const auto handled = [&](const std::string& name, Scene scene) {
        World world = build_world(std::move(scene));
        const Momentum start = momentum_of(world);
        const Endured endured = endure(world, 4000);
        rows.exactly(name + (endured.error.empty() ? ": steps done" : ": " + endured.error),
                     static_cast<double>(endured.steps), 4000.0);
        rows.absolute(name + ": closing error over the energy", endured.closing_error, 0.0, open_account,
                      "loose_step_share");
        const Momentum now = momentum_of(world);
        // Relative to the current momenta, since nothing may move at the start.
        rows.absolute(name + ": momentum over that of the moving bodies",
                      std::hypot(now.x - start.x, now.y - start.y) / (now.scale + 1e-12), 0.0, 1e-10, "rounding");
    };
    const auto open_scene = [] {
        Scene scene = floor_scene();
        scene.domain.wall_present = {false, false, false, false};
        return scene;
    };
    for (const SegmentLaw law : {SegmentLaw::rounded, SegmentLaw::demseg}) {
        const std::string by = law == SegmentLaw::rounded ? "" : " (guide's law)";
        Scene corners = open_scene();
        corners.segment_law = law;
        add_brick(corners, 1, {0.0, 0.0}, 0.04, 0.04);
        add_brick(corners, 2, {0.04, 0.04}, 0.04, 0.04);
        handled("corner exactly on corner" + by, std::move(corners));
        Scene four = open_scene();
        four.segment_law = law;
        int id = 0;
        for (const double y : {0.0, 0.04})
            for (const double x : {0.0, 0.04}) add_brick(four, ++id, {x, y}, 0.04, 0.04);
        handled("four corners in one place" + by, std::move(four));
        Scene faces = open_scene();
        faces.segment_law = law;
        add_brick(faces, 1, {0.0, 0.0}, 0.04, 0.04);
        add_brick(faces, 2, {0.01, 0.041}, 0.04, 0.04);  // gap equal to the thickness
        faces.bodies[1].velocity = {0.0, -0.1};
        handled("parallel faces" + by, std::move(faces));
    }
    Scene same = open_scene();
    same.add_circle_body(1, 0, {{0.0, 0.0}, 0.02, 0.0});
    same.add_circle_body(2, 0, {{0.0, 0.0}, 0.02, 0.0});
    handled("discs of one centre", std::move(same));
    Scene twins = open_scene();
    add_brick(twins, 1, {0.0, 0.0}, 0.04, 0.04);
    add_brick(twins, 2, {0.0, 0.0}, 0.04, 0.04);
    handled("the same square twice", std::move(twins));
    return rows.take();
}

// ---- turning

std::vector<ClaimRow> bonded_specimens_turn_round_unharmed() {
    Rows rows;
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        World world = free_specimen(kind, 27.0, 0.5);
        const double spin = 4.0;  // rad/s; the centripetal stress ρω²R²/2 is about 600 N/m, and bonds withstand 20 000
        double mass = 0.0, x = 0.0, y = 0.0;
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            mass += world.bodies.inertia[b].mass;
            x += world.bodies.inertia[b].mass * world.bodies.state[b].x;
            y += world.bodies.inertia[b].mass * world.bodies.state[b].y;
        }
        for (BodyState& body : world.bodies.state) {
            body.vx = -spin * (body.y - y / mass);
            body.vy = spin * (body.x - x / mass);
            body.omega = spin;
        }
        const Momentum start = momentum_of(world);
        const Array<BodyState> before = world.bodies.state;
        const auto steps = static_cast<std::int64_t>(2.0 * pi / spin / world.stepping.time_step);
        const Endured endured = endure(world, steps, 500);
        const std::string name = name_of(kind);
        rows.exactly(name + (endured.error.empty() ? ": steps done" : ": " + endured.error),
                     static_cast<double>(endured.steps), static_cast<double>(steps));
        rows.exactly(name + ": bonds broken", static_cast<double>(world.bonds.broken), 0.0);
        rows.absolute(name + ": closing error over the energy", endured.closing_error, 0.0, 1e-3, "(ω dt)²");
        const double turn = spin * world.stepping.time;
        double off = 0.0, farthest = 0.0;
        for (std::size_t b = 0; b < before.size(); ++b) {
            const Vec2 arm{before[b].x - x / mass, before[b].y - y / mass};
            const Vec2 expected = (1.0 / mass) * Vec2{x, y} + Vec2{std::cos(turn) * arm.x - std::sin(turn) * arm.y,
                                                                   std::sin(turn) * arm.x + std::cos(turn) * arm.y};
            farthest = std::max(farthest, norm(arm));
            off = std::max(off, norm(Vec2{world.bodies.state[b].x, world.bodies.state[b].y} - expected));
        }
        // When released, the specimen stretches by up to twice its static strain, and its moment of inertia grows by
        // twice this strain, so that the rotation lags.
        const double strain = 2500.0 * spin * spin * farthest * farthest / 2.0 / 1e7;
        rows.at_most(name + ": largest distance of a body from its place after the rotation, m", off,
                     (2.0 + 4.0 * pi) * strain * farthest, "stretched by its spin");
        rows.absolute(name + ": momenta", momentum_error(start, momentum_of(world)), 0.0, 1e-10, "rounding");
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> stress_claims() {
    constexpr const char* group = "Stability under stress";
    return {
        {.name = "loose_bodies_in_a_box_keep_their_account",
         .group = group,
         .statement = "discs and polygons thrown into a box have a closing error of at most 2 % after 4000 steps at "
                      "0.9 of the derived step. Stiffness and mass ratios go up to 1e6, thicknesses from 1e-4 to 0.5 "
                      "of the size; there are needles, and thousands of bodies",
         .check = loose_bodies_in_a_box_keep_their_account},
        {.name = "loose_bodies_in_a_box_keep_their_account_for_long",
         .group = group,
         .statement = "as above for 50 000 steps; crackle-bench stress runs any number of steps",
         .check = loose_bodies_in_a_box_keep_their_account_for_long,
         .slow = true},
        {.name = "given_steps_up_to_the_bound_are_bounded_or_named",
         .group = group,
         .statement = "at 0.3 of the bound, the energy balance of the same scenes closes to first order in the step. "
                      "At 0.9 it closes too, or the run ends with an error: it states that new contacts lowered the "
                      "bound below the step, and where",
         .check = given_steps_up_to_the_bound_are_bounded_or_named},
        {.name = "bound_stays_near_the_exact_step_at_extreme_ratios",
         .group = group,
         .statement = "the guaranteed bound is more than half the exact step even if stiffnesses and masses differ by "
                      "a factor of a million",
         .check = bound_stays_near_the_exact_step},
        {.name = "impacts_rebound_or_are_named",
         .group = group,
         .statement =
             "at speeds from 1 m/s to 1e6 m/s, no body passes through another, a segment or a wall without an error",
         .check = impacts_rebound_or_are_named,
         .note = "Pairs of circles are not checked, because packing overlaps them deeply."},
        {.name = "stacks_stay_at_rest",
         .group = group,
         .statement = "a column, a wall and a heap settle under their own weight and do not creep",
         .check = stacks_stay_at_rest},
        {.name = "degenerate_shapes_are_refused_or_handled",
         .group = group,
         .statement = "shapes without length or area are refused with their names; coinciding corners, faces and "
                      "centres create neither energy nor momentum",
         .check = degenerate_shapes_are_refused_or_handled},
        {.name = "bonded_specimens_turn_round_unharmed",
         .group = group,
         .statement = "after a free bonded specimen has rotated by 360 degrees, no bond is broken and momenta are kept "
                      "to rounding. Every body is back in its place except for the stretch by the spin",
         .check = bonded_specimens_turn_round_unharmed},
    };
}

}  // namespace crackle::verification
