// SPDX-License-Identifier: GPL-3.0-or-later
// Discs on one spring and dashpot: restitution, bounces under gravity, two discs stacked between walls.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"

namespace crackle::verification {
namespace one_body_scenes {
namespace {

constexpr double radius = 0.02, density = 2500.0;
constexpr double mass = density * std::numbers::pi * radius * radius;

Scene above_floor(double stiffness, double h, double y) {
    Scene scene;
    Material material;
    material.density = density;
    material.normal_stiffness = stiffness;
    material.shear_stiffness = 0.25 * stiffness;
    material.damping_ratio = h;
    scene.materials = {material};
    scene.domain = {-10.0, 10.0, 0.0, 10.0, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, y}, radius, 0.0});
    return scene;
}

double dashpot_restitution(double h) { return std::exp(-std::numbers::pi * h / std::sqrt(1.0 - h * h)); }
double contact_time(double stiffness, double h) {
    return std::numbers::pi / (std::sqrt(stiffness / mass) * std::sqrt(1.0 - h * h));
}

struct Rebound {
    double restitution, contact_time;
};

/// @param phase fraction of a step that remains when the contact begins, 0 to 1
Rebound rebound(double h, double speed, double steps_in_contact, double phase) {
    constexpr double stiffness = 1e7;
    const double dt = contact_time(stiffness, h) / steps_in_contact;
    Scene scene = above_floor(stiffness, h, radius + (2.0 + phase) * speed * dt);
    scene.bodies[0].velocity = {0.0, -speed};
    scene.time_step = dt;
    World world = build_world(std::move(scene));
    const double begin = (2.0 + phase) * dt;
    double before = world.bodies.state[0].y;
    const BodyState& disc = world.bodies.state[0];
    while (disc.vy <= 0.0 || disc.y < radius) {
        before = disc.y;
        step(world);
    }
    const double end = world.stepping.time - dt * (disc.y - radius) / (disc.y - before);
    return {disc.vy / speed, end - begin};
}

constexpr int phases = 8;

/// Largest error over several phases of the step at which the contact begins.
struct ReboundErrors {
    double restitution = 0.0, contact_time = 0.0;
    double worst_restitution = 0.0;
    Rebound mean{0.0, 0.0};
};
ReboundErrors rebound_errors(double h, double steps_in_contact, double speed = 0.01) {
    ReboundErrors errors;
    for (int k = 0; k < phases; ++k) {
        const Rebound got = rebound(h, speed, steps_in_contact, (k + 0.5) / phases);
        const double error = std::abs(got.restitution - dashpot_restitution(h));
        if (error >= errors.restitution) errors.restitution = error, errors.worst_restitution = got.restitution;
        errors.contact_time = std::max(errors.contact_time, std::abs(got.contact_time / contact_time(1e7, h) - 1.0));
        errors.mean.restitution += got.restitution / phases;
        errors.mean.contact_time += got.contact_time / phases;
    }
    return errors;
}

/// Error due to the lagged dashpot, to first order in the step. Using c(v - ½a dt) instead of cv reduces the
/// oscillator's mass by ½c dt: ln e changes by -π²h²/(2n w⁴) for n steps per contact. The first kick may be up to a
/// step late, which adds 2hπ/(n w).
double lag_estimate(double h, double steps_in_contact) {
    const double w2 = 1.0 - h * h, pi = std::numbers::pi;
    const double change = (0.5 * pi * pi * h * h / (w2 * w2) + 2.0 * h * pi / std::sqrt(w2)) / steps_in_contact;
    return dashpot_restitution(h) * change;
}

std::vector<ClaimRow> restitution_with_a_lagged_dashpot() {
    Rows rows;
    for (const double h : {0.05, 0.215}) {
        const ReboundErrors coarse = rebound_errors(h, 50.0), fine = rebound_errors(h, 400.0);
        rows.absolute(fmt::format("e at h {}, t_c/50, worst of {} phases", h, phases), coarse.worst_restitution,
                      dashpot_restitution(h), 1e-2, "reference");
        rows.converging({coarse.restitution, fine.restitution, 8.0, 1.0});
    }
    for (const double h : {0.5, 0.9}) {
        const double n = h < 0.6 ? 400.0 : 3200.0;
        const ReboundErrors coarse = rebound_errors(h, n), fine = rebound_errors(h, 4.0 * n);
        rows.absolute(fmt::format("e at h {}, t_c/{}, worst of {} phases", h, n, phases), coarse.worst_restitution,
                      dashpot_restitution(h), lag_estimate(h, n), "first order in dt");
        rows.converging({coarse.restitution, fine.restitution, 4.0, 1.0});
    }
    for (const double h : {0.05, 0.215, 0.5}) {
        const ReboundErrors coarse = rebound_errors(h, 400.0), fine = rebound_errors(h, 3200.0);
        // ω changes by half the relative change of the mass, ½hω₀dt, and both ends of the contact are found to within a
        // step.
        rows.relative(fmt::format("contact time at h {}, t_c/400, s", h), coarse.mean.contact_time,
                      contact_time(1e7, h), 3.0 / 400.0, "a step at each end");
        rows.converging({coarse.contact_time, fine.contact_time, 8.0, 1.0});
    }
    const double slow = rebound(0.215, 0.01, 800.0, 0.5).restitution;
    rows.relative("e at 100 times the speed against e", rebound(0.215, 1.0, 800.0, 0.5).restitution, slow, 1e-9,
                  "rounding");
    return rows.take();
}

std::vector<ClaimRow> restitution_with_a_centred_dashpot() {
    Rows rows;
    for (const double h : {0.05, 0.215, 0.5, 0.9}) rows.unoffered(fmt::format("e at h {}", h), dashpot_restitution(h));
    return rows.take();
}

std::vector<ClaimRow> restitution_with_a_clamped_dashpot() {
    Rows rows;
    for (const double h : {0.05, 0.215, 0.5, 0.9}) {
        const double w = std::sqrt(1.0 - h * h), pi = std::numbers::pi;
        const double angle = h < std::numbers::sqrt2 / 2.0 ? pi - std::atan(2.0 * h * w / (w * w - h * h))
                                                           : std::atan(2.0 * h * w / (h * h - w * w));
        rows.unoffered(fmt::format("e at h {}", h), std::exp(-h / w * angle));
    }
    return rows.take();
}

// ---- a disc dropped on a floor; gravity also acts during contact

/// Height of the lowest point above the floor, m, and its rate, m/s.
struct Fall {
    double height, speed;
};

/// Piecewise analytic path: parabolas in flight, and a damped oscillation about the sag mg/k in contact.
class AnalyticBounce {
  public:
    AnalyticBounce(double stiffness, double h, double drop, double gravity)
        : omega_(std::sqrt(stiffness / mass)), h_(h), gravity_(gravity), state_{drop, 0.0} {}

    /// Continues from the last position. @param end time, s
    Fall at(double end) {
        while (true) {
            const double leave = contact_ ? contact_end() : fall_end();
            if (time_ + leave > end) return contact_ ? in_contact(end - time_) : in_flight(end - time_);
            state_ = contact_ ? in_contact(leave) : in_flight(leave);
            state_.height = 0.0;
            time_ += leave;
            contact_ = !contact_;
        }
    }

  private:
    Fall in_flight(double t) const {
        return {state_.height + state_.speed * t - 0.5 * gravity_ * t * t, state_.speed - gravity_ * t};
    }
    double fall_end() const {
        return (state_.speed + std::sqrt(state_.speed * state_.speed + 2.0 * gravity_ * state_.height)) / gravity_;
    }
    Fall in_contact(double t) const {
        const double w = omega_ * std::sqrt(1.0 - h_ * h_), decay = h_ * omega_, sag = gravity_ / (omega_ * omega_);
        // Coefficients of the height above the position at rest.
        const double a = sag, b = (state_.speed + decay * a) / w;
        const double c = std::cos(w * t), s = std::sin(w * t), e = std::exp(-decay * t);
        return {e * (a * c + b * s) - sag, e * ((b * w - decay * a) * c - (a * w + decay * b) * s)};
    }
    /// First return to height 0, by bisection after the lowest point; infinite if the disc comes to rest.
    double contact_end() const {
        const double half = std::numbers::pi / (omega_ * std::sqrt(1.0 - h_ * h_));
        double high = half;
        const int parts = 64;
        for (int k = 1; k <= 3 * parts; ++k) {
            high = half * k / parts;
            if (in_contact(high).height > 0.0) break;
            if (k == 3 * parts) return std::numeric_limits<double>::infinity();
        }
        double low = high - half / parts;
        for (int k = 0; k < 80; ++k) (in_contact(0.5 * (low + high)).height > 0.0 ? high : low) = 0.5 * (low + high);
        return high;
    }

    double omega_, h_, gravity_;
    Fall state_;
    double time_ = 0.0;
    bool contact_ = false;
};

constexpr double drop = 0.005, soft = 1e5, gravity = 9.81;

/// Largest distance from the analytic path relative to the drop, over `starts` initial heights that differ by fractions
/// of a step's fall.
double bounce_error(double h, double steps_in_contact, double duration, int starts) {
    double worst = 0.0;
    for (int k = 0; k < starts; ++k) {
        const double dt = contact_time(soft, h) / steps_in_contact;
        const double start = drop - std::sqrt(2.0 * gravity * drop) * dt * (k + 0.5) / starts;
        Scene scene = above_floor(soft, h, radius + start);
        scene.gravity = {0.0, -gravity};
        scene.time_step = dt;
        World world = build_world(std::move(scene));
        AnalyticBounce path(soft, h, start, gravity);
        for (int n = 0; world.stepping.time < duration; ++n) {
            step(world);
            if (n % 16 == 0)
                worst =
                    std::max(worst, std::abs(world.bodies.state[0].y - radius - path.at(world.stepping.time).height));
        }
    }
    return worst / drop;
}

std::vector<ClaimRow> free_fall_bounce_and_rest() {
    Rows rows;
    // Without damping, a contact that begins or ends within a step causes an error of (ω dt)² per bounce.
    const double undamped = bounce_error(0.0, 500.0, 0.35, 4), undamped_fine = bounce_error(0.0, 2000.0, 0.35, 4);
    rows.absolute("no dashpot: distance from the path over the drop, 4 bounces, t_c/2000", undamped_fine, 0.0, 1e-4,
                  "reference");
    rows.converging({undamped, undamped_fine, 4.0, 2.0});
    const double damped = bounce_error(0.1, 2500.0, 0.35, 4), damped_fine = bounce_error(0.1, 20000.0, 0.35, 2);
    rows.absolute("h 0.1: distance from the path over the drop, 4 bounces, t_c/20000", damped_fine, 0.0, 1e-4,
                  "reference");
    rows.converging({damped, damped_fine, 8.0, 1.0});
    Scene scene = above_floor(soft, 0.3, radius + drop);
    scene.gravity = {0.0, -gravity};
    World world = build_world(std::move(scene));
    while (world.stepping.time < 1.5) step(world);
    rows.relative("h 0.3: sag at rest, m", radius - world.bodies.state[0].y, mass * gravity / soft, 1e-9, "rounding");
    return rows.take();
}

// ---- two discs stacked between floor and ceiling

struct Stack {
    World world;
    BodyIndex low, high;
};

/// Two discs compressed by `squeeze` (m) in total, under gravity. @param apart initial displacement of both from
/// equilibrium, m
Stack stacked(double h, double squeeze, Vec2 apart, double time_step) {
    Scene scene = above_floor(soft, h, 0.0);
    const double ceiling = 4.0 * radius - squeeze;
    scene.domain = {-10.0, 10.0, 0.0, ceiling, {false, false, true, true}};
    scene.gravity = {0.0, -gravity};
    // The overlap with the floor is squeeze/3 plus the sag w of one weight; each lower spring carries one more weight.
    const double third = squeeze / 3.0, sag = mass * gravity / soft;
    scene.circles[0].centre.y = radius - (third + sag) + apart.x;
    scene.add_circle_body(2, 0, {{0.0, ceiling - radius + (third - sag) + apart.y}, radius, 0.0});
    scene.time_step = time_step;
    World world = build_world(std::move(scene));
    const BodyIndex low = body_of_id(world, 1), high = body_of_id(world, 2);
    return {std::move(world), low, high};
}

/// Largest deviation from the two normal modes relative to the initial displacement, during 8 periods of the slower
/// mode.
double stack_error(double share) {
    const double omega = std::sqrt(soft / mass), squeeze = 3e-3;
    const Vec2 apart{2e-4, -0.7e-4};
    Stack stack = stacked(0.0, squeeze, apart, share / omega);
    const double y1 = stack.world.bodies.state[stack.low].y - apart.x,
                 y2 = stack.world.bodies.state[stack.high].y - apart.y;
    double worst = 0.0;
    while (stack.world.stepping.time < 16.0 * std::numbers::pi / omega) {
        step(stack.world);
        const double slow = 0.5 * (apart.x + apart.y) * std::cos(omega * stack.world.stepping.time);
        const double fast = 0.5 * (apart.x - apart.y) * std::cos(std::sqrt(3.0) * omega * stack.world.stepping.time);
        worst = std::max({worst, std::abs(stack.world.bodies.state[stack.low].y - y1 - slow - fast),
                          std::abs(stack.world.bodies.state[stack.high].y - y2 - slow + fast)});
    }
    return worst / norm(apart);
}

std::vector<ClaimRow> two_discs_stacked_between_walls() {
    Rows rows;
    const double squeeze = 3e-3, sag = mass * gravity / soft;
    Stack stack = stacked(0.3, squeeze, {3e-4, 1e-4}, 0.0);
    while (stack.world.stepping.time < 1.5) step(stack.world);
    const BodyState &low = stack.world.bodies.state[stack.low], &high = stack.world.bodies.state[stack.high];
    rows.relative("overlap with the floor, m", radius - low.y, squeeze / 3.0 + sag, 1e-6, "reference");
    rows.relative("overlap of the discs, m", 2.0 * radius - (high.y - low.y), squeeze / 3.0, 1e-6, "reference");
    rows.relative("overlap with the ceiling, m", high.y + radius - stack.world.settings.domain.y2, squeeze / 3.0 - sag,
                  1e-6, "reference");
    // Leapfrog's frequency is too high by (ω dt)²/24; during 8 periods this gives √3·3·16π/24 (ω dt)² = 11 (ω dt)² of
    // the amplitude.
    const double coarse = stack_error(1e-3), fine = stack_error(2.5e-4);
    rows.absolute("distance from both modes over the first one, 8 periods, ω₀dt 2.5e-4", fine, 0.0, 1e-6, "(ω dt)²/24");
    rows.converging({coarse, fine, 4.0, 2.0});
    return rows.take();
}

}  // namespace
}  // namespace one_body_scenes

std::vector<Claim> one_body_claims() {
    using namespace one_body_scenes;
    constexpr const char* group = "One and two bodies";
    return {
        {.name = "restitution_with_a_lagged_dashpot",
         .group = group,
         .statement = "e = exp(-πh/√(1-h²)) and contact time π/(ω₀√(1-h²)), whatever the speed; the dashpot may pull",
         .check = restitution_with_a_lagged_dashpot,
         .note =
             "The dashpot uses v(n-½), as in the guide, so the error is of first order. Above h 0.215 the tolerance is "
             "the estimated effect of this lag on e, π²h²/(2n(1-h²)²) + 2πh/(n√(1-h²)) with n steps per contact."},
        {.name = "restitution_with_a_centred_dashpot",
         .group = group,
         .statement = "restitution as with a lagged dashpot, to second order in dt",
         .check = restitution_with_a_centred_dashpot,
         .offered = false,
         .note = "The engine offers only the guide's lagged dashpot."},
        {.name = "restitution_with_a_clamped_dashpot",
         .group = group,
         .statement = "f_n ≥ 0, w = √(1-h²): h < 1/√2: e = exp(-(h/w)(π - atan(2hw/(w²-h²)))), above: "
                      "exp(-(h/w) atan(2hw/(h²-w²)))",
         .check = restitution_with_a_clamped_dashpot,
         .offered = false,
         .note = "The engine's dashpot may pull, as the guide's restitution formula assumes."},
        {.name = "free_fall_bounce_and_rest",
         .group = group,
         .statement = "parabolas in flight; in contact, a damped oscillator about the sag mg/k",
         .check = free_fall_bounce_and_rest},
        {.name = "two_discs_stacked_between_walls",
         .group = group,
         .statement =
             "equilibrium overlaps s/3 + mg/k, s/3, s/3 - mg/k with the total overlap s; modes √(k/m), √(3k/m)",
         .check = two_discs_stacked_between_walls},
    };
}

}  // namespace crackle::verification
