// SPDX-License-Identifier: GPL-3.0-or-later
// The coulomb bond: its failure envelope and failure modes, its relation to a back-tension bond, and its energy.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace coulomb_scenes {
namespace {

constexpr double radius = 0.02, overlap = 1e-7, kn = 1e7, ks = 0.25 * kn, time_step = 1e-5;
constexpr double mean_tensile = 2.0, mean_cohesion = 3.0;  // N; k_n δ0 is 1 N, so the bond breaks only at a gap
constexpr int left = 4, right = 9;
double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180.0); }
const double friction = tangent(30.0);

StrengthFactors some_factors() { return {StrengthDistribution::weibull, 0.3, 2}; }
double factor_of_pair() { return some_factors().between(left, right); }

/// Two bonded discs side by side. The right one is driven such that the bond's forces change by these amounts per step,
/// N. The other is free to move, since nothing would be computed otherwise, but far too heavy to rotate.
World driven_pair(double normal, double shear) {
    Scene scene;
    scene.materials = {rock(30.0)};
    scene.materials[0].residual_friction_angle = 20.0;
    scene.materials[0].tensile_strength = mean_tensile;
    scene.materials[0].cohesion = mean_cohesion;
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].density = 1e12;
    scene.bond_law = BondLaw::coulomb;
    scene.domain = {-1.0, 1.0, -1.0, 1.0, {true, true, true, true}};
    scene.time_step = time_step;
    scene.add_circle_body(left, 1, {{0.0, 0.0}, radius, 0.0});
    scene.add_circle_body(right, 0, {{2.0 * radius - overlap, 0.0}, radius, 0.0});
    const DofControl still{Drive::velocity, 0.0};
    scene.controls = {
        {0, still, still, {}, 0},
        {1, {Drive::velocity, -normal / kn / time_step}, {Drive::velocity, shear / ks / time_step}, still, 0}};
    World world = build_world(std::move(scene));
    Bonding bonding;
    bonding.factors = some_factors();
    bond_all(world, bonding);
    return world;
}

void drive(World& world, double normal, double shear) {
    const BodyIndex driven = body_of_id(world, right);
    change_velocity(world, driven, 0, -normal / kn / time_step);
    change_velocity(world, driven, 1, shear / ks / time_step);
}

/// Means over loadings whose steps reach the envelope at evenly distributed fractions of a step.
struct OnEnvelope {
    double load = 0.0;          // √(f_n² + f_t²) at the break, relative to that on the envelope
    double strength_off = 0.0;  // largest relative error of the recorded strength
    int wrong_modes = 0;
};

OnEnvelope break_at(double degrees, int steps) {
    constexpr int phases = 16;
    const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    const double x = factor_of_pair();
    const double to_tension = c < 0.0 ? -x * mean_tensile / c : 1e300;
    const double closing = std::abs(s) - friction * c, to_shear = closing > 0.0 ? x * mean_cohesion / closing : 1e300;
    const double expected = std::min(to_tension, to_shear);
    OnEnvelope result;
    for (int phase = 0; phase < phases; ++phase) {
        const double each = expected / (steps + (phase + 0.5) / phases);  // N per step
        World world = driven_pair(each * c, each * s);
        for (int n = 0; n < 2 * steps && world.bonds.events.empty(); ++n) step(world);
        const BreakEvent& event = world.bonds.events.at(0);
        result.load += std::hypot(event.normal_force, event.shear_force) / expected / phases;
        const double strength =
            to_shear < to_tension ? x * mean_cohesion + friction * event.normal_force : x * mean_tensile;
        result.strength_off = std::max(result.strength_off, std::abs(event.strength / strength - 1.0));
        result.wrong_modes += event.shear_mode == (to_shear < to_tension) ? 0 : 1;
    }
    return result;
}

std::vector<ClaimRow> coulomb_bond_breaks_on_its_envelope() {
    Rows rows;
    // The corner of the envelope is at 137.3 degrees.
    for (const double degrees : {45.0, -70.0, 90.0, 120.0, 135.0, -140.0, 180.0}) {
        constexpr int steps = 200;
        const OnEnvelope coarse = break_at(degrees, steps / 2), fine = break_at(degrees, steps);
        const std::string name = fmt::format("{}°", degrees);
        // The error is half a step, plus the rotation of the normal by the slip.
        rows.absolute(name + ": force at the break over that on the envelope", fine.load, 1.0, 1.0 / steps, "a step");
        rows.converging({std::abs(coarse.load - 1.0), std::abs(fine.load - 1.0), 2.0, 1.0});
        rows.exactly(name + ": breaks of the wrong mode", coarse.wrong_modes + fine.wrong_modes, 0.0);
        rows.absolute(name + ": recorded strength over that of the bond", fine.strength_off, 0.0, 1e-6,
                      "share, a float");
    }
    return rows.take();
}

std::vector<ClaimRow> coulomb_bond_of_its_overlap_is_a_back_tension_bond() {
    Rows rows;
    constexpr double bond_overlap = 8e-5;
    Scene scene = triangular_lattice(9, 9, radius, bond_overlap, rock());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const auto k = static_cast<double>(b);
        scene.bodies[b].velocity = {0.1 * std::sin(1.7 * k), 0.1 * std::cos(2.3 * k)};
    }
    scene.safety_factor = 0.02;  // so that the run has many steps
    Scene strong = scene;
    strong.bond_law = BondLaw::coulomb;
    strong.materials[0].tensile_strength = kn * bond_overlap;
    strong.materials[0].cohesion = tangent(27.0) * kn * bond_overlap * (1.0 + 1e-9);  // allows for round-off
    strong.materials[0].residual_friction_angle = 27.0;
    World by_overlap = build_world(std::move(scene)), by_strength = build_world(std::move(strong));
    bond_all(by_overlap, 0.0);
    bond_all(by_strength, 0.0);
    double farthest = 0.0;
    const auto begun = [](const World& world) {
        return world.bonds.broken > 0 || std::any_of(world.points.state.begin(), world.points.state.end(),
                                                     [](const PointState& p) { return (p.flags & point_slid) != 0; });
    };
    std::int64_t steps = 0;
    while (steps < 20000 && !begun(by_overlap) && !begun(by_strength)) {
        farthest = 0.0;
        for (std::size_t b = 0; b < by_overlap.bodies.size(); ++b) {
            const BodyState &one = by_overlap.bodies.state[b], &other = by_strength.bodies.state[b];
            farthest = std::max(farthest, norm({one.x - other.x, one.y - other.y}));
        }
        step(by_overlap);
        step(by_strength);
        ++steps;
    }
    rows.at_least("steps to the first slip or break", static_cast<double>(steps), 20.0, "it moves");
    // k(δ - δ0) and kδ - kδ0 differ by 1e-16 of kδ0 in each step.
    rows.absolute("difference until then, over the overlap", farthest / bond_overlap, 0.0, 1e-10, "rounding");
    rows.exactly("back-tension bond: slips or breaks in this step", begun(by_overlap) ? 1.0 : 0.0, 1.0);
    rows.exactly("coulomb bond: breaks in this step", begun(by_strength) ? 1.0 : 0.0, 1.0);
    return rows.take();
}

std::vector<ClaimRow> coulomb_bond_cycled_below_its_envelope_loses_nothing() {
    Rows rows;
    constexpr int steps = 200;
    const double to = 0.8 * mean_tensile * factor_of_pair() / steps;  // N per step
    World world = driven_pair(-to, 0.0);
    const BodyIndex driven = body_of_id(world, right);
    const auto force = [&] {
        compute_forces(world);
        return Vec2{world.bodies.force[driven].fx, world.bodies.force[driven].fy};
    };
    double work = 0.0, largest = 0.0;  // J
    // The bond is loaded three times along the same closed path: pulled, sheared, released, sheared back.
    for (int loop = 0; loop < 3; ++loop) {
        for (const auto& [normal, shear] : {std::pair{-to, 0.0}, {0.0, 0.5 * to}, {to, 0.0}, {0.0, -0.5 * to}}) {
            drive(world, normal, shear);
            for (int n = 0; n < steps; ++n) {
                const Vec2 before = force();
                const BodyState at = world.bodies.state[driven];
                advance(world);
                const Vec2 after = force(),
                           moved{world.bodies.state[driven].x - at.x, world.bodies.state[driven].y - at.y};
                work -= 0.5 * dot(before + after, moved);
            }
            largest = std::max(largest, measure_ledger(world).strain);
        }
    }
    rows.exactly("bonds broken", static_cast<double>(world.bonds.broken), 0.0);
    rows.exactly("friction loss, J", world.account.friction_loss, 0.0);
    rows.exactly("fracture loss, J", world.account.fracture_loss, 0.0);
    // In each loop the normal rotates by the slip divided by the distance of the centres.
    const double turn = 0.5 * to * steps / ks / (2.0 * radius);
    rows.absolute("work of the loops over the largest strain energy", work / largest, 0.0, 3.0 * turn,
                  "turn of the normal");
    return rows.take();
}

/// Compresses a pair to 5 N, shears it until the bond breaks, and then as far again. @return closing error relative to
/// the losses
/// @param rows receives further rows; may be null
double pair_sheared_under_pressure(int steps, Rows* rows) {
    const double press = 5.0, sticks = mean_cohesion * factor_of_pair() + friction * press,
                 rubs = tangent(20.0) * press;
    World world = driven_pair(press / steps, 0.0);
    for (int n = 0; n < steps; ++n) step(world);
    drive(world, 0.0, sticks / steps);
    for (int n = 0; n < 2 * steps; ++n) step(world);
    compute_forces(world);
    const Ledger ledger = measure_ledger(world);
    if (rows != nullptr) {
        const auto& events = world.bonds.events;
        rows->exactly("pair: breaks in shear", events.size() == 1 && events[0].shear_mode ? 1.0 : 0.0, 1.0);
        rows->relative("pair: energy of the break, J", ledger.fracture_loss, 0.5 * (sticks * sticks - rubs * rubs) / ks,
                       4.0 / steps, "a step");
        rows->relative("pair: friction loss, J", ledger.friction_loss, rubs * sticks / ks, 4.0 / steps, "a step");
    }
    return std::abs(ledger.closing_error) / (ledger.fracture_loss + ledger.friction_loss);
}

struct ShearedLattice {
    double closing = 0.0;  // error of the energy balance, relative to the work
    double broken = 0.0, in_shear = 0.0;
    double least_energy = 0.0;  // J
};

/// A damped lattice with random strengths between two rows, which are pressed together and then sheared.
ShearedLattice lattice_sheared_under_pressure(double share_of_step) {
    constexpr int columns = 8, layers = 7;
    constexpr double lattice_overlap = 8e-5, strength = 400.0;  // m, N
    Material material = rock(30.0);
    material.damping_ratio = 0.2;
    material.tensile_strength = strength;
    material.cohesion = 1.5 * strength;
    material.residual_friction_angle = 20.0;
    Scene scene = triangular_lattice(columns, layers, radius, lattice_overlap, material);
    scene.bond_law = BondLaw::coulomb;
    scene.safety_factor = share_of_step;
    const DofControl still{Drive::velocity, 0.0};
    const auto count = static_cast<int>(scene.bodies.size());
    for (int b = 0; b < columns; ++b) {
        scene.controls.push_back({b, still, still, still, 0});
        scene.controls.push_back({count - columns + b, {Drive::velocity, 0.1}, {Drive::velocity, -0.02}, still, 0});
    }
    World world = build_world(std::move(scene));
    Bonding bonding;
    bonding.factors = {StrengthDistribution::weibull, 0.3, 3};
    bond_all(world, bonding);
    while (world.stepping.time < 0.02) step(world);
    compute_forces(world);
    const Ledger ledger = measure_ledger(world);
    ShearedLattice result;
    result.closing = std::abs(ledger.closing_error) / ledger.displacement_work;
    result.broken = static_cast<double>(world.bonds.broken);
    for (const BreakEvent& event : world.bonds.events) {
        result.in_shear += event.shear_mode ? 1.0 : 0.0;
        result.least_energy = std::min(result.least_energy, event.energy);
    }
    return result;
}

std::vector<ClaimRow> shear_breaks_under_pressure_close_the_account() {
    Rows rows;
    const double pair = pair_sheared_under_pressure(1000, &rows);
    rows.absolute("pair: closing error over these losses", pair, 0.0, 1e-5, "second order");
    rows.converging({pair_sheared_under_pressure(500, nullptr), pair, 2.0, 2.0});
    const ShearedLattice coarse = lattice_sheared_under_pressure(0.2), fine = lattice_sheared_under_pressure(0.05);
    rows.at_least("lattice: bonds broken", fine.broken, 20.0, "it breaks");
    rows.at_least("lattice: bonds broken in shear", fine.in_shear, 5.0, "under pressure");
    rows.at_least("lattice: smallest energy of a break, J", std::min(coarse.least_energy, fine.least_energy), 0.0,
                  "decrease of the strain energy");
    rows.absolute("lattice: closing error over the work", fine.closing, 0.0, 1e-5, "second order");
    rows.converging({coarse.closing, fine.closing, 4.0, 2.0});
    return rows.take();
}

}  // namespace
}  // namespace coulomb_scenes

std::vector<Claim> coulomb_bond_claims() {
    using namespace coulomb_scenes;
    constexpr const char* group = "Bonds with given strengths";
    return {
        {.name = "coulomb_bond_breaks_on_its_envelope",
         .group = group,
         .statement = "a bond loaded along a straight path from rest breaks at f_n = -T or |f_t| = C + μ f_n, "
                      "whichever comes first, and in the mode of that limit",
         .check = coulomb_bond_breaks_on_its_envelope,
         .note = "Angles are measured from compression along the normal. Means are over 16 loadings that reach the "
                 "envelope at times evenly distributed over a step. The bond has a random strength factor."},
        {.name = "coulomb_bond_of_its_overlap_is_a_back_tension_bond",
         .group = group,
         .statement = "with T = k_n δ₀ and C = μ k_n δ₀, a lattice moves as one with back-tension bonds until their "
                      "first slip; in the same step, its first bond breaks",
         .check = coulomb_bond_of_its_overlap_is_a_back_tension_bond},
        {.name = "coulomb_bond_cycled_below_its_envelope_loses_nothing",
         .group = group,
         .statement =
             "a bond that is pulled, sheared, released and sheared back below its envelope dissipates no energy",
         .check = coulomb_bond_cycled_below_its_envelope_loses_nothing},
        {.name = "shear_breaks_under_pressure_close_the_account",
         .group = group,
         .statement = "if bonds break in shear under pressure and continue to slide, the energy balance closes to "
                      "second order in the step, and no break gains energy",
         .check = shear_breaks_under_pressure_close_the_account},
    };
}

}  // namespace crackle::verification
