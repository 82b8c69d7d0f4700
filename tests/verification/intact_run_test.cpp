// SPDX-License-Identifier: GPL-3.0-or-later
// With breaking, sliding and new contacts switched off, a slow run between platens measures the stiffness that the
// sparse solve finds at once.

#include <cmath>
#include <functional>

#include "solver/elastic.hpp"
#include "specimens/catalogue/disordered.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/measures.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::rock;

struct Setup {
    Scene scene;
    double bond_thick;  // m
    double height;      // m, between the platens
};

constexpr int lower = 9001, upper = 9002;

/// Specimen between two flat segments, both held laterally and in rotation, the upper one moving at a constant speed.
Setup between_platens(Scene scene, double bottom, double top, double bond_thick, double speed) {
    scene.add_chain_body(lower, 0, {{-0.1, bottom}, {0.6, bottom}}, false);
    scene.add_chain_body(upper, 0, {{-0.1, top}, {0.6, top}}, false);
    const auto count = static_cast<int>(scene.bodies.size());
    const DofControl held{Drive::velocity, 0.0};
    scene.controls.push_back({count - 2, held, held, held, 0});
    scene.controls.push_back({count - 1, held, {Drive::velocity, speed}, held, 0});
    scene.intact = {true, true, true};
    scene.materials[0].damping_ratio = 0.2;
    return {scene, bond_thick, top - bottom};
}

Setup discs(double speed) {
    DisorderedDiscs request;
    request.columns = 8, request.rows = 12, request.mean_overlap = 2e-4;
    Scene scene = disordered_discs(request, rock());
    scene.thick = 1e-3;
    const double reach = 0.02 + scene.thick - 2e-4;  // platens overlap the end rows as much as discs each other
    return between_platens(scene, -reach, 11.0 * (0.04 - 2e-4) * 0.5 * std::sqrt(3.0) + reach, 1e-3, speed);
}

Setup cells(double speed) {
    ShakenCells request;
    request.columns = 5, request.rows = 8, request.flat_ends = true;
    return between_platens(shaken_cells(request, rock()), -0.5e-3, 8 * 0.04 + 0.5e-3, 1.08e-3, speed);
}

/// Force on the upper platen over its displacement, N/m: by the solve, and by a run that ends at `strain`.
void compare(const char* name, const std::function<Setup(double)>& make, double strain) {
    const double duration = 0.5;  // many times a wave's way there and back
    const double height = make(0.0).height, speed = strain * height / duration;
    for (const double sense : {-1.0, 1.0}) {
        Setup setup = make(sense * speed);
        World world = build_world(setup.scene);
        ASSERT_GT(bond_all(world, setup.bond_thick), 0);
        const BodyIndex low = body_of_id(world, lower), high = body_of_id(world, upper);
        const double start = world.bodies[high].y;
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            if (b == low || b == high) continue;
            world.bodies[b].vy = sense * speed * (world.bodies[b].y - world.bodies[low].y) / height;
        }
        const ElasticSolution solution = solve_elastic(world, {{low, {0.0, 0.0, 0.0}}, {high, {0.0, 1.0, 0.0}}});
        // Mean of both platens over the last fifth, against the mean displacement there.
        double force = 0.0, way = 0.0;
        while (world.time < duration) {
            compute_forces(world);
            if (world.time > 0.8 * duration) {
                force += 0.5 * (world.forces[low].fy - world.forces[high].fy);
                way += world.bodies[high].y - start;
            }
            advance(world);
        }
        EXPECT_EQ(world.bonds_broken, 0);
        EXPECT_TRUE(agrees(fmt::format("{} {}: platen force over displacement, N/m, {} bonds", name,
                                       sense > 0.0 ? "pulled" : "squeezed", world.bonds_initial),
                           force / way, solution.reaction[1].y, 5e-3));
    }
}

TEST(IntactRun, MeasuresTheStiffnessOfTheSparseSolveForDiscs) { compare("discs", discs, 1e-4); }

TEST(IntactRun, MeasuresTheStiffnessOfTheSparseSolveForPolygons) { compare("polygons", cells, 1e-4); }

TEST(IntactRun, HoldsFarBeyondTheStrengthOfItsBonds) {
    // At ten times the strain that breaks bonds the intact specimen is still linear up to its change of shape.
    compare("discs, strained by 1 %", discs, 1e-2);
}

}  // namespace
}  // namespace crackle
