// SPDX-License-Identifier: GPL-3.0-or-later
// Work-precision studies against closed forms: a bouncing disc, an oblique rebound, a wave in a chain. Two colliding
// squares are compared with the same collision at a much smaller step.
// Tested by tests/bench_tests/commands/bench_test.cpp.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "specimens/making/materials.hpp"
#include "tests/bench/accuracy/accuracy.hpp"

namespace crackle::accuracy {
namespace {

constexpr double radius = 0.02, density = 2500.0, gravity = 9.81;
constexpr double disc_mass = density * std::numbers::pi * radius * radius;
constexpr Integrator both[] = {Integrator::leapfrog, Integrator::consistent};

/// Time steps relative to the stable step; each is half the one before.
std::vector<double> shares(double largest, int count, bool quick) {
    std::vector<double> list(quick ? 3U : static_cast<std::size_t>(count), largest);
    for (std::size_t k = 1; k < list.size(); ++k) list[k] = 0.5 * list[k - 1];
    return list;
}

/// Rows of one study. @param run returns the error for (law, integrator, share)
template <typename Run>
void add_rows(std::vector<AccuracyRow>& rows, const char* study, SegmentLaw law, Integrator integrator,
              const std::vector<double>& steps, Run&& run) {
    for (const double share : steps) {
        AccuracyRow row{study, name_of(law), name_of(integrator), "time_step", share, 0.0, 0.0};
        row.cpu_seconds = median_cpu_seconds([&] { row.error = run(law, integrator, share); });
        rows.push_back(row);
    }
}

template <typename Run>
std::vector<AccuracyRow> rows_of_discs(const char* study, const std::vector<double>& steps, Run&& run) {
    std::vector<AccuracyRow> rows;
    for (const Integrator integrator : both) add_rows(rows, study, SegmentLaw::rounded, integrator, steps, run);
    return rows;
}

// ---- a disc dropped on a floor, undamped

constexpr double floor_stiffness = 1e5;
constexpr int starts = 8, bounces = 20;

Scene above_floor(Integrator integrator, double share, double height, double friction_angle) {
    Scene scene;
    scene.materials = {undamped_rock(floor_stiffness, friction_angle)};
    scene.domain = {-1e3, 1e3, 0.0, 1e3, {false, false, true, false}};
    scene.add_circle_body(1, 0, {{0.0, radius + height}, radius, 0.0});
    scene.integrator = integrator;
    scene.allow_unstable = true;  // the energy under leapfrog may grow without bound, which the study shows
    scene.time_step = share * 2.0 * std::sqrt(disc_mass / floor_stiffness);
    return scene;
}

/// Height over the floor: parabolas in flight, and a harmonic oscillation about the static deflection in contact.
struct BouncePath {
    double drop;
    double speed() const { return std::sqrt(2.0 * gravity * drop); }
    double omega() const { return std::sqrt(floor_stiffness / disc_mass); }
    double contact_time() const { return 2.0 / omega() * (std::numbers::pi - std::atan(speed() * omega() / gravity)); }
    double period() const { return 2.0 * speed() / gravity + contact_time(); }
    double height(double time) const {
        const double fall = speed() / gravity;
        if (time <= fall) return drop - 0.5 * gravity * time * time;
        const double t = std::fmod(time - fall, period());
        if (t >= contact_time()) {
            const double s = t - contact_time();
            return speed() * s - 0.5 * gravity * s * s;
        }
        const double w = omega();
        return gravity / (w * w) * (std::cos(w * t) - 1.0) - speed() / w * std::sin(w * t);
    }
};

struct BounceErrors {
    double energy, path;
};

BounceErrors bounce_errors(Integrator integrator, double share) {
    BounceErrors errors{0.0, 0.0};
    for (int k = 0; k < starts; ++k) {
        const BouncePath path{0.005 + 0.002 * (k + 0.5) / starts};
        Scene scene = above_floor(integrator, share, path.drop, 0.0);
        scene.gravity = {0.0, -gravity};
        World world = build_world(std::move(scene));
        double off = 0.0;
        // The run ends in the middle of a flight.
        const double end = bounces * path.period();
        while (world.stepping.time < end) {
            step(world);
            off = std::max(off,
                           std::abs(world.bodies.state[0].y - radius - path.height(world.stepping.time)) / path.drop);
            if (!(off < 1e3)) break;
        }
        // A disc with an inaccurate path may still be in contact at the end; the run continues until it is in flight.
        compute_forces(world);
        for (int n = 0; n < 100000 && world.bodies.state[0].y <= radius; ++n) advance(world), compute_forces(world);
        const double energy = measure_ledger(world).closing_error / (disc_mass * gravity * path.drop);
        errors.energy += energy * energy / starts;
        errors.path = std::max(errors.path, off);
    }
    errors.energy = std::sqrt(errors.energy);
    return errors;
}

// ---- an oblique rebound, sliding throughout

double oblique_error(SegmentLaw, Integrator integrator, double share) {
    constexpr double down = 0.1, along = 0.3, angle = 15.0;
    const double mu = std::tan(angle * std::numbers::pi / 180.0);
    double worst = 0.0;
    for (int k = 0; k < starts; ++k) {
        const double dt = share * 2.0 * std::sqrt(disc_mass / floor_stiffness);
        Scene scene = above_floor(integrator, share, (1.0 + (k + 0.5) / starts) * down * dt, angle);
        scene.bodies[0].velocity = {along, -down};
        World world = build_world(std::move(scene));
        const BodyState& disc = world.bodies.state[0];
        while (disc.vy <= 0.0 || disc.y <= radius) step(world);
        worst = std::max(worst, std::hypot(disc.vy - down, disc.vx - (along - 2.0 * mu * down)) / down);
    }
    return worst;
}

// ---- two squares

struct Squares {
    BodyState a, b;
};

Squares collide(SegmentLaw law, Integrator integrator, double share, int start) {
    constexpr double half = 0.02, stiffness = 1e7, speed = 0.3;
    Scene scene;
    scene.materials = {undamped_rock(stiffness, 0.0)};
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {false, false, false, false}};
    scene.thick = 1e-3;
    scene.segment_law = law;
    scene.integrator = integrator;
    scene.allow_unstable = true;
    scene.add_chain_body(1, 0, {{-half, -half}, {half, -half}, {half, half}, {-half, half}}, true);
    // A corner hits an edge away from the edge's middle; in the second impact the two squares exchange roles.
    const double turn = 0.35 + 0.08 * start, c = half * std::cos(turn), s = half * std::sin(turn);
    const Vec2 middle{0.05 + 1e-4 * start, 0.004 + 1e-3 * start};
    scene.add_chain_body(2, 0,
                         {middle + Vec2{-c + s, -s - c}, middle + Vec2{c + s, s - c}, middle + Vec2{c - s, s + c},
                          middle + Vec2{-c - s, -s + c}},
                         true);
    scene.bodies[1].velocity = {-speed, 0.0};
    scene.bodies[1].spin = 2.0;
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    scene.time_step = share * std::sqrt(mass / stiffness);
    constexpr double duration = 0.06;
    World world = build_world(std::move(scene));
    const auto steps = static_cast<int>(std::ceil(duration / world.stepping.time_step));
    for (int n = 0; n < steps; ++n) step(world);
    return {world.bodies.state[body_of_id(world, 1)], world.bodies.state[body_of_id(world, 2)]};
}

/// Difference of the velocities after the collision, relative to the initial speed. Spin counts as the speed of a
/// corner.
double distance(const Squares& one, const Squares& other) {
    const auto of = [](const BodyState& a, const BodyState& b) {
        return std::hypot(a.vx - b.vx, a.vy - b.vy, 0.0283 * (a.omega - b.omega));
    };
    return std::hypot(of(one.a, other.a), of(one.b, other.b)) / 0.3;
}

std::vector<AccuracyRow> polygon_collision(bool quick) {
    std::vector<AccuracyRow> rows;
    const std::vector<double> steps = shares(0.4, 8, quick);
    for (const SegmentLaw law : {SegmentLaw::rounded, SegmentLaw::demseg}) {
        std::vector<Squares> exact;
        exact.reserve(starts);
        for (int k = 0; k < starts; ++k) exact.push_back(collide(law, Integrator::leapfrog, steps.back() / 16.0, k));
        for (const Integrator integrator : both) {
            if (law != SegmentLaw::rounded && integrator == Integrator::consistent) continue;  // same as leapfrog
            add_rows(rows, "polygon_collision", law, integrator, steps, [&](SegmentLaw l, Integrator i, double share) {
                double squares = 0.0;
                for (int k = 0; k < starts; ++k) {
                    const double off = distance(collide(l, i, share, k), exact[static_cast<std::size_t>(k)]);
                    squares += off * off / starts;
                }
                return std::sqrt(squares);
            });
        }
    }
    return rows;
}

// ---- a standing wave in a bonded chain between two held discs

double wave_error(SegmentLaw, Integrator integrator, double share) {
    constexpr int count = 33, mode = 5;
    constexpr double stiffness = 1e7, spacing = 2.0 * radius - 8e-5, amplitude = 1e-7;
    constexpr DofControl held{Drive::velocity, 0.0};
    Scene scene = disc_chain(count, radius, spacing, undamped_rock(stiffness, 27.0));
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({count - 1, held, held, held, 0});
    const double q = std::numbers::pi * mode / (count - 1);
    const double omega = 2.0 * std::sqrt(stiffness / disc_mass) * std::sin(0.5 * q);
    for (int k = 1; k + 1 < count; ++k)
        scene.bodies[static_cast<std::size_t>(k)].velocity.x = amplitude * omega * std::sin(q * k);
    scene.integrator = integrator;
    scene.time_step = share * std::sqrt(disc_mass / stiffness) / std::sqrt(2.0);  // ω²m is at most 8k
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    std::vector<BodyIndex> disc;
    std::vector<double> rest;
    for (int k = 0; k < count; ++k) {
        disc.push_back(body_of_id(world, k + 1));
        rest.push_back(world.bodies.state[disc.back()].x);
    }
    while (world.stepping.time < 10.0 * 2.0 * std::numbers::pi / omega) step(world);
    double squares = 0.0, all = 0.0;
    for (int k = 0; k < count; ++k) {
        const auto n = static_cast<std::size_t>(k);
        const double shape = std::sin(q * k);
        const double off =
            world.bodies.state[disc[n]].x - rest[n] - amplitude * shape * std::sin(omega * world.stepping.time);
        squares += off * off;
        all += amplitude * amplitude * shape * shape;
    }
    return std::sqrt(squares / all);
}

}  // namespace

std::vector<AccuracyStudy> collision_studies() {
    return {
        {"bounce_energy", "Disc on a floor, 20 bounces: energy", "|E'/E - 1|, rms of 8 starts",
         [](bool quick) {
             return rows_of_discs("bounce_energy", shares(0.8, 8, quick), [](SegmentLaw, Integrator i, double share) {
                 return bounce_errors(i, share).energy;
             });
         }},
        {"bounce_path", "Disc on a floor, 20 bounces: path", "distance from path / drop",
         [](bool quick) {
             return rows_of_discs("bounce_path", shares(0.8, 8, quick),
                                  [](SegmentLaw, Integrator i, double share) { return bounce_errors(i, share).path; });
         }},
        {"oblique_rebound", "Disc sliding on a floor: rebound", "velocity error / normal speed",
         [](bool quick) { return rows_of_discs("oblique_rebound", shares(0.8, 8, quick), oblique_error); }},
        {"polygon_collision", "Two squares collide", "velocity error / speed", polygon_collision},
        {"chain_wave", "Wave in a bonded chain, 10 periods", "displacement error / wave",
         [](bool quick) { return rows_of_discs("chain_wave", shares(0.8, 7, quick), wave_error); }},
    };
}

}  // namespace crackle::accuracy
