// SPDX-License-Identifier: GPL-3.0-or-later
// Energy errors due to opening and closing contacts, under leapfrog and under the consistent integrator.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/measure/ledger.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace opening_scenes {
namespace {

constexpr double radius = 0.02, density = 2500.0, kn = 1e5, gravity = 9.81;
constexpr double mass = density * std::numbers::pi * radius * radius;

/// Error of the total energy since the start, J, which includes the potential of gravity.
double energy_now(World& world) {
    compute_forces(world);
    return measure_ledger(world).closing_error;
}

// ---- one disc

struct Bouncing {
    double last = 1.0, largest = 1.0;  // energies in flight relative to the first
    int bounces = 0;
};

/// Drops a disc on a floor. Ends early if the disc sinks too deep, which shows that its energy has grown.
Bouncing bounce(Integrator integrator, double step_share, double drop, int bounces) {
    Scene scene;
    scene.materials = {undamped_rock(kn, 0.0)};
    scene.domain = {-1e3, 1e3, 0.0, 1e3, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, radius + drop}, radius, 0.0});
    scene.gravity = {0.0, -gravity};
    scene.integrator = integrator;
    scene.allow_unstable = true;  // the energy grows without bound under leapfrog
    scene.time_step = step_share * 2.0 * std::sqrt(mass / kn);
    World world = build_world(std::move(scene));
    const double start = mass * gravity * drop;
    Bouncing result;
    bool below = false;
    while (result.bounces < bounces) {
        if (world.bodies.state[0].y < 0.5 * radius) {  // deeper than any bounce with correct energy
            result.largest = std::max(result.largest, 100.0);
            break;
        }
        const double error = energy_now(world);
        if (world.bodies.state[0].y <= radius) {
            below = true;
        } else if (below) {
            below = false;
            ++result.bounces;
            result.last = 1.0 + error / start;
            result.largest = std::max(result.largest, result.last);
            if (!(result.last > 1e-2 && result.last < 100.0)) break;
        }
        advance(world);
    }
    return result;
}

constexpr int starts = 48;
double drop_of(int k) { return 0.004 + 0.004 * (k + 0.5) / starts; }

/// E'/E of a bounce without gravity: measured, and by the formula for the given beginning and end of the contact.
std::pair<double, double> leapfrog_bounce(double step_share, double phase) {
    constexpr double speed = 0.1;
    const double dt = step_share * 2.0 * std::sqrt(mass / kn);
    Scene scene;
    scene.materials = {undamped_rock(kn, 0.0)};
    scene.domain = {-1e3, 1e3, 0.0, 1e3, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, radius + (1.0 + phase) * speed * dt}, radius, 0.0});
    scene.bodies[0].velocity = {0.0, -speed};
    scene.time_step = dt;
    World world = build_world(std::move(scene));
    const BodyState& disc = world.bodies.state[0];
    double first = 0.0, last = 0.0;  // overlaps, m
    while (disc.vy <= 0.0 || disc.y <= radius) {
        const double overlap = radius - disc.y;
        if (overlap > 0.0) {
            if (first == 0.0) first = overlap;
            last = overlap;
        }
        step(world);
    }
    const double begin = first / (speed * dt), end = last / (disc.vy * dt), kappa = 4.0 * step_share * step_share;
    const double formula = (1.0 - kappa * begin * (1.0 - begin)) / (1.0 - kappa * end * (1.0 - end));
    return {disc.vy * disc.vy / (speed * speed), formula};
}

std::vector<ClaimRow> bouncing_disc_keeps_its_energy() {
    Rows rows;
    for (const double share : {0.5, 0.9}) {
        double worst = 0.0;
        int done = 0;
        for (int k = 0; k < 4; ++k) {
            const Bouncing got = bounce(Integrator::consistent, share, drop_of(12 * k), 1000);
            done += got.bounces;
            worst = std::max(worst, std::abs(got.last - 1.0));
        }
        rows.exactly(fmt::format("consistent, {} of the limit: bounces, 4 starts", share), done, 4000);
        rows.absolute("largest change of the energy over it", worst, 0.0, 1e-9, "rounding");
    }
    // Leapfrog: E'/E = (1 - κs(1-s))/(1 - κs'(1-s')), κ = 4λ², where s and s' are the fractions of the first and last
    // step that are in contact. For uniformly distributed s, s(1-s) has the standard deviation 1/√180. The change per
    // bounce is then 0.42λ² if s and s' are independent, and at most 8λ²/√180 = 0.6λ². If the energy changes little,
    // the phases recur and the energy varies less.
    for (const double share : {0.1, 0.2}) {
        constexpr int bounces = 100;
        double squares = 0.0;
        for (int k = 0; k < starts; ++k) {
            const double change = std::log(bounce(Integrator::leapfrog, share, drop_of(k), bounces).last);
            squares += change * change / starts;
        }
        const double one = std::sqrt(squares / bounces) / (share * share);
        rows.at_most(
            fmt::format("leapfrog, {} of the limit: rms of ln(E'/E) over λ²√n, n = {} bounces", share, bounces), one,
            8.0 / std::sqrt(180.0) * (1.0 + 3.0 / std::sqrt(2.0 * starts)), "formula, 3σ");
    }
    // A single bounce without gravity.
    for (const double share : {0.1, 0.4, 0.7}) {
        double worst = 0.0, least = 1.0, most = 1.0;
        for (int k = 0; k < 16; ++k) {
            const auto [change, formula] = leapfrog_bounce(share, (k + 0.5) / 16);
            worst = std::max(worst, std::abs(change - formula));
            least = std::min(least, change);
            most = std::max(most, change);
        }
        rows.absolute(fmt::format("leapfrog, {} of the limit: E'/E per bounce against the formula, 16 starts", share),
                      worst, 0.0, 1e-9, "rounding");
        rows.shown("least E'/E", least);
        rows.shown("largest E'/E", most);
    }
    int away = 0;
    for (int k = 0; k < starts; ++k) away += bounce(Integrator::leapfrog, 0.8, drop_of(k), 1000).largest > 2.0 ? 1 : 0;
    rows.at_least(
        fmt::format("leapfrog, 0.8 of the limit: of {} starts, discs that double their energy within 1000 bounces",
                    starts),
        away, 0.5 * starts, "flies off");
    return rows.take();
}

// ---- many contacts at once

/// Largest |closing error| relative to the initial energy. @param steps number of steps
double largest_error(World& world, double energy, int steps) {
    double worst = 0.0;
    for (int n = 0; n < steps; ++n) {
        worst = std::max(worst, std::abs(energy_now(world)) / energy);
        if (!(worst < 100.0)) break;
        advance(world);
    }
    return worst;
}

/// Discs in a row with gaps between two walls, with random velocities along the row.
double chain_error(Integrator integrator, double step_share, std::uint64_t seed) {
    constexpr int count = 10;
    std::mt19937_64 generator(seed);
    Scene scene;
    scene.materials = {undamped_rock(kn, 0.0)};
    const double gap = 2e-3;
    double x = 0.0;
    for (int k = 0; k < count; ++k) {
        x += radius + gap * uniform_number(generator);
        scene.add_circle_body(k + 1, 0, {{x, 0.0}, radius, 0.0});
        scene.bodies.back().velocity.x = 0.4 * (uniform_number(generator) - 0.5);
        x += radius;
    }
    scene.domain = {0.0, x + gap * uniform_number(generator), -1.0, 1.0, {true, true, false, false}};
    scene.integrator = integrator;
    scene.allow_unstable = true;
    // The highest frequency with all contacts closed is ω = 2√(k/m) cos(π/(2(n+1))).
    scene.time_step = step_share * std::sqrt(mass / kn) / std::cos(0.5 * std::numbers::pi / (count + 1));
    World world = build_world(std::move(scene));
    double energy = 0.0;
    for (const BodyState& body : world.bodies.state) energy += 0.5 * mass * body.vx * body.vx;
    return largest_error(world, energy, 20000);
}

std::vector<ClaimRow> colliding_chain_keeps_its_energy_bounded() {
    Rows rows;
    for (const double share : {0.2, 0.8}) {
        double worst[2] = {};
        for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
            for (std::uint64_t seed = 1; seed <= 6; ++seed) {
                double& most = worst[integrator == Integrator::consistent ? 1 : 0];
                most = std::max(most, chain_error(integrator, share, seed));
            }
        }
        rows.at_most(fmt::format("consistent, {} of the limit: largest closing error, 20000 steps, 6 starts", share),
                     worst[1], share * share, "mean velocities, λ²");
        rows.shown("leapfrog", worst[0]);
    }
    return rows.take();
}

// ---- a polygon

/// A square with an initial spin in a box without gravity.
double square_error(Integrator integrator, double step_share, std::uint64_t seed) {
    constexpr double half = 0.02, room = 0.08;
    std::mt19937_64 generator(seed);
    Scene scene;
    constexpr double stiff = 1e7;
    scene.materials = {undamped_rock(kn, 0.0)};
    scene.materials[0].normal_stiffness = stiff;
    scene.add_chain_body(1, 0, {{-half, -half}, {half, -half}, {half, half}, {-half, half}}, true);
    scene.domain = {-room, room, -room, room, {true, true, true, true}};
    Body& body = scene.bodies.back();
    body.velocity = {0.3 * (uniform_number(generator) + 0.5), 0.3 * (uniform_number(generator) - 0.5)};
    body.spin = 10.0 * (uniform_number(generator) + 0.2);
    scene.integrator = integrator;
    scene.allow_unstable = true;
    const MassProperties own = mass_properties(scene, scene.bodies[0]);
    scene.time_step = step_share * std::sqrt(own.mass / stiff);  // two corners on a wall
    const double energy = 0.5 * own.mass * dot(body.velocity, body.velocity) + 0.5 * own.moment * body.spin * body.spin;
    World world = build_world(std::move(scene));
    double last = 0.0;
    for (int n = 0; n < static_cast<int>(10000.0 / step_share); ++n) {
        const double error = energy_now(world) / energy;
        bool free = true;
        for (const PointState point : world.points.state) free = free && (point.flags & point_touching) == 0;
        if (free) last = std::max(last, std::abs(error));
        if (!(last < 100.0)) break;
        advance(world);
    }
    return last;
}

std::vector<ClaimRow> spinning_square_in_a_box_keeps_its_energy() {
    Rows rows;
    for (const double share : {0.1, 0.4}) {
        double worst[2] = {};
        for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
            for (std::uint64_t seed = 1; seed <= 8; ++seed) {
                double& most = worst[integrator == Integrator::consistent ? 1 : 0];
                most = std::max(most, square_error(integrator, share, seed));
            }
        }
        // One bounce under leapfrog changes the energy by at most κs(1-s) = λ². The error of hundreds of bounces under
        // the consistent integrator must not exceed this.
        rows.at_most(fmt::format("{} of the limit, 8 throws: largest closing error in flight, consistent", share),
                     worst[1], share * share, "one leapfrog bounce");
        rows.shown("leapfrog", worst[0]);
    }
    return rows.take();
}

// ---- friction

struct Oblique {
    double normal, tangent, spin;  // errors relative to the normal speed
};

constexpr double down = 0.1, along = 0.3, angle = 15.0;  // m/s, degrees

Oblique oblique(Integrator integrator, double step_share, double phase) {
    const double mu = std::tan(angle * std::numbers::pi / 180.0), dt = step_share * 2.0 * std::sqrt(mass / kn);
    Scene scene;
    scene.materials = {undamped_rock(kn, angle)};
    scene.domain = {-1e3, 1e3, 0.0, 1e3, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, radius + (1.0 + phase) * down * dt}, radius, 0.0});
    scene.bodies[0].velocity = {along, -down};
    scene.integrator = integrator;
    scene.allow_unstable = true;
    scene.time_step = dt;
    World world = build_world(std::move(scene));
    const BodyState& disc = world.bodies.state[0];
    while (disc.vy <= 0.0 || disc.y <= radius) step(world);
    return {disc.vy / down - 1.0, (disc.vx - (along - 2.0 * mu * down)) / down,
            (radius * std::abs(disc.omega) - 4.0 * mu * down) / down};
}

std::vector<ClaimRow> oblique_sliding_rebound_has_the_closed_form() {
    Rows rows;
    for (const Integrator integrator : {Integrator::consistent, Integrator::leapfrog}) {
        for (const double share : {0.05, 0.4}) {
            Oblique worst{};
            for (int k = 0; k < 16; ++k) {
                const Oblique got = oblique(integrator, share, (k + 0.5) / 16);
                worst.normal = std::max(worst.normal, std::abs(got.normal));
                worst.tangent = std::max(worst.tangent, std::abs(got.tangent));
                worst.spin = std::max(worst.spin, std::abs(got.spin));
            }
            const std::string where = fmt::format("{}, {} of the limit: ", name_of(integrator), share);
            if (integrator == Integrator::leapfrog) {
                rows.shown(where + "error of the speed off the wall, over v_n", worst.normal);
                continue;
            }
            rows.absolute(where + "speed off the wall against v_n, over it", worst.normal, 0.0, 1e-9, "rounding");
            rows.absolute("along it against v_t - 2μv_n, over v_n", worst.tangent, 0.0, 1e-9, "rounding");
            // Friction acts at a distance of r - δ/2 from the centre.
            rows.absolute("rω against 4μv_n, over v_n", worst.spin, 0.0,
                          4.0 * std::tan(angle * std::numbers::pi / 180.0) * 0.5 * down * std::sqrt(mass / kn) / radius,
                          "lever arm r - δ/2");
        }
    }
    return rows.take();
}

}  // namespace
}  // namespace opening_scenes

std::vector<Claim> contact_opening_claims() {
    using namespace opening_scenes;
    constexpr const char* group = "Contacts that open and close";
    return {
        {.name = "bouncing_disc_keeps_its_energy",
         .group = group,
         .statement = "consistent integrator: the same energy after 1000 bounces, up to the stable limit; leapfrog: "
                      "E'/E = (1 - κs(1-s))/(1 - κs'(1-s')) per bounce, κ = 4λ², a random walk",
         .check = bouncing_disc_keeps_its_energy,
         .note =
             "λ is the step over 2√(m/k); s and s' are the fractions of a step at which the contact begins and ends."},
        {.name = "colliding_chain_keeps_its_energy_bounded",
         .group = group,
         .statement = "ten discs with gaps between two walls, consistent integrator: the closing error stays bounded",
         .check = colliding_chain_keeps_its_energy_bounded,
         .note = "The energy balance uses mean velocities. In a closed contact, their kinetic energy is too small by "
                 "⅛m(a dt)², at most λ² of the energy, until the contact opens. Leapfrog at 0.8 is stopped at 100 "
                 "times its initial energy."},
        {.name = "spinning_square_in_a_box_keeps_its_energy",
         .group = group,
         .statement =
             "a spinning square thrown between four walls, consistent integrator: the closing error stays small",
         .check = spinning_square_in_a_box_keeps_its_energy},
        {.name = "oblique_sliding_rebound_has_the_closed_form",
         .group = group,
         .statement = "sliding throughout: v_n' = v_n, v_t' = v_t - 2μv_n, rω' = 4μv_n, to rounding with the "
                      "consistent integrator at any step",
         .check = oblique_sliding_rebound_has_the_closed_form},
    };
}

}  // namespace crackle::verification
