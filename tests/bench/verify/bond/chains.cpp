// SPDX-License-Identifier: GPL-3.0-or-later
// Bonded chains of equal discs: dispersion, catenary, strength.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace chains_scenes {
namespace {

constexpr double radius = 0.02, overlap = 8e-5, spacing = 2.0 * radius - overlap, kn = 1e7;
const DofControl held{Drive::velocity, 0.0};

// ---- waves

struct Wave {
    double expected, measured, stepped;  // ω in 1/s; `stepped` includes leapfrog's error
};

/// Standing wave of a chain between two held discs. @param step_share step relative to √(m/k)
Wave standing_wave(int count, int mode, double step_share, int periods) {
    Scene scene = disc_chain(count, radius, spacing, rock());
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({count - 1, held, held, held, 0});
    const double q = std::numbers::pi * mode / (count - 1);  // rad, times d
    const double mass = mass_properties(scene, scene.bodies[0]).mass;
    Wave wave{2.0 * std::sqrt(kn / mass) * std::abs(std::sin(0.5 * q)), 0.0, 0.0};
    for (int k = 1; k + 1 < count; ++k)
        scene.bodies[static_cast<std::size_t>(k)].velocity.x = 1e-7 * wave.expected * std::sin(q * k);
    scene.time_step = step_share * std::sqrt(mass / kn);
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    const BodyIndex watched =
        body_of_id(world, 1 + std::max(1, static_cast<int>(std::lround(0.5 * (count - 1) / mode))));
    const double rest = world.bodies.state[watched].x;
    // Period from the zero crossings of one disc.
    double first = 0.0, last = 0.0, before = 0.0;
    for (int crossings = 0; crossings < 2 * periods + 1;) {
        step(world);
        const double now = world.bodies.state[watched].x - rest;
        if (before != 0.0 && (now > 0.0) != (before > 0.0)) {
            last = world.stepping.time - world.stepping.time_step * now / (now - before);
            if (crossings == 0) first = last;
            ++crossings;
        }
        before = now;
    }
    wave.measured = std::numbers::pi * 2.0 * periods / (last - first);
    wave.stepped = 2.0 / world.stepping.time_step * std::asin(0.5 * wave.expected * world.stepping.time_step);
    return wave;
}

std::vector<ClaimRow> chain_waves_have_the_dispersion_of_masses_on_springs() {
    Rows rows;
    for (const int mode : {1, 2, 5, 11, 21, 31}) {
        const Wave fine = standing_wave(33, mode, 0.05, 20);
        rows.relative(fmt::format("qd = {}π/32: ω, leapfrog's own shift counted, 1/s", mode), fine.measured,
                      fine.stepped, 1e-5, "crossings");
        // Leapfrog's ω is too high by (ω dt)²/24, here at most 0.1²/24.
        rows.relative(fmt::format("qd = {}π/32: ω at dt 0.05√(m/k), 1/s", mode), fine.measured, fine.expected, 5e-4,
                      "(ω dt)²/24");
        if (mode < 5) continue;
        const Wave coarse = standing_wave(33, mode, 0.4, 20);
        rows.converging(
            {std::abs(coarse.measured - coarse.expected), std::abs(fine.measured - fine.expected), 8.0, 2.0});
    }
    return rows.take();
}

std::vector<ClaimRow> long_chain_waves_travel_at_their_speed() {
    Rows rows;
    for (const int count : {65, 129}) {
        const Wave wave = standing_wave(count, 1, 0.05, 3);
        const double q = std::numbers::pi / (count - 1) / spacing, mass = 2500.0 * std::numbers::pi * radius * radius;
        // The error is the dispersion (qd)²/24 and leapfrog's smaller error of opposite sign.
        rows.relative(fmt::format("ω/q of a wave of {} spacings, m/s", 2 * (count - 1)), wave.measured / q,
                      spacing * std::sqrt(kn / mass), q * spacing * q * spacing / 24.0 * 1.1, "(qd)²/24");
    }
    return rows.take();
}

// ---- catenary

/// Shape of a chain of `bonds` springs that hangs between two held points at a distance `span`. Horizontal tensions are
/// equal, and vertical tensions differ by the weights between them.
struct Catenary {
    double horizontal;        // N
    std::vector<Vec2> place;  // m, positions relative to the left end
};
Catenary discrete_catenary(int bonds, double span, double weight) {
    const auto hang = [&](double horizontal) {
        Catenary shape{horizontal, {{0.0, 0.0}}};
        for (int k = 0; k < bonds; ++k) {
            const double vertical = weight * (k - 0.5 * (bonds - 1));
            const double tension = std::hypot(horizontal, vertical), length = spacing + tension / kn;
            shape.place.push_back(shape.place.back() + (length / tension) * Vec2{horizontal, vertical});
        }
        return shape;
    };
    double low = 1e-6 * weight, high = 1e6 * weight;
    for (int n = 0; n < 200; ++n) {
        const double middle = std::sqrt(low * high);
        (hang(middle).place.back().x < span ? low : high) = middle;
    }
    return hang(std::sqrt(low * high));
}

std::vector<ClaimRow> bonded_chain_hangs_as_a_catenary() {
    Rows rows;
    const int count = 21;
    const double deep = 4e-4, gravity = 9.81;
    // The chain starts on an arc of 120 degrees. It has no friction, so that bonds pull only along their own line.
    Scene scene = disc_chain(count, radius + 0.5 * (deep - overlap), spacing, rock(0.0));
    const double by = 2.0 * std::numbers::pi / 3.0 / (count - 1), arc = 0.5 * spacing / std::sin(0.5 * by);
    for (int k = 0; k < count; ++k) {
        const double angle = by * (k - 0.5 * (count - 1)) - 0.5 * std::numbers::pi;
        scene.circles[static_cast<std::size_t>(k)].centre = {arc * std::cos(angle), arc * std::sin(angle)};
    }
    scene.gravity = {0.0, -gravity};
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({count - 1, held, held, held, 0});
    World world = build_world(std::move(scene));
    rows.exactly("bonds", static_cast<double>(bond_all(world, 0.0)), count - 1);
    const double weight = world.bodies.inertia[body_of_id(world, 2)].mass * gravity;
    // Viscous drag brings the chain to rest; its slowest oscillation takes about a second.
    while (world.stepping.time < 12.0) {
        step(world);
        for (BodyState& body : world.bodies.state) {
            body.vx *= 1.0 - 8.0 * world.stepping.time_step;
            body.vy *= 1.0 - 8.0 * world.stepping.time_step;
        }
    }
    compute_forces(world);
    const auto place = [&](int id) {
        const BodyState& body = world.bodies.state[body_of_id(world, id)];
        return Vec2{body.x, body.y};
    };
    const Catenary shape = discrete_catenary(count - 1, place(count).x - place(1).x, weight);
    double horizontal = 0.0, vertical = 0.0, off = 0.0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        const int left = std::min(world.bodies.info(view.body_i).id, world.bodies.info(view.body_j).id);
        const Vec2 pull = -view.normal_force * view.normal;
        const double sense = pull.x < 0.0 ? -1.0 : 1.0;
        horizontal = std::max(horizontal, std::abs(sense * pull.x - shape.horizontal));
        vertical = std::max(vertical, std::abs(sense * pull.y - weight * (left - 1 - 0.5 * (count - 2))));
    }
    for (int k = 0; k < count; ++k)
        off = std::max(off, norm(place(k + 1) - place(1) - shape.place[static_cast<std::size_t>(k)]));
    const Vec2 ends =
        Vec2{0.0, world.bodies.force[body_of_id(world, 1)].fy + world.bodies.force[body_of_id(world, count)].fy};
    // Forces are stiffnesses times differences of coordinates, so their round-off is k_n·eps·1 m = 2e-9 N.
    rows.absolute("horizontal tension of any bond against the catenary's, over it", horizontal / shape.horizontal, 0.0,
                  1e-9, "rounding");
    rows.absolute("vertical tension of any bond against the weights below, over the total weight",
                  vertical / (weight * (count - 2)), 0.0, 1e-9, "rounding");
    rows.relative("weight on both ends, N", -ends.y, weight * (count - 2), 1e-9, "rounding");
    rows.absolute("positions against the discrete catenary, over the spacing", off / spacing, 0.0, 1e-9, "rounding");
    rows.shown("sag over span", -shape.place[(count - 1) / 2].y / shape.place.back().x);
    return rows.take();
}

// ---- strength

std::vector<ClaimRow> bonded_chain_pulled_breaks_at_its_back_tension() {
    Rows rows;
    // The guide's chain with r 1.1, spacing 2.0 and k_n 1e8 has a strength of 2e7.
    Material material = rock();
    material.normal_stiffness = 1e8;
    material.shear_stiffness = 2.5e7;
    material.damping_ratio = 0.5;
    Scene scene = disc_chain(20, 1.1, 2.0, material);
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({19, {Drive::velocity, 0.02}, held, held, 0});
    for (std::size_t k = 1; k < 19; ++k) scene.bodies[k].velocity = {0.02 * static_cast<double>(k) / 19.0, 0.0};
    World world = build_world(std::move(scene));
    rows.exactly("bonds", static_cast<double>(bond_all(world, 0.0)), 19);
    const BodyIndex fixed = body_of_id(world, 1), pulled = body_of_id(world, 20);
    double pull = 0.0, hold = 0.0;
    while (world.bonds.broken == 0 && world.stepping.time < 400.0) {
        compute_forces(world);
        if (world.bonds.broken > 0) break;
        pull = -world.bodies.force[pulled].fx;
        hold = world.bodies.force[fixed].fx;
        advance(world);
    }
    rows.at_least("bonds broken", static_cast<double>(world.bonds.broken), 1.0, "breaks");
    if (world.bonds.broken == 0) return rows.take();
    const BreakEvent& event = world.bonds.events.front();
    // Each step stretches a bond by 0.02/19 dt relative to 0.2 m, 2e-6; the loading is 1e3 times slower than the
    // chain's waves.
    rows.relative("pull when the first bond breaks, N", pull, 2e7, 1e-3, "rate");
    rows.relative("hold at the other end, N", hold, 2e7, 1e-3, "rate");
    rows.relative("strength of the event, N", event.strength, 2e7, 1e-9, "rounding");
    rows.relative("energy of the event, J", event.energy, 0.5 * 1e8 * 0.04, 2e-3, "rate");
    rows.exactly("broken in shear", event.shear_mode ? 1.0 : 0.0, 0.0);
    rows.absolute("extension when it breaks, m", world.bodies.state[pulled].x - world.bodies.state[fixed].x - 38.0,
                  19 * 0.2, 0.01, "rate");
    return rows.take();
}

}  // namespace
}  // namespace chains_scenes

std::vector<Claim> chain_claims() {
    using namespace chains_scenes;
    constexpr const char* group = "Chains and lattices";
    return {
        {.name = "chain_waves_have_the_dispersion_of_masses_on_springs",
         .group = group,
         .statement = "ω = 2√(k/m)|sin(qd/2)|",
         .check = chain_waves_have_the_dispersion_of_masses_on_springs},
        {.name = "long_chain_waves_travel_at_their_speed",
         .group = group,
         .statement = "long waves travel at d√(k/m)",
         .check = long_chain_waves_travel_at_their_speed},
        {.name = "bonded_chain_hangs_as_a_catenary",
         .group = group,
         .statement = "discrete catenary of springs: equal horizontal tension, weights between the vertical ones",
         .check = bonded_chain_hangs_as_a_catenary},
        {.name = "bonded_chain_pulled_breaks_at_its_back_tension",
         .group = group,
         .statement = "breaks at k_n δ₀ (the guide's chain: 2e7)",
         .check = bonded_chain_pulled_breaks_at_its_back_tension},
    };
}

}  // namespace crackle::verification
