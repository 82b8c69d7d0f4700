// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/elastic/moduli.hpp"

#include <fmt/format.h>

#include <limits>

#include "solver/base/errors.hpp"
#include "specimens/elastic/held_parts.hpp"

namespace crackle {
namespace {

// A specimen is a mechanism if the solution stores less than this fraction of the energy of a uniform strain.
// find_free_motions() uses the same fraction.
constexpr double free_share = 1e-9;

/// Energy of all springs if every body moves with a uniform axial strain of 1, J; an upper bound on the energy of the
/// linear solution.
double energy_of_mean_strain(const World& world, const PlacedApparatus& apparatus) {
    const double low = world.bodies.state[apparatus.bottom].y, high = world.bodies.state[apparatus.top].y;
    std::vector<BodyMotion> motion(world.bodies.size());
    for (std::size_t b = 0; b < motion.size(); ++b)
        (apparatus.axis == 1 ? motion[b].y : motion[b].x) =
            apparatus.length * (world.bodies.state[b].y - low) / (high - low);
    double sum = 0.0;
    for (const Spring& spring : springs_of(world, ClosedPoints::bonded)) {
        const double stretch = times(spring, spring.gradient, motion);
        sum += 0.5 * spring.stiffness * stretch * stretch;
    }
    return sum;
}

void refuse_mechanism(const World& world, const PlacedApparatus& apparatus, double energy) {
    const double share = energy / energy_of_mean_strain(world, apparatus);
    if (share > free_share) return;
    throw InputError(fmt::format(
        "found a mechanism: under a uniform strain, the specimen stores only {:.1g} of the energy that its springs "
        "would store if all particles followed that strain. Its particles roll or slide past one another; expected "
        "shear_stiffness and friction_angle above 0, and bonds that reach from platen to platen",
        share));
}

}  // namespace

Moduli solve_moduli(const World& world, const TestSetup& setup) {
    Moduli moduli{};
    moduli.solution = solve_elastic(world, prescribed_parts(setup.apparatus, setup.apparatus.length));
    refuse_mechanism(world, setup.apparatus, moduli.solution.energy);
    moduli.youngs_modulus = nominal_stress(setup.apparatus, moduli.solution.reaction);
    moduli.poissons_ratio = moduli.gauge_modulus = std::numeric_limits<double>::quiet_NaN();
    const auto rise = [&](const std::vector<BodyIndex>& bodies) {
        double sum = 0.0;
        for (const BodyIndex b : bodies) sum += moduli.solution.displacement[b].y;
        return sum / static_cast<double>(bodies.size());
    };
    if (setup.gauges.axial_length > 0.0) {
        const double strain = (rise(setup.gauges.top) - rise(setup.gauges.bottom)) / setup.gauges.axial_length;
        moduli.gauge_modulus = moduli.youngs_modulus / strain;
    }
    if (setup.gauges.lateral_length == 0.0 || !setup.apparatus.uniaxial) return moduli;
    const auto mean = [&](const std::vector<BodyIndex>& bodies) {
        double sum = 0.0;
        for (const BodyIndex b : bodies) sum += moduli.solution.displacement[b].x;
        return sum / static_cast<double>(bodies.size());
    };
    moduli.poissons_ratio = -(mean(setup.gauges.right) - mean(setup.gauges.left)) / setup.gauges.lateral_length;
    return moduli;
}

}  // namespace crackle
