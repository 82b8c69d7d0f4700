// SPDX-License-Identifier: GPL-3.0-or-later
// Small-strain stiffness of a specimen: the sparse solve against slow runs, and against the affine bound.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/elastic.hpp"
#include "specimens/verification/between_platens.hpp"
#include "specimens/verification/groups.hpp"
#include "specimens/verification/packed_case.hpp"
#include "specimens/verification/rows.hpp"
#include "specimens/virtual_test.hpp"

namespace crackle::verification {
namespace {

constexpr const char* group = "Specimens";

/// Force on the platens over the displacement of the upper one, N/m.
struct Stiffness {
    double solved, run;
    std::int64_t broken;
};
Stiffness stiffness_of(Kind kind, double sense, double strain, double duration) {
    const double height = between_platens(kind, 0.0, {true, true, true}).height;
    LoadedSpecimen loaded = between_platens(kind, sense * strain * height / duration, {true, true, true});
    World& world = loaded.world;
    const ElasticSolution solution =
        solve_elastic(world, {{loaded.low, {0.0, 0.0, 0.0}}, {loaded.high, {0.0, 1.0, 0.0}}});
    // Mean of both platens over the last fifth, against the mean displacement there.
    const double start = world.bodies[loaded.high].y;
    double force = 0.0, way = 0.0;
    while (world.time < duration) {
        compute_forces(world);
        if (world.time > 0.8 * duration) {
            force += 0.5 * (world.forces[loaded.low].fy - world.forces[loaded.high].fy);
            way += world.bodies[loaded.high].y - start;
        }
        advance(world);
    }
    return {solution.reaction[1].y, force / way, world.bonds_broken};
}

std::vector<ClaimRow> slow_run_measures_the_stiffness_of_the_sparse_solve() {
    Rows rows;
    // Half a second is many times a wave's way there and back, some 0.01 s.
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        for (const double sense : {-1.0, 1.0}) {
            const Stiffness got = stiffness_of(kind, sense, 1e-4, 0.5);
            const std::string name = fmt::format("{} {}", name_of(kind), sense > 0.0 ? "pulled" : "squeezed");
            rows.relative(name + ", strain 1e-4: platen force over displacement, N/m", got.run, got.solved, 5e-3,
                          "reference");
            rows.exactly(name + ": bonds broken", static_cast<double>(got.broken), 0.0);
        }
    }
    for (const double sense : {-1.0, 1.0}) {
        // At ten times the strain that breaks bonds the intact specimen is still linear up to its change of shape.
        const Stiffness got = stiffness_of(Kind::discs, sense, 1e-2, 0.5);
        rows.relative(fmt::format("discs {}, strain 1e-2: platen force over displacement, N/m",
                                  sense > 0.0 ? "pulled" : "squeezed"),
                      got.run, got.solved, 1e-2, "change of shape");
    }
    return rows.take();
}

/// The least energy of u = (a x, ε y) without rotation over all bonds, as a modulus. With platens at their own place
/// (held laterally) it is admissible, so the true energy lies below, whatever the fabric. x from the domain's middle.
double affine_modulus(const VirtualTest& test) {
    const World& world = test.world;
    const auto face = [&](BodyIndex platen) { return element_positions(world, platen)[0].y; };
    const auto place = [&](BodyIndex b) {
        if (test.setup.is_platen(b)) return Vec2{0.0, face(b)};
        return Vec2{world.bodies[b].x - world.bodies[test.setup.bottom].x, world.bodies[b].y};
    };
    double aa = 0.0, ae = 0.0, ee = 0.0;  // energy ½(aa a² + 2 ae aε + ee ε²)
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if (!view.bonded) continue;
        const Vec2 between = place(view.body_i) - place(view.body_j), tangent = perpendicular(view.normal);
        const Vec2 x{between.x, 0.0}, y{0.0, between.y};
        const auto add = [&](double stiffness, Vec2 direction) {
            aa += stiffness * dot(x, direction) * dot(x, direction);
            ae += stiffness * dot(x, direction) * dot(y, direction);
            ee += stiffness * dot(y, direction) * dot(y, direction);
        };
        add(view.normal_stiffness, view.normal);
        add(view.shear_stiffness, tangent);
    }
    const double twice_energy = ee - ae * ae / aa, rise = face(test.setup.top) - face(test.setup.bottom);
    // Energy ½ R D with R = E W D/H.
    return twice_energy * test.setup.height / (test.setup.width * rise * rise);
}

std::vector<ClaimRow> modulus_lies_below_the_affine_bound() {
    Rows rows;
    double mean = 0.0;
    constexpr int packings = 20;
    for (int seed = 1; seed <= packings; ++seed) {
        const VirtualTest test = prepare_test(packed_case(seed, "tension", 0.01, 0.01));
        const double ratio = test.state.youngs_modulus / affine_modulus(test);
        mean += ratio / packings;
        rows.at_most(fmt::format("packing {}: E over its affine bound", seed), ratio, 1.0, "rigorous");
    }
    rows.shown("mean ratio", mean);
    return rows.take();
}

}  // namespace

std::vector<Claim> stiffness_claims() {
    return {
        {.name = "slow_run_measures_the_stiffness_of_the_sparse_solve",
         .group = group,
         .statement =
             "with bonds that neither break nor slip, platen force over displacement of a slow run is the sparse "
             "solve's",
         .check = slow_run_measures_the_stiffness_of_the_sparse_solve,
         .slow = true},
        {.name = "modulus_lies_below_the_affine_bound",
         .group = group,
         .statement = "E ≤ the least energy of u = (a x, ε y) without rotation, over a, platen bonds included",
         .check = modulus_lies_below_the_affine_bound,
         .slow = true,
         .note =
             "Circle packings of 120 circles between bonded platens; any admissible motion stores at least the true "
             "energy, so no tolerance is needed."},
    };
}

}  // namespace crackle::verification
