// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of stress.hpp. All are generated from a seed, so that they are the same on every machine.
// Tested by tests/verification/claims_test.cpp.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/measure/health.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/assembly/stress.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

constexpr double size = 0.04;  // m, size of an ordinary body

enum class Shape { disc, polygon, needle };

/// Bodies on a grid, far enough apart not to touch, with random shapes, rotations, velocities and spins.
struct Box {
    Shape shape = Shape::disc;
    int columns = 6, rows = 6;
    std::vector<Material> materials{rock()};  // assigned to the bodies in turn
    double thick = 1e-3;
    double smallest = 0.5;  // relative sizes are between this value and 1
    double speed = 1.0;     // m/s
    double room = 1.2;      // grid spacing relative to the space that the largest body needs
    std::uint64_t seed = 1;
};

Material damped_rock() {
    Material material = rock();
    material.damping_ratio = 0.2;
    return material;
}

std::vector<Vec2> outline(Shape shape, double reach, Vec2 centre, std::mt19937_64& generator) {
    const double turn = 2.0 * std::numbers::pi * uniform_number(generator);
    const auto at = [&](double x, double y) {
        return centre + Vec2{std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y};
    };
    if (shape == Shape::needle) {  // rectangles and triangles, a thousand times as long as wide
        const double half = 1e-3 * reach;
        if (uniform_number(generator) < 0.5)
            return {at(-reach, -half), at(reach, -half), at(reach, half), at(-reach, half)};
        return {at(-reach, -half), at(reach, 0.0), at(-reach, half)};
    }
    // Corners on a circle at irregular angles: convex, sometimes with a short edge.
    const int corners = 3 + static_cast<int>(5.0 * uniform_number(generator));
    std::vector<Vec2> result;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.9 * uniform_number(generator)) / corners;
        result.push_back(at(reach * std::cos(angle), reach * std::sin(angle)));
    }
    return result;
}

World build(const Box& box) {
    Scene scene;
    std::mt19937_64 generator(box.seed);
    scene.materials = box.materials;
    scene.thick = box.shape == Shape::disc ? 0.0 : box.thick;
    const double spacing = box.room * (size + 2.0 * scene.thick);
    scene.domain = {0.0, spacing * box.columns, 0.0, 2.0 * spacing * box.rows, {true, true, true, true}};
    scene.gravity = {0.0, -9.81};
    for (int k = 0; k < box.columns * box.rows; ++k) {
        const int row = k / box.columns, column = k % box.columns;
        const Vec2 centre{spacing * (column + 0.5), spacing * (row + 0.5)};
        // The logarithm of the size is uniformly distributed, so that all decades occur.
        const double reach = 0.5 * size * std::pow(box.smallest, uniform_number(generator));
        const int material = k % static_cast<int>(box.materials.size());
        if (box.shape == Shape::disc) {
            scene.add_circle_body(k + 1, material, {centre, reach, 0.0});
        } else {
            scene.add_chain_body(k + 1, material, outline(box.shape, reach, centre, generator), true);
        }
        Body& body = scene.bodies.back();
        body.velocity = {box.speed * (2.0 * uniform_number(generator) - 1.0),
                         box.speed * (2.0 * uniform_number(generator) - 1.0)};
        body.spin = box.speed / size * (2.0 * uniform_number(generator) - 1.0);
    }
    scene.safety_factor = 0.9 * loose_step_share;
    return build_world(std::move(scene));
}

/// A rock so stiff that no fall presses a corner past the far side of another body. If the thickness is very small,
/// a corner that hits a corner sinks in by the depth of the impact, which is a millimetre for the ordinary rock.
Material hard_rock() {
    Material hard = damped_rock();
    hard.normal_stiffness *= 100.0, hard.shear_stiffness *= 100.0;
    return hard;
}

/// A stiff and a soft material, whose k_n differ by a factor of a million.
std::vector<Material> hard_and_soft() {
    Material hard = damped_rock(), soft = damped_rock();
    soft.normal_stiffness = 1e5, soft.shear_stiffness = 2.5e4;
    hard.normal_stiffness = 1e11, hard.shear_stiffness = 2.5e10;
    return {soft, hard};
}

/// Two materials whose densities differ by a factor of a million.
std::vector<Material> heavy_and_light() {
    Material heavy = damped_rock(), light = damped_rock();
    heavy.density = 2.5e5, light.density = 0.25;
    return {light, heavy};
}

/// A body placed on bodies with a thousandth of its size and a millionth of its mass.
World large_on_small(Shape shape) {
    Scene scene;
    std::mt19937_64 generator(1);
    scene.materials = {damped_rock()};
    constexpr double small = 1e-3 * size;
    scene.thick = shape == Shape::disc ? 0.0 : 0.1 * small;
    const double spacing = 1.1 * (small + 2.0 * scene.thick);
    scene.domain = {-size, size, 0.0, 2.0 * size, {true, true, true, true}};
    scene.gravity = {0.0, -9.81};
    const auto add = [&](int id, double reach, Vec2 centre) {
        if (shape == Shape::disc) {
            scene.add_circle_body(id, 0, {centre, reach, 0.0});
        } else {
            const auto at = [&](double x, double y) { return centre + Vec2{reach * x, reach * y}; };
            scene.add_chain_body(id, 0, {at(-1.0, -1.0), at(1.0, -1.0), at(0.9, 1.0), at(-0.8, 1.0)}, true);
        }
    };
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) add(k + 1, 0.5 * small, {spacing * (k - 0.5 * (count - 1)), 0.5 * small});
    add(count + 1, 0.5 * size, {0.0, 1.01 * (small + scene.thick) + 0.5 * size});
    scene.bodies.back().velocity = {0.0, -0.01};  // compresses the small bodies by an eighth of their 40 µm
    scene.safety_factor = 0.9 * loose_step_share;
    return build_world(std::move(scene));
}

}  // namespace

const std::vector<StressScene>& stress_scenes() {
    static const std::vector<StressScene> all{
        {"discs", [] { return build({.materials = {damped_rock()}}); }},
        {"discs, undamped", [] { return build({.seed = 2}); }},
        {"polygons", [] { return build({.shape = Shape::polygon, .materials = {damped_rock()}}); }},
        {"polygons, undamped", [] { return build({.shape = Shape::polygon, .seed = 2}); }},
        {"discs, stiffness 1 to 1e6",
         [] { return build({.materials = hard_and_soft(), .smallest = 0.98, .speed = 2.0, .room = 1.0}); }},
        {"polygons, stiffness 1 to 1e6",
         [] {
             return build(
                 {.shape = Shape::polygon, .materials = hard_and_soft(), .smallest = 0.98, .speed = 2.0, .room = 1.0});
         }},
        {"discs, density 1 to 1e6",
         [] { return build({.materials = heavy_and_light(), .smallest = 0.98, .room = 1.0}); }},
        {"polygons, density 1 to 1e6",
         [] {
             return build({.shape = Shape::polygon, .materials = heavy_and_light(), .smallest = 0.98, .room = 1.0});
         }},
        {"disc on discs of a thousandth", [] { return large_on_small(Shape::disc); }},
        {"polygon on polygons of a thousandth", [] { return large_on_small(Shape::polygon); }},
        {"polygons, thickness 1e-4 of the size",
         [] { return build({.shape = Shape::polygon, .materials = {hard_rock()}, .thick = 1e-4 * size}); }},
        {"polygons, thickness half the size",
         [] { return build({.shape = Shape::polygon, .materials = {damped_rock()}, .thick = 0.5 * size}); }},
        {"needles of 1 to 1000",
         [] { return build({.shape = Shape::needle, .materials = {damped_rock()}, .thick = 1e-4, .room = 0.7}); }},
        {"3000 discs dropped at once",
         [] { return build({.columns = 60, .rows = 50, .materials = {damped_rock()}, .room = 1.0}); }},
        {"1000 polygons dropped at once",
         [] {
             return build(
                 {.shape = Shape::polygon, .columns = 40, .rows = 25, .materials = {damped_rock()}, .room = 1.0});
         }},
    };
    return all;
}

Endured endure(World& world, std::int64_t steps, int interval) {
    Endured result;
    double turned_over = 0.0, open = 0.0;
    try {
        for (; result.steps < steps; ++result.steps) {
            compute_forces(world);
            if (result.steps % interval == 0) {
                check_health(world);
                const Ledger l = measure_ledger(world);
                turned_over = std::max(turned_over, l.kinetic + l.strain + l.dashpot_loss + l.friction_loss);
                open = std::max(open, std::abs(l.closing_error));
                if (!std::isfinite(l.kinetic + l.strain + l.closing_error)) {
                    open = std::numeric_limits<double>::infinity();  // a failure without a report
                    break;
                }
            }
            advance(world);
        }
    } catch (const UnstableRun& error) {
        result.error = error.what();
    }
    result.closing_error = open / turned_over;
    return result;
}

}  // namespace crackle::verification
