// SPDX-License-Identifier: GPL-3.0-or-later
// Critical time steps: one spring with a dashpot, chains and lattices of equal discs. The exact step of whole specimens
// is checked in exact_step.cpp.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/linear/critical_step.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/dense_stiffness.hpp"
#include "tests/bench/verify/scenes/step_limit.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace critical_step_scenes {
namespace {

constexpr double radius = 0.02, overlap = 8e-5, kn = 1e7;
constexpr double lever = 1.0 - overlap / (2.0 * radius);  // lever arm of the shear spring, relative to the radius

/// Largest displacement of a disc that is pressed deep into a floor, m; the run stops at 1e-5.
double excursion(double h, double time_step, double& bound) {
    Scene scene;
    scene.materials = {rock(0.0)};
    scene.materials[0].damping_ratio = h;
    scene.domain = {-10.0, 10.0, 0.0, 10.0, {false, false, true, false}};
    scene.gravity = {0.0, -9.81e3};  // large enough that the contact never opens
    scene.add_circle_body(1, 0, {{0.0, radius}, radius, 0.0});
    const double rest = radius - mass_properties(scene, scene.bodies[0]).mass * 9.81e3 / kn;
    scene.circles[0].centre.y = rest;
    scene.bodies[0].velocity = {0.0, 1e-7};
    scene.time_step = time_step;
    scene.allow_unstable = true;
    World world = build_world(std::move(scene));
    bound = world.stepping.step_bound;
    double largest = 0.0;
    for (int n = 0; n < 4000 && largest < 1e-5; ++n) {
        step(world);
        largest = std::max(largest, std::abs(world.bodies.state[0].y - rest));
    }
    return largest;
}

std::vector<ClaimRow> critical_step_of_a_spring_and_dashpot() {
    Rows rows;
    const double mass = std::numbers::pi * 2500.0 * radius * radius;
    for (const double h : {0.0, 0.215, 0.5, 1.0}) {
        const double limit = 2.0 * std::sqrt(mass / kn) * (std::sqrt(h * h + 1.0) - h);
        double bound = 0.0;
        const double below = excursion(h, 0.99 * limit, bound), above = excursion(h, 1.01 * limit, bound);
        rows.relative(fmt::format("h {}: the engine's bound, s", h), bound, limit, 1e-9, "rounding");
        // The initial velocity of 1e-7 m/s gives an amplitude of 1e-7 √(m/k) = 6e-11 m. At 0.99 of the limit, leapfrog
        // can enlarge it, but not by a factor of 1e4.
        rows.at_most(fmt::format("h {}: largest displacement at 0.99 of it, m", h), below, 1e-6, "bounded");
        rows.at_least(fmt::format("h {}: largest displacement at 1.01 of it, m", h), above, 1e-5, "diverges");
    }
    return rows.take();
}

World bonded(Scene scene) {
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    return at_rest(std::move(world));
}

/// @param closed_form_squared ω²m of the infinite lattice, N/m
void check(Rows& rows, const std::string& name, const World& world, double closed_form_squared) {
    const double exact = critical_step(world, ClosedPoints::touching).root;
    const double infinite = 2.0 / std::sqrt(closed_form_squared / world.bodies.inertia[0].mass);
    rows.absolute(name + ": step of this specimen over the closed form", exact / infinite, 1.0, 0.02, "finite size");
    rows.at_least(name + ": the same, from below", exact / infinite, 1.0 - 1e-6, "part of the infinite one");
    check_step_limit(rows, name, world);
}

std::vector<ClaimRow> critical_step_of_a_triangular_lattice() {
    Rows rows;
    for (const double share : {0.0, 0.25, 1.0}) {
        const World world = bonded(triangular_lattice(12, 13, radius, overlap, rock(45.0, share)));
        check(rows, fmt::format("k_s/k_n {}", share), world,
              kn * std::max(6.0 + 2.0 * share, 24.0 * share * lever * lever));
    }
    return rows.take();
}

std::vector<ClaimRow> critical_step_of_a_square_lattice() {
    Rows rows;
    for (const double share : {0.25, 1.0}) {
        const World world = bonded(square_lattice(12, 12, radius, overlap, rock(45.0, share)));
        check(rows, fmt::format("k_s/k_n {}", share), world,
              kn * std::max(4.0 + 4.0 * share, 16.0 * share * lever * lever));
    }
    return rows.take();
}

std::vector<ClaimRow> critical_step_of_a_chain() {
    Rows rows;
    for (const double share : {0.25, 1.0}) {
        const World world = bonded(disc_chain(40, radius, 2.0 * radius - overlap, rock(45.0, share)));
        // Rotation and transverse displacement are coupled at general wavelengths; the closed form is for pure
        // rotation.
        check(rows, fmt::format("k_s/k_n {}", share), world, kn * std::max(4.0, 8.0 * share * lever * lever));
    }
    return rows.take();
}

std::vector<ClaimRow> one_disc_among_held_neighbours_overestimates() {
    Rows rows;
    for (const double share : {0.0, 0.25, 1.0}) {
        Scene scene = triangular_lattice(3, 3, radius, overlap, rock(45.0, share));
        const DofControl held{Drive::velocity, 0.0};
        const int middle = 4;  // in rows of 3, 2 and 3 discs, the left disc of the second row has six neighbours
        scene.add_circle_body(99, 0, {{-radius + 0.5 * overlap, scene.circles[3].centre.y}, radius, 0.0});
        for (int k = 0; k < static_cast<int>(scene.bodies.size()); ++k) {
            if (scene.bodies[static_cast<std::size_t>(k)].id != middle)
                scene.controls.push_back({k, held, held, held, 0});
        }
        const World world = bonded(std::move(scene));
        const double turning = share * lever * lever;
        const double expected =
            std::sqrt(std::max(6.0 + 2.0 * share, 24.0 * turning) / std::max(3.0 + 3.0 * share, 12.0 * turning));
        const double mass = world.bodies.inertia[0].mass;
        const double got = 2.0 / highest_frequency(world, dense_stiffness(world, 2e-5)) /
                           (2.0 / std::sqrt(kn * std::max(6.0 + 2.0 * share, 24.0 * turning) / mass));
        rows.relative(fmt::format("k_s/k_n {}: step over that of the lattice", share), got, expected, 1e-6,
                      "finite differences");
    }
    return rows.take();
}

}  // namespace
}  // namespace critical_step_scenes

std::vector<Claim> critical_step_claims() {
    using namespace critical_step_scenes;
    constexpr const char* group = "Critical step";
    return {
        {.name = "critical_step_of_a_spring_and_dashpot",
         .group = group,
         .statement = "dt_c = 2√(m/k)(√(h²+1) - h) with the lagged dashpot; bounded at 0.99 of it, divergent at 1.01",
         .check = critical_step_of_a_spring_and_dashpot},
        {.name = "critical_step_of_a_triangular_lattice",
         .group = group,
         .statement = "2/ω_max, ω²m = max(6k_n+2k_s, 24k_s); bounded at 0.99 of it, divergent at 1.01",
         .check = critical_step_of_a_triangular_lattice,
         .note = "24k_s holds for lever arms of R; here they are R - δ/2."},
        {.name = "critical_step_of_a_square_lattice",
         .group = group,
         .statement = "2/ω_max, ω²m = max(4k_n+4k_s, 16k_s); bounded at 0.99 of it, divergent at 1.01",
         .check = critical_step_of_a_square_lattice},
        {.name = "critical_step_of_a_chain",
         .group = group,
         .statement = "2/ω_max, ω²m = max(4k_n, 8k_s); bounded at 0.99 of it, divergent at 1.01",
         .check = critical_step_of_a_chain},
        {.name = "one_disc_among_held_neighbours_overestimates",
         .group = group,
         .statement = "step of one disc between fixed neighbours over that of the lattice: "
                      "√(max(6k_n+2k_s, 24k_s)/max(3k_n+3k_s, 12k_s)), up to √2",
         .check = one_disc_among_held_neighbours_overestimates},
    };
}

}  // namespace crackle::verification
