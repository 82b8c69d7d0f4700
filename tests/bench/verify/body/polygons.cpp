// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons: mass properties, free spin, and collisions corner to corner, corner to edge and edge to edge. Contact
// forces act at one point of both bodies and have the potential ½k_n δ², where δ is continuously differentiable outside
// a convex outline. Momentum and angular momentum are therefore conserved to round-off. Without friction and dashpots,
// energy is conserved to second order in the step, even if corners pass corners. Notched polygons and open chains are
// included.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::vector<Vec2> placed(const std::vector<Vec2>& outline, double turn, Vec2 shift) {
    std::vector<Vec2> result;
    result.reserve(outline.size());
    const double c = std::cos(turn), s = std::sin(turn);
    for (const Vec2 p : outline) result.push_back(Vec2{c * p.x - s * p.y, s * p.x + c * p.y} + shift);
    return result;
}

const std::vector<Vec2> square{{-0.02, -0.02}, {0.02, -0.02}, {0.02, 0.02}, {-0.02, 0.02}};
const std::vector<Vec2> kite{{-0.03, -0.01}, {0.01, -0.02}, {0.025, 0.0}, {0.005, 0.02}};

/// An L whose notch opens to the left and down.
const std::vector<Vec2> notched{{0.03, -0.05}, {0.03, 0.03}, {-0.05, 0.03}, {-0.05, 0.01}, {0.0, 0.01}, {0.0, -0.05}};

struct Collision {
    const char* name;
    std::vector<Vec2> left, right;
    Vec2 velocity;  // velocity of the left body, m/s
    double spin;    // spin of the right body, rad/s
    bool right_closed = true;
};

std::vector<Collision> collisions() {
    const double t = 1e-3, tip = 0.02 * std::numbers::sqrt2;
    return {
        {"corner to corner, slightly off",
         placed(square, 45.0 * degree, {-tip - 0.5 * t, 2e-4}),
         placed(square, 45.0 * degree, {tip + 0.5 * t, 0.0}),
         {0.1, 0.0},
         0.0},
        {"corner to edge",
         placed(square, 45.0 * degree, {-tip - 0.5 * t, 0.003}),
         placed(square, 0.0, {0.02 + 0.5 * t, 0.0}),
         {0.1, 0.02},
         0.3},
        {"edge to edge",
         placed(square, 0.0, {-0.02 - 0.5 * t, 0.004}),
         placed(square, 0.0, {0.02 + 0.5 * t, 0.0}),
         {0.1, 0.01},
         0.0},
        {"kites, skew, spinning",
         placed(kite, 20.0 * degree, {-0.0249, -0.013}),
         placed(kite, 190.0 * degree, {0.0245, 0.0}),
         {0.1, 0.05},
         4.0},
        {"a corner slides past a corner",
         placed(square, 45.0 * degree, {-tip - 0.95 * t, 0.02 + 0.4 * t}),
         placed(square, 0.0, {0.02, 0.0}),
         {0.1, -1.0},
         2.0},
        {"corner into the notch of an L", placed(square, 30.0 * degree, {-0.0285, -0.0185}), notched, {0.1, 0.1}, 0.4},
        {"corner against an open chain",
         placed(square, 40.0 * degree, {-0.0299, 0.004}),
         {{0.0, -0.03}, {0.0, 0.02}, {0.03, 0.03}},
         {0.1, 0.02},
         0.5,
         false},
    };
}

struct Outcome {
    double momentum_error = 0.0, energy_error = 0.0, closing_error = 0.0;
    double stored_at_start = 0.0, largest_stored = 0.0;  // energies relative to the initial kinetic energy
};

/// @param step_share step relative to the contact time of two squares, 1.4e-3 s
Outcome collide(const Collision& c, double step_share, double friction_angle, SegmentLaw law = SegmentLaw::rounded) {
    Scene scene;
    scene.materials = {rock(friction_angle)};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 1e-3;
    scene.segment_law = law;
    scene.add_chain_body(1, 0, c.left, true);
    scene.add_chain_body(2, 0, c.right, c.right_closed);
    scene.bodies[0].velocity = c.velocity;
    scene.bodies[1].spin = c.spin;
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    const double contact_time = std::numbers::pi * std::sqrt(0.5 * mass / 1e7);
    scene.time_step = step_share * contact_time;
    World world = build_world(std::move(scene));
    const Momentum start = momentum_of(world);
    compute_forces(world);
    const Ledger first = measure_ledger(world);
    const double energy = first.kinetic;
    Outcome outcome;
    outcome.stored_at_start = first.strain / energy;
    while (world.stepping.time < 12.0 * contact_time) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        outcome.energy_error =
            std::max(outcome.energy_error, std::abs(ledger.kinetic + ledger.strain - energy) / energy);
        outcome.closing_error = std::max(outcome.closing_error, std::abs(ledger.closing_error) / energy);
        outcome.largest_stored = std::max(outcome.largest_stored, ledger.strain / energy);
        advance(world);
        outcome.momentum_error = std::max(outcome.momentum_error, momentum_error(start, momentum_of(world)));
    }
    return outcome;
}

void check_touched(Rows& rows, const std::string& name, const Outcome& outcome) {
    rows.exactly(name + ": energy stored before, over the kinetic", outcome.stored_at_start, 0.0);
    rows.at_least(name + ": largest energy stored over the kinetic", outcome.largest_stored, 1e-3, "they meet");
}

std::vector<ClaimRow> polygons_colliding_keep_momentum_and_energy() {
    Rows rows;
    for (const Collision& c : collisions()) {
        const Outcome coarse = collide(c, 0.02, 0.0), fine = collide(c, 0.02 / 8.0, 0.0);
        check_touched(rows, c.name, fine);
        rows.absolute(fmt::format("{}: momenta", c.name), std::max(coarse.momentum_error, fine.momentum_error), 0.0,
                      1e-12, "reference");
        // During a contact, the energy under leapfrog oscillates by (ω dt)²/4 of the stored energy, (π/50)²/4 at
        // t_c/50. The same amount is added if a contact begins or ends within a step.
        rows.absolute(fmt::format("{}: energy over the kinetic, t_c/50", c.name), coarse.energy_error, 0.0, 5e-3,
                      "(ω dt)²");
        rows.converging({coarse.energy_error, fine.energy_error, 8.0, 2.0});
    }
    return rows.take();
}

std::vector<ClaimRow> polygons_colliding_with_friction_close_the_account() {
    Rows rows;
    for (const Collision& c : collisions()) {
        const Outcome coarse = collide(c, 0.02, 27.0), fine = collide(c, 0.02 / 8.0, 27.0);
        check_touched(rows, c.name, fine);
        rows.absolute(fmt::format("{}: momenta", c.name), std::max(coarse.momentum_error, fine.momentum_error), 0.0,
                      1e-12, "reference");
        rows.absolute(fmt::format("{}: closing error over the kinetic, t_c/50", c.name), coarse.closing_error, 0.0,
                      1e-2, "(ω dt)²");
        rows.converging({coarse.closing_error, fine.closing_error, 8.0, 1.0});
    }
    return rows.take();
}

std::vector<ClaimRow> polygons_colliding_under_the_guides_law_keep_momentum_and_close_the_account() {
    Rows rows;
    for (const Collision& c : collisions()) {
        double momenta = 0.0;
        for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
            for (const double friction_angle : {0.0, 27.0}) {
                const Outcome outcome = collide(c, 0.02 / 8.0, friction_angle, law);
                check_touched(rows, c.name, outcome);
                momenta = std::max(momenta, outcome.momentum_error);
            }
        }
        rows.absolute(fmt::format("{}: momenta, sum and mean, with and without friction", c.name), momenta, 0.0, 1e-12,
                      "reference");
        const Outcome coarse = collide(c, 0.02 / 4.0, 0.0, SegmentLaw::demseg),
                      fine = collide(c, 0.02 / 32.0, 0.0, SegmentLaw::demseg);
        // The error is that of the rounded law, (π/1600)²/4 of the stored energy; a jump of the overlap at a free end
        // adds to it.
        rows.absolute(fmt::format("{}: closing error over the kinetic, t_c/1600", c.name), fine.closing_error, 0.0,
                      1e-5, "(ω dt)²");
        rows.converging({coarse.closing_error, fine.closing_error, 8.0, 2.0});
    }
    return rows.take();
}

struct SlideOff {
    double taken = 0.0;          // energy removed by the law itself, relative to the largest strain energy
    double closing_error = 0.0;  // error of the energy balance, relative to the largest strain energy
    double height = 0.0;         // m, height of the block at the end
};

/// A block pressed onto the side of a held one slides along it and off its end, without friction or rotation.
SlideOff slide_off(SegmentLaw law, double time_step) {
    Scene scene;
    scene.materials = {rock(0.0)};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 1e-3;
    scene.segment_law = law;
    scene.time_step = time_step;
    scene.add_chain_body(1, 0, placed(square, 0.0, {0.02, 0.0}), true);
    scene.add_chain_body(2, 0, placed(square, 0.0, {-0.02 - 0.99e-3, 0.0377}), true);
    scene.bodies[1].velocity = {0.0, 0.5};
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({1, {Drive::force, 200.0}, {Drive::free, 0.0}, held, 0});
    World world = build_world(std::move(scene));
    SlideOff result;
    double strain = 0.0;
    while (world.stepping.time < 6e-3) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        strain = std::max(strain, ledger.strain);
        result.closing_error = std::max(result.closing_error, std::abs(ledger.closing_error));
        result.taken = ledger.law_loss;
        advance(world);
    }
    result.height = world.bodies.state[body_of_id(world, 2)].y;
    result.taken /= strain;
    result.closing_error /= strain;
    return result;
}

std::vector<ClaimRow> free_end_under_the_guides_law_takes_energy_whatever_the_step() {
    // Near the end of the side, the overlap decreases as in rule (iii) and the block sinks in; beyond the end, rule
    // (ii) begins with a jump. Such a force has no potential. It removes energy here, and adds as much on the way back.
    // The work of the springs is computed as it occurs, so this loss is separate from the error of the step, which
    // decreases with the step. Under the rounded law there is only that error.
    Rows rows;
    std::vector<SlideOff> guide, rounded;
    for (const double time_step : {4e-6, 1e-6, 0.25e-6}) {
        guide.push_back(slide_off(SegmentLaw::demseg, time_step));
        rounded.push_back(slide_off(SegmentLaw::rounded, time_step));
        rows.shown(fmt::format("guide's law, step {:g} s: energy loss over the largest strain energy", time_step),
                   guide.back().taken);
    }
    for (const SlideOff& run : {guide[2], rounded[2]})
        rows.at_least("the block has left the side: height at the end, m", run.height, 0.04 + 2e-4, "geometry");
    rows.at_least("guide's law: energy loss over the largest strain energy", std::abs(guide[2].taken), 0.1,
                  "a jump of δ");
    rows.relative("guide's law: the same at four times the step", guide[1].taken, guide[2].taken, 0.02,
                  "where the step meets the jump");
    rows.at_most("guide's law: closing error over that at 16 times the step",
                 guide[2].closing_error / guide[0].closing_error, 0.5, "shrinks");
    rows.exactly("rounded law: energy loss", rounded[2].taken, 0.0);
    rows.absolute("rounded law: closing error over the largest strain energy", rounded[2].closing_error, 0.0, 1e-4,
                  "(ω dt)²");
    rows.converging({rounded[0].closing_error, rounded[2].closing_error, 16.0, 2.0});
    return rows.take();
}

std::vector<ClaimRow> polygon_spins_freely_about_its_centroid() {
    Rows rows;
    Scene scene;
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.thick = 1e-3;
    scene.add_chain_body(1, 0, kite, true);
    scene.bodies[0].velocity = {0.3, -0.2};
    scene.bodies[0].spin = 7.0;
    scene.time_step = 1e-5;
    World world = build_world(std::move(scene));
    const Vec2 start{world.bodies.state[0].x, world.bodies.state[0].y};
    const int steps = 200000;
    for (int n = 0; n < steps; ++n) step(world);
    const double time = 1e-5 * steps, turn = 7.0 * time;
    // Round-off of 2e5 additions, each at most ½ epsilon of the sum.
    rows.absolute("turn, rad", world.bodies.state[0].angle - std::atan2(-0.01, 0.04), turn, 1e-9, "rounding");
    rows.absolute("length of the body frame",
                  std::hypot(world.bodies.state[0].shape[0], world.bodies.state[0].shape[1]), 1.0, 1e-15, "rounding");
    const std::vector<Vec2> corners = element_positions(world, 0);
    double worst = 0.0;
    for (std::size_t k = 0; k < kite.size(); ++k) {
        const Vec2 offset = kite[k] - start;
        const Vec2 expected = start + time * Vec2{0.3, -0.2} +
                              Vec2{std::cos(turn) * offset.x - std::sin(turn) * offset.y,
                                   std::sin(turn) * offset.x + std::cos(turn) * offset.y};
        worst = std::max(worst, norm(corners[k] - expected));
    }
    rows.absolute("corners after 2.2 turns, m", worst, 0.0, 1e-10, "rounding");
    rows.exactly("spin, rad/s", world.bodies.state[0].omega, 7.0);
    return rows.take();
}

std::vector<ClaimRow> mass_centroid_and_moment_are_exact() {
    Rows rows;
    Scene scene;
    scene.materials = {rock()};
    scene.thick = 0.01;
    const double rho = 2500.0;
    const auto check = [&](const std::string& name, double mass, Vec2 centroid, double moment) {
        const MassProperties p = mass_properties(scene, scene.bodies.back());
        rows.relative(name + ": mass, kg", p.mass, mass, 1e-12, "reference");
        rows.absolute(name + ": centroid, over its distance", norm(p.centroid - centroid) / (1.0 + norm(centroid)), 0.0,
                      1e-12, "reference");
        rows.relative(name + ": moment, kg m2", p.moment, moment, 1e-12, "reference");
    };
    const Vec2 far{1024.0, -512.0};  // a power of two, so that the corners are exact there
    for (const Vec2 at : {Vec2{}, far}) {
        const std::string where = at.x > 0.0 ? ", 1100 m away" : "";
        scene.add_chain_body(1, 0, placed({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, 0.0, at), true);
        check("rectangle" + where, rho * 6.0, at + Vec2{1.5, 1.0}, rho * 6.0 * (9.0 + 4.0) / 12.0);
        scene.add_chain_body(1, 0, placed({{0, 0}, {3, 0}, {0, 4}}, 0.0, at), true);
        check("triangle" + where, rho * 6.0, at + Vec2{1.0, 4.0 / 3.0}, rho * 6.0 * (9.0 + 16.0 + 25.0) / 36.0);
        // An L made of a 1 by 3 and a 2 by 1 rectangle; centroid and moment by the parallel-axis theorem.
        scene.add_chain_body(1, 0, placed({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.0, at), true);
        const Vec2 c = 0.2 * (3.0 * Vec2{0.5, 1.5} + 2.0 * Vec2{2.0, 0.5});
        const Vec2 a = Vec2{0.5, 1.5} - c, b = Vec2{2.0, 0.5} - c;
        check("L" + where, rho * 5.0, at + c, rho * (3.0 * (10.0 / 12.0 + dot(a, a)) + 2.0 * (5.0 / 12.0 + dot(b, b))));
        scene.add_chain_body(1, 0, placed({{0, 0}, {3, 0}, {3, 4}}, 0.0, at), false);
        const Vec2 bend = (1.0 / 7.0) * (3.0 * Vec2{1.5, 0.0} + 4.0 * Vec2{3.0, 2.0});
        const Vec2 d = Vec2{1.5, 0.0} - bend, e = Vec2{3.0, 2.0} - bend;
        check("open chain" + where, rho * 7.0 * 0.02, at + bend,
              rho * 0.02 * (3.0 * (9.0 / 12.0 + dot(d, d)) + 4.0 * (16.0 / 12.0 + dot(e, e))));
    }
    std::vector<Vec2> hexagon;
    hexagon.reserve(6);
    for (int k = 0; k < 6; ++k) hexagon.push_back({std::cos(60.0 * degree * k), std::sin(60.0 * degree * k)});
    scene.add_chain_body(1, 0, hexagon, true);
    const double area = 1.5 * std::sqrt(3.0);
    check("hexagon", rho * area, {}, rho * area * 5.0 / 12.0);
    scene.add_circle_body(1, 0, {{-1.0, 0.0}, 1.0, 0.0});
    scene.circles.push_back({{1.0, 0.0}, 0.5, 0.0});
    scene.bodies.back().circle_count = 2;
    const double m1 = rho * std::numbers::pi, m2 = 0.25 * m1, x = (m2 - m1) / (m1 + m2);
    check("clump", m1 + m2, {x, 0.0}, 0.5 * m1 + m1 * (x + 1.0) * (x + 1.0) + 0.125 * m2 + m2 * (1.0 - x) * (1.0 - x));
    scene = Scene();
    scene.materials = {rock()};
    scene.domain.wall_present = {false, false, false, false};
    scene.add_chain_body(1, 0, {{0, 0}, {0, 4}, {3, 0}}, true);
    validate(scene);  // reverses the order of its corners
    check("triangle given clockwise", rho * 6.0, {1.0, 4.0 / 3.0}, rho * 6.0 * (9.0 + 16.0 + 25.0) / 36.0);
    return rows.take();
}

}  // namespace

std::vector<Claim> polygon_claims() {
    constexpr const char* group = "One and two bodies";
    return {
        {.name = "mass_centroid_and_moment_are_exact",
         .group = group,
         .statement = "Green's theorem for outlines, parallel axes for clumps and open chains",
         .check = mass_centroid_and_moment_are_exact},
        {.name = "polygon_spins_freely_about_its_centroid",
         .group = group,
         .statement = "uniform motion of the centroid, uniform spin about it",
         .check = polygon_spins_freely_about_its_centroid},
        {.name = "polygons_colliding_keep_momentum_and_energy",
         .group = group,
         .statement = "linear and angular momentum are kept to rounding; without friction, energy to second order in "
                      "dt, without a jump when a corner passes a corner",
         .check = polygons_colliding_keep_momentum_and_energy},
        {.name = "polygons_colliding_with_friction_close_the_account",
         .group = group,
         .statement = "momenta are kept to rounding. The sum of kinetic energy, stored energy and friction loss is "
                      "constant, to the order with which the start of a contact and its slip are resolved",
         .check = polygons_colliding_with_friction_close_the_account},
        {.name = "polygons_colliding_under_the_guides_law_keep_momentum_and_close_the_account",
         .group = group,
         .statement =
             "momenta are kept to rounding; if the work of the springs is counted, energy to second order in dt",
         .check = polygons_colliding_under_the_guides_law_keep_momentum_and_close_the_account},
        {.name = "free_end_under_the_guides_law_takes_energy_whatever_the_step",
         .group = group,
         .statement = "a block that slides off a free end loses an energy that does not depend on dt under the guide's "
                      "law, and none under the rounded law",
         .check = free_end_under_the_guides_law_takes_energy_whatever_the_step},
    };
}

}  // namespace crackle::verification
