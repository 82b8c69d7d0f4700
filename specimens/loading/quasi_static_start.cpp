// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/quasi_static_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/linear/elastic.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/loading/displace.hpp"

namespace crackle {
namespace {

/// Motion of every body for an axial strain of 1 in the sense of the test.
std::vector<BodyMotion> elastic_motion(const VirtualTest& test, const std::vector<bool>& elastic) {
    const TestSetup& setup = test.setup;
    const World& world = test.world;
    const double sense = setup.compression ? -1.0 : 1.0;
    const double bottom = world.bodies.state[setup.bottom].y, height = world.bodies.state[setup.top].y - bottom;
    std::vector<BodyMotion> motion(world.bodies.size());
    for (std::size_t b = 0; b < motion.size(); ++b) {
        BodyMotion way{0.0, setup.height * (world.bodies.state[b].y - bottom) / height, 0.0};
        if (elastic[b]) way = test.small_strain->moduli.solution.displacement[b];
        if (b == setup.bottom) way = {};
        if (b == setup.top) way = {0.0, setup.height, 0.0};
        motion[b] = {sense * way.x, sense * way.y, sense * way.rotation};
    }
    return motion;
}

/// Moves the bodies by w (see the header), shear springs included, in one drift of the integrator without forces.
void settle_dashpots(World& world, const TestSetup& setup, const std::vector<bool>& elastic) {
    compute_forces(world);
    std::vector<BodyMotion> loads(world.bodies.size());
    for (std::size_t b = 0; b < loads.size(); ++b)
        if (elastic[b]) loads[b] = {world.bodies.force[b].fx, world.bodies.force[b].fy, world.bodies.force[b].torque};
    const ElasticSolution settled = solve_elastic(world, {{setup.bottom, {}}, {setup.top, {}}}, loads);
    displace(world, setup, settled.displacement);
}

}  // namespace

RateRule rate_rule_of(const VirtualTest& test, double tolerance) {
    if (!test.small_strain || !(test.small_strain->moduli.youngs_modulus > 0.0)) {
        throw InputError(fmt::format(
            "{}: expected an elastic solution to derive the rate from, or axial_strain_rate in its place: {}",
            test.description.at("loading.rate_tolerance"),
            test.small_strain ? "the specimen has no stiffness" : test.no_small_strain));
    }
    const TestSetup& setup = test.setup;
    double mass = 0.0;
    for (std::size_t b = 0; b < test.world.bodies.size(); ++b)
        if (!setup.is_platen(static_cast<BodyIndex>(b))) mass += test.world.bodies.inertia[b].mass;
    const double modulus = test.small_strain->moduli.youngs_modulus, area = setup.width * setup.height;
    RateRule rule;
    rule.tolerance = tolerance;
    rule.transit_time = setup.height / std::sqrt(modulus / (mass / area));
    rule.first_strain = test.small_strain->yield_strain;
    // Nothing ever gives way: the test's own length is all there is to go by.
    if (!std::isfinite(rule.first_strain)) rule.first_strain = test.description.loading.max_axial_strain;
    rule.stress_floor = modulus * rule.first_strain;
    rule.energy_floor = 0.5 * rule.stress_floor * rule.first_strain * area;
    return rule;
}

void start_by_tolerance(VirtualTest& test) {
    World& world = test.world;
    TestSetup& setup = test.setup;
    RateRule& rule = setup.rate_rule;
    rule = rate_rule_of(test, *test.description.loading.rate_tolerance);
    const bool bonded = test.description.loading.platens != "frictional";
    std::vector<bool> elastic(world.bodies.size(), bonded);
    if (bonded)
        for (const BodyIndex b : find_free_motions(world, {setup.bottom, setup.top}).bodies) elastic[b] = false;
    const std::vector<BodyMotion> motion = elastic_motion(test, elastic);
    for (std::size_t b = 0; b < motion.size(); ++b) {
        const BodyMotion& way = motion[b];
        rule.kinetic_per_rate += 0.5 * (world.bodies.inertia[b].mass * (way.x * way.x + way.y * way.y) +
                                        world.bodies.info(b).moment * way.rotation * way.rotation);
    }
    RateState& rate = test.state.rate;
    rate.rate = rate.slowest = rate.fastest = largest_rate(rule);
    set_velocities(world, motion, rate.rate);
    if (bonded) {
        settle_dashpots(world, setup, elastic);
        set_velocities(world, motion, rate.rate);
    }
    change_velocity(world, setup.top, 1, (setup.compression ? -1.0 : 1.0) * rate.rate * setup.height);
    restart_account(world);  // it begins with this motion
    velocities_changed(world);
    compute_forces(world);
}

}  // namespace crackle
