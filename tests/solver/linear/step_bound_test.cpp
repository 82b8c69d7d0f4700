// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the bound on the stable step, updated while a bonded world moves, is always below the exact limit. This
// must hold for any initial weights and any number of points that begin to carry load at once.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "solver/linear/critical_step.hpp"
#include "solver/linear/lanczos_bound.hpp"
#include "solver/linear/step_bound.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/disordered.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using verification::rock;

/// Ratio of the bound to the exact limit for the points that touch now; at most 1.
double share_of_exact(World& world) {
    compute_forces(world);
    return world.stepping.step_bound / critical_step(world, ClosedPoints::touching).root;
}

TEST(StepBound, StaysBelowTheExactLimitWhileBondsBreakAndContactsCome) {
    Material material = rock();
    material.damping_ratio = 0.1;
    DisorderedDiscs discs;
    discs.columns = discs.rows = 10;
    ShakenCells cells;
    cells.columns = cells.rows = 6;
    for (const bool polygons : {false, true}) {
        Scene scene = polygons ? shaken_cells(cells, material) : disordered_discs(discs, material);
        World world = build_world(std::move(scene));
        bond_all(world, polygons ? 1.5 * world.settings.thick : 0.0);
        verification::shake(world, 1.0 * verification::breaking_energy(world), 3);
        double largest = 0.0, smallest = 1.0;
        for (int look = 0; look < 60; ++look) {
            const double share = share_of_exact(world);
            largest = std::max(largest, share);
            smallest = std::min(smallest, share);
            for (int n = 0; n < 40; ++n) step(world);
        }
        fmt::print("  {}: bound over exact limit {:.4f} to {:.4f}; {} lists, {} bonds broken\n",
                   polygons ? "polygons" : "discs", smallest, largest, world.list.builds, world.bonds.broken);
        EXPECT_LE(largest, 1.0);
        EXPECT_GT(smallest, 0.3);
        EXPECT_GT(world.list.builds, 5);
        EXPECT_GT(world.bonds.broken, 5);
    }
}

TEST(StepBound, CountsAHundredContactsThatCloseAtOnce) {
    // Two bonded columns side by side, one of which is thrown at the other. It has light discs at one end, which limit
    // the step; they are the first or the last to be counted.
    const double radius = 0.02, overlap = 8e-5, gap = 1e-5;
    const int rows = 100, light = 10;
    for (const bool at_top : {false, true}) {
        Scene scene = square_lattice(1, rows, radius, overlap, rock());
        scene.materials.push_back(rock());
        scene.materials[1].density *= 0.5;
        const double spacing = 2.0 * radius - overlap;
        for (int row = 0; row < rows; ++row) {
            const bool is_light = at_top ? row >= rows - light : row < light;
            scene.add_circle_body(rows + row + 1, is_light ? 1 : 0, {{2.0 * radius + gap, spacing * row}, radius, 0.0});
        }
        for (std::size_t b = rows; b < scene.bodies.size(); ++b) scene.bodies[b].velocity = {-0.5, 0.0};
        World world = build_world(std::move(scene));
        bond_all(world, 0.0);
        const double before = share_of_exact(world);
        const auto touching = [&] {
            return std::count_if(world.points.state.begin(), world.points.state.end(),
                                 [](const PointState& state) { return (state.flags & point_touching) != 0; });
        };
        const auto bonded = touching();
        const std::int64_t built = world.list.builds;
        for (int n = 0; n < 1000 && touching() == bonded; ++n) {
            step(world);
            compute_forces(world);
        }
        const auto gained = touching() - bonded;
        step(world);  // new points are counted before the next force pass
        const double after = share_of_exact(world);
        fmt::print("  {} contacts at once: bound over exact limit {:.4f} before, {:.4f} after\n", gained, before,
                   after);
        EXPECT_EQ(gained, rows);
        EXPECT_EQ(world.list.builds, built) << "the list was rebuilt, so this shows nothing";
        EXPECT_LE(before, 1.0);
        EXPECT_LE(after, 1.0);
        EXPECT_GT(after, 0.3);
    }
}

TEST(CriticalStep, WithDashpotsIsProvedBelowItsRootAndDisprovedAbove) {
    for (const double ratio : {0.0, 0.2, 0.7}) {
        Material material = rock();
        material.damping_ratio = ratio;
        World world = build_world(square_lattice(6, 8, 0.02, 8e-5, material));
        bond_all(world, 0.0);
        compute_forces(world);
        const CriticalStep exact = critical_step(world, ClosedPoints::touching);
        EXPECT_TRUE(exact.proved) << ratio;
        EXPECT_TRUE(stable_at(world, ClosedPoints::touching, 0.999 * exact.root)) << ratio;
        EXPECT_FALSE(stable_at(world, ClosedPoints::touching, 1.001 * exact.root)) << ratio;
    }
}

/// Compares the limit by factorisation with the method for worlds that are too large for it, with and without dashpots.
TEST(LanczosBound, LiesWithinTwoPerCentBelowTheExactLimit) {
    for (const double ratio : {0.0, 0.2, 0.7}) {
        for (const bool polygons : {false, true}) {
            Material material = rock();
            material.damping_ratio = ratio;
            DisorderedDiscs discs;
            discs.columns = 40, discs.rows = 60;
            ShakenCells cells;
            cells.columns = cells.rows = 20;
            World world = build_world(polygons ? shaken_cells(cells, material) : disordered_discs(discs, material));
            bond_all(world, polygons ? 1.5 * world.settings.thick : 0.0);
            compute_forces(world);
            const ClosedPoints which = ClosedPoints::touching;
            const double exact = critical_step(world, ClosedPoints::touching).root;
            const double found = lanczos_step(world, which, stable_step_bound(world));
            fmt::print("  {}, damping ratio {}: expected 0.98 to 1 of {:.6g} s, got {:.6g} s, {:.4f} of it\n",
                       polygons ? "polygons" : "discs", ratio, exact, found, found / exact);
            EXPECT_LE(found, exact);
            EXPECT_GE(found, 0.98 * exact);
            EXPECT_TRUE(lanczos_finds_stable(world, which, 0.97 * exact));
            EXPECT_FALSE(lanczos_finds_stable(world, which, 1.001 * exact));
        }
    }
}

TEST(LanczosBound, OfLooseBodiesIsInfinite) {
    Scene scene = square_lattice(5, 5, 0.02, -1e-3, rock());
    World world = build_world(std::move(scene));
    compute_forces(world);
    EXPECT_EQ(lanczos_step(world, ClosedPoints::touching, 1e-5), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace crackle
