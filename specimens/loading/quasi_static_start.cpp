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
#include "specimens/elastic/analysis.hpp"
#include "specimens/elastic/held_parts.hpp"
#include "specimens/loading/displace.hpp"
#include "specimens/setup/unloading.hpp"

namespace crackle {
namespace {

ClosedPoints closed_of(const VirtualTest& test) {
    return test.closed == ClosedPoints::touching ? test.closed : closed_points(test.setup.apparatus);
}

/// Motion of every body for an axial strain of 1 in the direction of loading.
/// @param elastic  whether a body moves as in the linear solution
std::vector<BodyMotion> elastic_motion(const VirtualTest& test, const std::vector<bool>& elastic) {
    const TestSetup& setup = test.setup;
    const World& world = test.world;
    const double sense = -setup.apparatus.sense();
    const double bottom = world.bodies.state[setup.apparatus.bottom].y,
                 height = world.bodies.state[setup.apparatus.top].y - bottom;
    std::vector<BodyMotion> motion(world.bodies.size());
    for (std::size_t b = 0; b < motion.size(); ++b) {
        const double share = setup.apparatus.length * (world.bodies.state[b].y - bottom) / height;
        motion[b] = setup.apparatus.axis == 1 ? BodyMotion{0.0, share, 0.0} : BodyMotion{share, 0.0, 0.0};
        if (elastic[b]) motion[b] = test.small_strain->moduli.solution.displacement[b];
    }
    // A driving part that is not bonded is not part of the solution and moves at its prescribed speed; other unbonded
    // parts stay at rest. Walls move as in the solution.
    const std::vector<Prescribed> parts = prescribed_parts(setup.apparatus, setup.apparatus.length);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const BodyIndex body = parts[k].body;
        if (!elastic[body] || (setup.apparatus.uniaxial && !setup.apparatus.parts[k].wall))
            motion[body] = parts[k].motion;
    }
    for (BodyMotion& way : motion) way = {sense * way.x, sense * way.y, sense * way.rotation};
    return motion;
}

/// Kinetic energy at a strain rate of 1/s, divided by the square of that rate, J s2.
double kinetic_of(const World& world, const std::vector<BodyMotion>& motion) {
    double sum = 0.0;
    for (std::size_t b = 0; b < motion.size(); ++b) {
        const BodyMotion& way = motion[b];
        sum += 0.5 * (world.bodies.inertia[b].mass * (way.x * way.x + way.y * way.y) +
                      world.bodies.info(b).moment * way.rotation * way.rotation);
    }
    return sum;
}

/// Displaces the bodies by w (see quasi_static_start.hpp) and updates shear springs, in one drift of the integrator
/// without forces.
void settle_dashpots(World& world, const TestSetup& setup, const std::vector<bool>& elastic, ClosedPoints closed) {
    compute_forces(world);
    std::vector<BodyMotion> loads(world.bodies.size());
    for (std::size_t b = 0; b < loads.size(); ++b)
        if (elastic[b]) loads[b] = {world.bodies.force[b].fx, world.bodies.force[b].fy, world.bodies.force[b].torque};
    // External forces are included, because the contacts that balance them must not change.
    for (const ControlState& control : world.bodies.controls)
        for (int d = 0; d < 3; ++d)
            if (control.dof[d].drive == Drive::force)
                component(loads[control.body], d) += control.force(d, world.bodies.state[control.body]);
    const ElasticSolution settled = solve_elastic(world, prescribed_parts(setup.apparatus, 0.0), loads, closed);
    displace(world, settled.displacement);
}

/// sqrt(3 K/U), where K is the kinetic energy at unit strain rate and U the strain energy at unit strain in the linear
/// solution. For a bar between platens, this is the transit time of a wave; for a beam, a fraction of its longest
/// period.
double transit_of_motion(const VirtualTest& test) {
    const ElasticSolution& solved = test.small_strain->moduli.solution;
    const std::vector<bool> elastic(test.world.bodies.size(), solved.displacement.size() == test.world.bodies.size());
    return std::sqrt(3.0 * kinetic_of(test.world, elastic_motion(test, elastic)) / solved.energy);
}

}  // namespace

RateRule rate_rule_of(const VirtualTest& test, double tolerance) {
    if (!test.small_strain || !(test.small_strain->moduli.youngs_modulus > 0.0)) {
        throw InputError(fmt::format(
            "{}: expected an elastic solution from which to derive the rate; set axial_strain_rate instead: {}",
            test.description.at(CaseKey::loading_rate_tolerance),
            test.small_strain ? "the specimen has no stiffness" : test.no_small_strain));
    }
    const TestSetup& setup = test.setup;
    double mass = 0.0;
    for (std::size_t b = 0; b < test.world.bodies.size(); ++b)
        if (!setup.apparatus.is_platen(static_cast<BodyIndex>(b))) mass += test.world.bodies.inertia[b].mass;
    // Work is stress times strain times `area`.
    const double modulus = test.small_strain->moduli.youngs_modulus,
                 area = setup.apparatus.section * setup.apparatus.length;
    RateRule rule;
    rule.tolerance = tolerance;
    rule.transit_time =
        setup.apparatus.uniaxial ? setup.specimen.height / std::sqrt(modulus / (mass / area)) : transit_of_motion(test);
    rule.first_strain = test.small_strain->yield_strain;
    // A joint in the shear box slides long before the rock breaks.
    if (setup.apparatus.normal_force > 0.0)
        rule.first_strain =
            std::min(rule.first_strain, joint_slip_strain(test.world, setup.apparatus, test.small_strain->moduli));
    // If nothing fails up to the largest strain of the test, that strain is used.
    rule.first_strain = std::min(rule.first_strain, test.description.loading.max_axial_strain);
    rule.stress_floor = modulus * rule.first_strain;
    rule.energy_floor = 0.5 * rule.stress_floor * rule.first_strain * area;
    return rule;
}

namespace {

/// Whether the specimen starts with the motion of a linear solution.
bool moves_elastically(const VirtualTest& test) {
    return test.small_strain && test.description.loading.platens != PlatenKind::frictional;
}

/// Whether each body moves as in the linear solution. If the platens are bonded, all bodies held by bonds do.
std::vector<bool> elastic_bodies(const VirtualTest& test) {
    const bool elastically = moves_elastically(test);
    std::vector<bool> elastic(test.world.bodies.size(), elastically);
    if (elastically)
        for (const BodyIndex b :
             find_free_motions(test.world, bodies_of_parts(test.setup.apparatus), closed_of(test)).bodies)
            elastic[b] = false;
    return elastic;
}

/// Starts the motion at a given strain rate, without a shock. @return the motion at a strain rate of 1/s
std::vector<BodyMotion> start_moving(VirtualTest& test, double rate) {
    World& world = test.world;
    const TestSetup& setup = test.setup;
    const std::vector<bool> elastic = elastic_bodies(test);
    std::vector<BodyMotion> motion = elastic_motion(test, elastic);
    set_velocities(world, motion, rate);
    if (moves_elastically(test)) {
        settle_dashpots(world, setup, elastic, closed_of(test));
        set_velocities(world, motion, rate);
    }
    change_velocity(world, setup.apparatus.top, setup.apparatus.axis,
                    -setup.apparatus.sense() * rate * setup.apparatus.length);
    if (!setup.apparatus.uniaxial) {  // parts that are free already move with the other bodies
        strains_begin_at(test.setup, world);
        relax_drives(world);
    }
    restart_account(world);  // the energy balance starts with this motion
    velocities_changed(world);
    compute_forces(world);
    return motion;
}

}  // namespace

void start_by_rate(VirtualTest& test) { start_moving(test, *test.description.loading.axial_strain_rate()); }

void start_by_tolerance(VirtualTest& test) {
    World& world = test.world;
    TestSetup& setup = test.setup;
    setup.rate_rule = rate_rule_of(test, *test.description.loading.rate_tolerance());
    RateRule& rule = setup.rate_rule;
    RateState& rate = test.state.rate;
    rate.rate = rate.slowest = rate.fastest = largest_rate(rule);
    const UnloadRule unloading = unload_rule_of(test.description.loading.unloading, rule, test.state.youngs_modulus);
    test.state.path.speed = unloading.on() ? first_speed(unloading, rate.rate) : rate.rate;
    rule.kinetic_per_rate = kinetic_of(world, start_moving(test, test.state.path.speed));
}

}  // namespace crackle
