// SPDX-License-Identifier: GPL-3.0-or-later
// Bonded triangular lattices and chains of equal discs against closed forms: stiffness, critical step, strength, waves.

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "solver/elastic.hpp"
#include "specimens/catalogue/lattices.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/dense_stiffness.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::rock;
using testing::within;

constexpr double radius = 0.02, overlap = 8e-5, spacing = 2.0 * radius - overlap, kn = 1e7;

World lattice(int columns, int rows, double shear_share, IntactOptions intact = {true, true, true}) {
    Scene scene = triangular_lattice(columns, rows, radius, overlap, rock(45.0, shear_share));
    scene.intact = intact;
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    return world;
}

struct Strain {
    double xx, yy, xy;  // tensor components
};

struct Section {
    Vec2 across_x, across_y;  // N, pull on the right half across x = const, on the upper half across y = const
    double affine_error;      // largest distance from the affine displacement over the largest displacement
};

/// Outer discs prescribed affinely without rotation, inner ones solved for; forces through the middle of the lattice.
Section strained(int columns, int rows, double shear_share, const Strain& e) {
    const World world = lattice(columns, rows, shear_share);
    std::vector<Prescribed> held;
    const auto affine = [&](std::size_t b) {
        const BodyState& body = world.bodies[b];
        return Motion{e.xx * body.x + e.xy * body.y, e.xy * body.x + e.yy * body.y, 0.0};
    };
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const std::uint32_t bonds = world.body_begin[b + 1] - world.body_begin[b];
        if (bonds < 6) held.push_back({static_cast<BodyIndex>(b), affine(b)});
    }
    EXPECT_LT(held.size(), world.bodies.size() / 2);
    const ElasticSolution solution = solve_elastic(world, held);
    Section section{{}, {}, 0.0};
    double largest = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const Motion expected = affine(b), got = solution.displacement[b];
        largest = std::max({largest, std::abs(expected.x), std::abs(expected.y)});
        section.affine_error =
            std::max({section.affine_error, std::abs(got.x - expected.x), std::abs(got.y - expected.y)});
        if (shear_share > 0.0) section.affine_error = std::max(section.affine_error, radius * std::abs(got.rotation));
    }
    section.affine_error /= largest;  // without shear springs a disc turns freely, and its turn means nothing
    // Sections that pass between discs, not through centres.
    const double x = spacing * (0.5 * columns + 0.2), y = spacing * std::sqrt(3.0) * 0.5 * (0.5 * rows + 0.2);
    for (std::size_t k = 0; k < held.size(); ++k) {
        const Vec2 force{solution.reaction[k].x, solution.reaction[k].y};
        if (world.bodies[held[k].body].x > x) section.across_x = section.across_x + force;
        if (world.bodies[held[k].body].y > y) section.across_y = section.across_y + force;
    }
    return section;
}

/// Stress of the infinite lattice: two more rows, or one more column, add exactly their own share of the section force.
struct Stress {
    double xx, yy, xy;
};
Stress bulk_stress(double shear_share, const Strain& e, double& affine_error) {
    const Section small = strained(8, 9, shear_share, e);
    const Section tall = strained(8, 11, shear_share, e), wide = strained(9, 9, shear_share, e);
    affine_error = std::max({small.affine_error, tall.affine_error, wide.affine_error});
    const Vec2 fx = (1.0 / (std::sqrt(3.0) * spacing)) * (tall.across_x - small.across_x);
    const Vec2 fy = (1.0 / spacing) * (wide.across_y - small.across_y);
    EXPECT_NEAR(fx.y, fy.x, 1e-9 * kn * (std::abs(e.xx) + std::abs(e.yy) + std::abs(e.xy)));
    return {fx.x, fy.y, fx.y};
}

TEST(TriangularLattice, StiffnessIsExact) {
    for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        const double ks = share * kn;
        double error = 0.0, worst = 0.0;
        const Stress along = bulk_stress(share, {1e-4, 0.0, 0.0}, error);
        worst = std::max(worst, error);
        const Stress across = bulk_stress(share, {0.0, 1e-4, 0.0}, error);
        worst = std::max(worst, error);
        const Stress shear = bulk_stress(share, {0.0, 0.0, 1e-4}, error);
        worst = std::max(worst, error);
        const double c11 = along.xx / 1e-4, c12 = along.yy / 1e-4;
        const std::string label = fmt::format("k_s/k_n {}: ", share);
        EXPECT_TRUE(within(label + "inner discs move affinely", worst, 0.0, 1e-9));
        EXPECT_TRUE(agrees(label + "E/k_n", (c11 - c12 * c12 / c11) / kn,
                           2.0 * std::sqrt(3.0) * (kn + ks) / (3.0 * kn + ks), 1e-9));
        EXPECT_TRUE(within(label + "ν", c12 / c11, (kn - ks) / (3.0 * kn + ks), 1e-9));
        EXPECT_TRUE(agrees(label + "C22/k_n", across.yy / 1e-4 / kn, std::sqrt(3.0) / 4.0 * (3.0 + share), 1e-9));
        EXPECT_TRUE(agrees(label + "C33/k_n", shear.xy / 2e-4 / kn, std::sqrt(3.0) / 4.0 * (1.0 + share), 1e-9));
    }
}

/// Largest energy over the energy put in as random velocities, over many steps.
double growth(const World& start, double time_step) {
    World world = start;
    world.time_step = time_step;
    world.allow_unstable = true;
    const double energy = 1e-12;
    testing::shake(world, energy, 5);
    double largest = 0.0;
    for (int n = 0; n < 5000 && largest < 1e8; ++n) {
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        largest = std::max(largest, (ledger.kinetic + ledger.strain) / energy);
        advance(world);
    }
    return largest;
}

void check_critical_step(const std::string& name, const World& world, double closed_form_squared) {
    const double mass = world.inertia[0].mass;
    const double highest = testing::highest_frequency(world, testing::dense_stiffness(world, 2e-5));
    const double exact = 2.0 / highest, infinite = 2.0 / std::sqrt(closed_form_squared / mass);
    const double below = growth(world, 0.99 * exact), above = growth(world, 1.01 * exact);
    fmt::print(
        "  {}: closed form {:.6g} s, this specimen {:.6g} s, bound {:.6g} s ({:.4f} of it); energy grows by {:.2g} at "
        "0.99, {:.2g} at 1.01\n",
        name, infinite, exact, world.step_bound, world.step_bound / exact, below, above);
    EXPECT_LE(infinite, exact * (1.0 + 1e-6)) << name;
    EXPECT_GT(infinite, 0.98 * exact) << name;
    EXPECT_LE(world.step_bound, exact * (1.0 + 1e-9)) << name;
    EXPECT_LT(below, 100.0) << name;
    EXPECT_GE(above, 1e8) << name;
}

TEST(TriangularLattice, CriticalStepIsTheClosedFormAndTheBoundLiesBelow) {
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        const World world = lattice(14, 15, share, {false, false, false});
        const double ks = share * kn, lever = 1.0 - overlap / (2.0 * radius);
        const double shear = 24.0 * ks * lever * lever;
        check_critical_step(fmt::format("triangular, k_s/k_n {}", share), world, std::max(6.0 * kn + 2.0 * ks, shear));
        // Doubled blocks of a disc with six neighbours: 6(k_n + k_s) for its shift, 24 k_s for its turn.
        const double doubled = 2.0 * std::sqrt(world.inertia[0].mass / std::max(6.0 * (kn + ks), shear));
        EXPECT_TRUE(agrees("bound from doubled blocks", world.step_bound, doubled, 1e-8));
    }
}

TEST(DiscChain, CriticalStepIsTheClosedForm) {
    for (const double share : {0.25, 1.0}) {
        Scene scene = disc_chain(40, radius, spacing, rock(45.0, share));
        World world = build_world(std::move(scene));
        bond_all(world, 0.0);
        const double lever = 1.0 - overlap / (2.0 * radius);
        // Turning and sliding across couple at general wavelengths; the closed form takes the purely turning one.
        check_critical_step(fmt::format("chain, k_s/k_n {}", share), world,
                            std::max(4.0 * kn, 8.0 * share * kn * lever * lever));
    }
}

TEST(DiscChain, PulledBreaksAtItsBackTension) {
    // The guide's chain: r 1.1, spacing 2.0, k_n 1e8 give 2e7.
    Material material = rock();
    material.normal_stiffness = 1e8;
    material.shear_stiffness = 2.5e7;
    material.damping_ratio = 0.5;
    Scene scene = disc_chain(20, 1.1, 2.0, material);
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({0, held, held, held, 0});
    scene.controls.push_back({19, {Drive::velocity, 0.02}, held, held, 0});
    for (std::size_t k = 1; k < 19; ++k) scene.bodies[k].velocity = {0.02 * static_cast<double>(k) / 19.0, 0.0};
    World world = build_world(std::move(scene));
    EXPECT_EQ(bond_all(world, 0.0), 19);
    const BodyIndex fixed = body_of_id(world, 1), pulled = body_of_id(world, 20);
    double pull = 0.0, hold = 0.0;
    while (world.bonds_broken == 0 && world.time < 400.0) {
        compute_forces(world);
        if (world.bonds_broken > 0) break;
        pull = -world.forces[pulled].fx;
        hold = world.forces[fixed].fx;
        advance(world);
    }
    ASSERT_GT(world.bonds_broken, 0);
    EXPECT_TRUE(agrees("pull when the first bond breaks, N", pull, 2e7, 1e-3));
    EXPECT_TRUE(agrees("hold at the other end, N", hold, 2e7, 1e-3));
    EXPECT_TRUE(agrees("strength of the event, N", world.events.at(0).strength, 2e7, 1e-9));
    EXPECT_TRUE(agrees("energy of the event, J", world.events.at(0).energy, 0.5 * 1e8 * 0.04, 2e-3));
    EXPECT_FALSE(world.events.at(0).shear_mode);
    EXPECT_TRUE(
        within("extension when it breaks, m", world.bodies[pulled].x - world.bodies[fixed].x - 38.0, 19 * 0.2, 0.01));
}

TEST(DiscChain, WavesHaveTheDispersionOfMassesOnSprings) {
    const int count = 33;  // 31 free discs between two fixed ones
    for (const int mode : {1, 2, 5, 11, 21, 31}) {
        Scene scene = disc_chain(count, radius, spacing, rock());
        const DofControl held{Drive::velocity, 0.0};
        scene.controls.push_back({0, held, held, held, 0});
        scene.controls.push_back({count - 1, held, held, held, 0});
        const double q = std::numbers::pi * mode / (count - 1);  // times d
        const double mass = mass_properties(scene, scene.bodies[0]).mass;
        const double omega = 2.0 * std::sqrt(kn / mass) * std::abs(std::sin(0.5 * q));
        const double speed = 1e-7 * omega;
        for (int k = 1; k + 1 < count; ++k)
            scene.bodies[static_cast<std::size_t>(k)].velocity.x = speed * std::sin(q * k);
        scene.time_step = 0.05 * std::sqrt(mass / kn);
        World world = build_world(std::move(scene));
        bond_all(world, 0.0);
        const BodyIndex watched =
            body_of_id(world, 1 + std::max(1, static_cast<int>(std::lround(0.5 * (count - 1) / mode))));
        const double rest = world.bodies[watched].x;
        // Period from the zero crossings of one disc, over 20 of them.
        double first = 0.0, last = 0.0, before = 0.0;
        int crossings = 0;
        while (crossings < 41) {
            step(world);
            const double now = world.bodies[watched].x - rest;
            if (before != 0.0 && (now > 0.0) != (before > 0.0)) {
                last = world.time - world.time_step * now / (now - before);
                if (crossings == 0) first = last;
                ++crossings;
            }
            before = now;
        }
        const double measured = std::numbers::pi * 40.0 / (last - first);
        // Leapfrog turns ω into (2/Δt) asin(ωΔt/2).
        const double stepped = 2.0 / world.time_step * std::asin(0.5 * omega * world.time_step);
        EXPECT_TRUE(agrees(fmt::format("mode {}: ω, leapfrog's own shift counted", mode), measured, stepped, 1e-5));
        EXPECT_TRUE(agrees(fmt::format("mode {}: ω", mode), measured, omega, 5e-4));
    }
}

}  // namespace
}  // namespace crackle
