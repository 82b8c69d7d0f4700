// SPDX-License-Identifier: GPL-3.0-or-later
// Results do not depend on the order and ids of the bodies, the handedness and direction of the axes, or the units.
// Impacts with friction, dashpots, breaking bonds, gravity and walls are compared body by body.
// Tested by tests/verification/claims_test.cpp.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "solver/measure/ledger.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/disordered.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace invariance_scenes {
namespace {

/// Some bonded discs and some bonded polygons, in motion near two walls, with a driven disc.
Scene busy_scene() {
    Material material = rock();
    material.damping_ratio = 0.1;
    DisorderedDiscs discs;
    discs.columns = 4, discs.rows = 4, discs.shake = 5e-5;
    Scene scene = disordered_discs(discs, material);
    ShakenCells cells;
    cells.columns = 3, cells.rows = 3;
    const Scene other = shaken_cells(cells, material);
    scene.thick = other.thick;
    int id = 1000;
    for (const Body& body : other.bodies) {
        std::vector<Vec2> corners;
        for (std::uint32_t k = 0; k < body.vertex_count; ++k)
            corners.push_back(other.vertices[body.first_vertex + k] + Vec2{0.17, 0.013});
        scene.add_chain_body(++id, 0, corners, true);
    }
    for (Body& body : scene.bodies) {
        body.velocity = {body.vertex_count > 0 ? -0.3 : 0.2, 0.06 * std::sin(body.id)};
        body.spin = 0.5 * std::cos(body.id);
    }
    scene.controls.push_back({2, {Drive::velocity, 0.02}, {Drive::force, 30.0}, {}, 0});
    scene.gravity = {1.0, -9.81};
    scene.domain = {-0.0205, 0.7, -0.0205, 1.0, {true, true, true, true}};
    return scene;
}

struct Fate {
    Vec2 centre, velocity;
    double turn, spin;
};
struct Story {
    std::map<int, Fate> bodies;  // keyed by id
    double energy;               // kinetic and stored energy, J
    std::int64_t broken;
};

constexpr int story_steps = 800;

Story story_of(Scene scene, double time_step, double bond_thick) {
    scene.time_step = time_step;
    World world = build_world(std::move(scene));
    bond_all(world, bond_thick);
    std::vector<double> angles;
    angles.reserve(world.bodies.size());
    for (const BodyState& body : world.bodies.state) angles.push_back(body.angle);
    for (int n = 0; n < story_steps; ++n) step(world);
    compute_forces(world);
    Story story;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        story.bodies[world.bodies.info(b).id] = {
            {body.x, body.y}, {body.vx, body.vy}, body.angle - angles[b], body.omega};
    }
    const Ledger ledger = measure_ledger(world);
    story.energy = ledger.kinetic + ledger.strain;
    story.broken = world.bonds.broken;
    return story;
}

/// Largest difference from the reference run, relative to the scales, after `back` has transformed a result to the
/// reference axes and units.
double difference(
    const Story& plain, const Story& other, const std::function<Fate(const Fate&)>& back, double energy_unit,
    const std::function<int(int)>& id = [](int k) { return k; }) {
    double worst = 0.0, length = 0.0, speed = 0.0, turn = 0.0, spin = 0.0;
    for (const auto& [name, fate] : plain.bodies) {
        length = std::max(length, norm(fate.centre));
        speed = std::max(speed, norm(fate.velocity));
        turn = std::max(turn, std::abs(fate.turn));
        spin = std::max(spin, std::abs(fate.spin));
    }
    for (const auto& [name, fate] : plain.bodies) {
        const Fate got = back(other.bodies.at(id(name)));
        worst = std::max({worst, norm(got.centre - fate.centre) / length, norm(got.velocity - fate.velocity) / speed,
                          std::abs(got.turn - fate.turn) / turn, std::abs(got.spin - fate.spin) / spin});
    }
    if (plain.broken != other.broken) return std::numeric_limits<double>::infinity();
    return std::max(worst, std::abs(other.energy / energy_unit - plain.energy) / plain.energy);
}

constexpr double time_step = 2e-5, bond_thick = 1.08e-3;
constexpr auto same = [](const Fate& f) { return f; };

const Story& plain_story() {
    static const Story plain = story_of(busy_scene(), time_step, bond_thick);
    return plain;
}

void check(Rows& rows, const std::string& name, double off, double tolerance = 1e-9,
           const std::string& estimate = "reference") {
    rows.absolute(name, off, 0.0, tolerance, estimate);
}

/// The scene with every point, velocity and wall transformed by a rotation or reflection, and spins and moments
/// multiplied by its determinant.
Scene mapped(const Scene& scene, const std::function<Vec2(Vec2)>& map, double handedness) {
    Scene result = scene;
    for (CircleElement& c : result.circles) c.centre = map(c.centre);
    for (Vec2& v : result.vertices) v = map(v);
    for (Body& body : result.bodies) {
        body.velocity = map(body.velocity);
        body.spin *= handedness;
    }
    result.gravity = map(scene.gravity);
    const Vec2 a = map({scene.domain.x1, scene.domain.y1}), b = map({scene.domain.x2, scene.domain.y2});
    result.domain = {
        std::min(a.x, b.x), std::max(a.x, b.x), std::min(a.y, b.y), std::max(a.y, b.y), {true, true, true, true}};
    return result;
}

std::vector<ClaimRow> physics_does_not_depend_on_order_and_numbers() {
    Rows rows;
    const Scene scene = busy_scene();
    rows.at_least("bonds that break during the run", static_cast<double>(plain_story().broken), 6.0, "not tame");
    for (const std::uint64_t seed : {3u, 4u}) {
        std::mt19937_64 generator(seed);
        std::vector<std::size_t> order(scene.bodies.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        shuffle(order, generator);
        Scene other = scene;
        for (std::size_t k = 0; k < order.size(); ++k) {
            other.bodies[k] = scene.bodies[order[k]];
            other.bodies[k].id = 7 * other.bodies[k].id + 3;
            if (order[k] == 2) other.controls[0].body = static_cast<int>(k);
        }
        check(rows, "renumbered and reordered at random, largest difference over the scales",
              difference(plain_story(), story_of(other, time_step, bond_thick), same, 1.0,
                         [](int k) { return 7 * k + 3; }));
    }
    Scene swapped = scene;
    std::reverse(swapped.bodies.begin(), swapped.bodies.end());
    swapped.controls[0].body = static_cast<int>(scene.bodies.size()) - 1 - 2;
    check(rows, "all bodies in reverse order",
          difference(plain_story(), story_of(swapped, time_step, bond_thick), same, 1.0));
    Scene rotated = scene;
    for (const Body& body : rotated.bodies) {
        if (body.vertex_count == 0) continue;
        const auto first = rotated.vertices.begin() + body.first_vertex;
        std::rotate(first, first + 1, first + body.vertex_count);
    }
    check(rows, "outlines that start at their second corner",
          difference(plain_story(), story_of(rotated, time_step, bond_thick), same, 1.0));
    return rows.take();
}

/// Ids of the two bodies of every bonded point, as i and j.
std::set<std::pair<int, int>> roles_of(Scene scene) {
    scene.time_step = time_step;
    World world = build_world(std::move(scene));
    bond_all(world, bond_thick);
    std::set<std::pair<int, int>> roles;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        if ((world.points.state[k].flags & point_bonded) != 0)
            roles.emplace(world.bodies.info(point.body_i).id, world.bodies.info(point.body_j).id);
    }
    return roles;
}

/// Number of pairs whose first and second body are exchanged.
double traded(const Scene& scene, const Scene& other) {
    const auto plain = roles_of(scene), now = roles_of(other);
    return static_cast<double>(std::count_if(plain.begin(), plain.end(), [&](const std::pair<int, int>& pair) {
        return !now.contains(pair) && now.contains({pair.second, pair.first});
    }));
}

std::vector<ClaimRow> physics_does_not_depend_on_the_axes() {
    Rows rows;
    const Scene scene = busy_scene();
    const auto mirror = [](Vec2 v) { return Vec2{-v.x, v.y}; };
    Scene mirrored = mapped(scene, mirror, -1.0);
    mirrored.controls[0].x.value *= -1.0;
    check(rows, "mirrored, largest difference over the scales",
          difference(
              plain_story(), story_of(mirrored, time_step, bond_thick),
              [&](const Fate& f) {
                  return Fate{mirror(f.centre), mirror(f.velocity), -f.turn, -f.spin};
              },
              1.0));
    rows.at_least("bonded pairs with i and j exchanged", traded(scene, mirrored), 10.0, "swapped");
    Scene turned = mapped(
        scene, [](Vec2 v) { return perpendicular(v); }, 1.0);
    turned.controls[0].x = {Drive::force, -30.0};
    turned.controls[0].y = {Drive::velocity, 0.02};
    check(rows, "turned by 90 degrees",
          difference(
              plain_story(), story_of(turned, time_step, bond_thick),
              [](const Fate& f) {
                  return Fate{-perpendicular(f.centre), -perpendicular(f.velocity), f.turn, f.spin};
              },
              1.0));
    const Vec2 by{16.0, -8.0};
    Scene shifted = scene;
    for (CircleElement& c : shifted.circles) c.centre = c.centre + by;
    for (Vec2& v : shifted.vertices) v = v + by;
    shifted.domain.x1 += by.x, shifted.domain.x2 += by.x, shifted.domain.y1 += by.y, shifted.domain.y2 += by.y;
    // Coordinates of 16 m have two fewer digits than those of a few centimetres.
    check(rows, "shifted by 18 m",
          difference(
              plain_story(), story_of(shifted, time_step, bond_thick),
              [&](const Fate& f) {
                  return Fate{f.centre - by, f.velocity, f.turn, f.spin};
              },
              1.0),
          1e-7, "digits lost");
    return rows.take();
}

std::vector<ClaimRow> physics_does_not_depend_on_the_units() {
    Rows rows;
    // Per unit thickness: kg/m2 = 0.1 g/cm2, N/m = 1000 dyn/cm, N = 1e5 dyn, J = 1e7 erg.
    Scene scene = busy_scene();
    for (CircleElement& c : scene.circles) c.centre = 100.0 * c.centre, c.radius *= 100.0;
    for (Vec2& v : scene.vertices) v = 100.0 * v;
    for (Body& body : scene.bodies) body.velocity = 100.0 * body.velocity;
    for (Material& m : scene.materials) {
        m.density *= 0.1;
        m.normal_stiffness *= 1000.0;
        m.shear_stiffness *= 1000.0;
    }
    scene.domain.x1 *= 100.0, scene.domain.x2 *= 100.0, scene.domain.y1 *= 100.0, scene.domain.y2 *= 100.0;
    scene.gravity = 100.0 * scene.gravity;
    scene.thick *= 100.0;
    scene.controls[0].x.value *= 100.0;
    scene.controls[0].y.value *= 1e5;
    check(rows, "cgs against SI, largest difference over the scales",
          difference(
              plain_story(), story_of(scene, time_step, 100.0 * bond_thick),
              [](const Fate& f) {
                  return Fate{0.01 * f.centre, 0.01 * f.velocity, f.turn, f.spin};
              },
              1e7));
    return rows.take();
}

}  // namespace
}  // namespace invariance_scenes

std::vector<Claim> invariance_claims() {
    using namespace invariance_scenes;
    constexpr const char* group = "Conservation and symmetry";
    return {
        {.name = "physics_does_not_depend_on_order_and_numbers",
         .group = group,
         .statement = "results do not change by more than 1e-9 if bodies are renumbered or reordered, or outlines "
                      "start at another corner",
         .check = physics_does_not_depend_on_order_and_numbers,
         .note =
             "The engine numbers bodies by their positions, so the order of the input does not change a single bit."},
        {.name = "physics_does_not_depend_on_the_axes",
         .group = group,
         .statement = "results do not change by more than 1e-9 after swapping i and j, mirroring, rotating by 90 "
                      "degrees, or shifting (shifts: to the remaining digits)",
         .check = physics_does_not_depend_on_the_axes},
        {.name = "physics_does_not_depend_on_the_units",
         .group = group,
         .statement = "cgs = SI to 1e-9",
         .check = physics_does_not_depend_on_the_units},
    };
}

}  // namespace crackle::verification
