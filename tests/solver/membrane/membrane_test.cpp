// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a membrane around bonded discs and cells: it only presses, its work is pressure times lost area, and it adapts
// when fragments break off.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/membrane/press.hpp"
#include "solver/membrane/wrap.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/same_bytes.hpp"

namespace crackle::membrane_test {
namespace {

using testing::agrees;
using testing::within;

constexpr double pressure = 2e3;  // N/m, about 1e-3 of what the springs withstand

Scene disc_square() {
    DisorderedDiscs request;
    request.columns = 10, request.rows = 10;
    Material material = verification::rock();
    material.damping_ratio = 0.2;
    Scene scene = disordered_discs(request, material);
    scene.domain.wall_present = {false, false, false, false};
    return scene;
}

Scene turned_by(Scene scene, double angle) {
    const Vec2 turn{std::cos(angle), std::sin(angle)};
    const auto rotate = [&](Vec2& at) { at = {turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y}; };
    for (CircleElement& circle : scene.circles) rotate(circle.centre);
    for (Vec2& vertex : scene.vertices) rotate(vertex);
    return scene;
}

World bonded(const Scene& scene, double thick = 0.0) {
    World world = build_world(scene);
    bond_all(world, thick);
    return world;
}

double mean_radius(const World& world) {
    double sum = 0.0;
    for (const BodyState& body : world.bodies.state) sum += body.shape[0];
    return sum / static_cast<double>(world.bodies.size());
}

std::vector<BodyForce> membrane_forces(const World& world) {
    std::vector<BodyForce> forces;
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) forces.push_back(membrane_force_on(world, b));
    return forces;
}

BodyForce resultant(const World& world) {
    BodyForce sum{};
    const std::vector<BodyForce> forces = membrane_forces(world);
    for (std::size_t b = 0; b < forces.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        sum.fx += forces[b].fx;
        sum.fy += forces[b].fy;
        sum.torque += forces[b].torque + body.x * forces[b].fy - body.y * forces[b].fx;
    }
    return sum;
}

Vec2 centroid(const World& world) {
    Vec2 sum{};
    double mass = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        sum = sum + world.bodies.inertia[b].mass * Vec2{world.bodies.state[b].x, world.bodies.state[b].y};
        mass += world.bodies.inertia[b].mass;
    }
    return (1.0 / mass) * sum;
}

TEST(Membrane, AloneLeavesABondedSquareInItsPlaceHoweverItIsTurned) {
    std::vector<double> lost;
    for (const double angle : {0.0, 0.3, 1.1, 0.5 * std::numbers::pi}) {
        World world = bonded(turned_by(disc_square(), angle));
        const Vec2 before = centroid(world);
        add_membrane(world, pressure, mean_radius(world));
        const double whole = membrane_area(world), side = std::sqrt(whole);
        const BodyForce sum = resultant(world);
        EXPECT_TRUE(
            within("resultant over p times a side", norm(Vec2{sum.fx, sum.fy}) / (pressure * side), 0.0, 1e-13));
        EXPECT_TRUE(within("moment over p times the area", sum.torque / (pressure * whole), 0.0, 1e-12));
        for (int n = 0; n < 20'000; ++n) step(world);
        compute_forces(world);
        const double moved = norm(centroid(world) - before);
        EXPECT_TRUE(within("centroid moved, of a side", moved / side, 0.0, 1e-12));
        lost.push_back((whole - membrane_area(world)) / whole);
        const Ledger ledger = measure_ledger(world);
        EXPECT_TRUE(within("kinetic energy over the membrane's work", ledger.kinetic / world.membrane.work, 0.0, 1e-9));
        // The chain is the same after each rebuild of the neighbour list.
        EXPECT_TRUE(within("jumps of the area, of it", world.membrane.jumped / whole, 0.0, 1e-14));
    }
    EXPECT_GT(lost.front(), 1e-6);
    for (const double one : lost) EXPECT_TRUE(agrees("share of the area lost, turned", one, lost.front(), 1e-6));
}

TEST(Membrane, WorkIsPressureTimesTheAreaLost) {
    World world = bonded(disc_square());
    add_membrane(world, pressure, mean_radius(world));
    const double whole = membrane_area(world);
    double by_forces = 0.0;  // J, trapezoidal rule over each drift
    for (int n = 0; n < 3000; ++n) {
        compute_forces(world);
        const std::vector<BodyForce> before = membrane_forces(world);
        const auto state = world.bodies.state;
        advance(world);
        const std::vector<BodyForce> after = membrane_forces(world);
        for (std::size_t b = 0; b < before.size(); ++b) {
            by_forces += 0.5 * ((before[b].fx + after[b].fx) * (world.bodies.state[b].x - state[b].x) +
                                (before[b].fy + after[b].fy) * (world.bodies.state[b].y - state[b].y));
        }
    }
    compute_forces(world);
    const double by_area = -pressure * (membrane_area(world) - whole);
    EXPECT_TRUE(agrees("work of the forces, J", by_forces, by_area, 1e-9));  // round-off of 3000 sums over 40 points
    EXPECT_TRUE(within("work accounted over that of the area", world.membrane.work / by_area, 1.0, 1e-12));
    const Ledger ledger = measure_ledger(world);
    EXPECT_EQ(ledger.force_work, world.membrane.work);
}

TEST(Membrane, EnergyClosesToTheSecondOrderOfTheStep) {
    std::vector<double> errors;
    for (const double scale : {1.0, 0.5, 0.25}) {
        Scene scene = disc_square();
        scene.step_scale = scale;
        World world = bonded(scene);
        add_membrane(world, pressure, mean_radius(world));  // applied suddenly, so everything oscillates
        for (int n = 0; n < static_cast<int>(1000.0 / scale); ++n) step(world);
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        EXPECT_EQ(ledger.force_work, world.membrane.work);
        errors.push_back(std::abs(ledger.closing_error / ledger.force_work));
    }
    const double order = std::log2(errors[1] / errors[2]);
    fmt::print("  closing error over the work: {:.3g}, {:.3g}, {:.3g}\n", errors[0], errors[1], errors[2]);
    EXPECT_TRUE(within("order of convergence", order, 2.0, 0.3));
    EXPECT_LT(errors[2], 1e-3);
}

TEST(Membrane, FollowsWhatComesOff) {
    World world = bonded(disc_square());
    add_membrane(world, pressure, mean_radius(world));
    const BodyIndex off = world.membrane.points[3].body;
    const double before = membrane_area(world);
    world.bodies.state[off].x -= 100.0;
    bodies_moved(world);
    world.membrane.known = false;  // the change of position did no work
    compute_forces(world);
    EXPECT_EQ(world.membrane.wrapped, 2);
    EXPECT_EQ(norm(Vec2{membrane_force_on(world, off).fx, membrane_force_on(world, off).fy}), 0.0)
        << "a particle that has left the specimen carries no load";
    for (const MembranePoint& point : world.membrane.points) EXPECT_NE(point.body, off);
    EXPECT_TRUE(agrees("area without one of a hundred discs, m2", membrane_area(world), before, 0.02));
    const BodyForce sum = resultant(world);
    EXPECT_TRUE(within("resultant over p", norm(Vec2{sum.fx, sum.fy}) / pressure, 0.0, 1e-12));
}

TEST(Membrane, JumpsOfTheAreaDoNoWork) {
    World world = bonded(disc_square());
    add_membrane(world, pressure, mean_radius(world));
    compute_forces(world);
    const double area = world.membrane.area;
    // Wrapped with a smaller disc, the membrane enters further between the same bodies.
    world.membrane.probe = 0.2 * mean_radius(world);
    world.membrane.parted = true;
    velocities_changed(world);
    compute_forces(world);
    EXPECT_EQ(world.membrane.work, 0.0);
    EXPECT_LE(world.membrane.jumped, 0.0);
    EXPECT_TRUE(within("area after less before, m2", world.membrane.area - area, world.membrane.jumped, 1e-15));
}

TEST(Membrane, OfPolygonsLiesOnTheirOutlinesAndTurnsThem) {
    ShakenCells request;
    request.columns = 8, request.rows = 8;
    Material material = verification::rock();
    material.damping_ratio = 0.2;
    const Scene scene = shaken_cells(request, material);
    double cells = 0.0;  // m²
    for (const Body& body : scene.bodies) cells += mass_properties(scene, body).mass / material.density;
    for (const double angle : {0.0, 0.7}) {
        World world = bonded(turned_by(scene, angle), 1.08e-3);
        const double size = std::sqrt(cells / static_cast<double>(scene.bodies.size()));
        add_membrane(world, pressure, 0.5 * size);
        // The membrane also encloses the gaps of the mesh, a fortieth of a cell's width, and dents in the irregular
        // sides, a fifth deep.
        EXPECT_GE(membrane_area(world), cells);
        EXPECT_LE(membrane_area(world), 1.1 * cells);
        const BodyForce sum = resultant(world);
        const double side = std::sqrt(cells);
        EXPECT_TRUE(
            within("resultant over p times a side", norm(Vec2{sum.fx, sum.fy}) / (pressure * side), 0.0, 1e-13));
        EXPECT_TRUE(within("moment over p times the area", sum.torque / (pressure * cells), 0.0, 1e-12));
        double torques = 0.0;
        for (const BodyForce& load : membrane_forces(world)) torques += std::abs(load.torque);
        EXPECT_GT(torques, 0.0);
        std::set<BodyIndex> touched;
        for (const MembranePoint& point : world.membrane.points) touched.insert(point.body);
        EXPECT_GE(touched.size(), 28u) << "the outer ones of eight by eight, some of them triangles";
        for (int n = 0; n < 2000; ++n) step(world);
        compute_forces(world);
        const Ledger ledger = measure_ledger(world);
        EXPECT_TRUE(within("closing error over the work", ledger.closing_error / ledger.force_work, 0.0, 1e-3));
    }
}

TEST(Membrane, SetsTheSameBytesOnAnyNumberOfThreads) {
    const auto pressed = [](int threads) {
        World world = bonded(disc_square());
        set_threads(world, threads);
        add_membrane(world, pressure, mean_radius(world));
        for (int n = 0; n < 500; ++n) step(world);
        compute_forces(world);
        return world;
    };
    const World one = pressed(1), other = pressed(3);
    testing::expect_same_run(one, other);
    EXPECT_EQ(one.membrane.work, other.membrane.work);
}

TEST(Membrane, NeedsBodiesToLieOn) {
    Scene scene = disc_square();
    scene.bodies.resize(1);
    scene.circles.resize(1);
    World world = build_world(scene);
    EXPECT_THROW(add_membrane(world, pressure, 0.01), InputError);
}

}  // namespace
}  // namespace crackle::membrane_test
