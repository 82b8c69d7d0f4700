// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/elastic/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/geometry/face_motion.hpp"
#include "solver/laws/bond_laws.hpp"
#include "solver/linear/face_rows.hpp"
#include "solver/linear/vibration.hpp"
#include "solver/measure/point_view.hpp"
#include "specimens/elastic/held_parts.hpp"

namespace crackle {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Increase in overlap and slip of a bonded point per unit of strain, computed from its springs.
struct PointRates {
    Rate closing, slipping;
};

/// Error of a spring's stretch: the error of the solve, plus the rounding error of a sum of six products if the
/// neighbours' displacements nearly cancel.
double stretch_error(const Spring& spring, const ElasticSolution& solution) {
    if (!(spring.stiffness > 0.0)) return 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        const BodyIndex b = k < 3 ? spring.i : spring.j;
        if (b != no_body)
            size += std::abs(spring.gradient[k] * component(solution.displacement[b], static_cast<int>(k % 3)));
    }
    return 6.0 * std::numeric_limits<double>::epsilon() * size + std::sqrt(solution.error_energy / spring.stiffness);
}

std::vector<PointRates> rates_of(const World& world, const ElasticSolution& solution) {
    std::vector<PointRates> rates(world.points.size());
    for (const Spring& spring : springs_of(world, ClosedPoints::bonded)) {
        PointRates& rate = rates[spring.point];
        (spring.shear ? rate.slipping : rate.closing) = {times(spring, spring.gradient, solution.displacement),
                                                         stretch_error(spring, solution)};
    }
    return rates;
}

LinearBond linear_bond(const World& world, PointIndex k, const PointRates& rate, double strain) {
    const PointView view = view_point(world, k);
    LinearBond bond;
    bond.body_i = world.bodies.info(view.body_i).id;
    bond.body_j = world.bodies.info(view.body_j).id;
    bond.position = view.position;
    bond.overlap = view.bond_overlap;
    const Rate normal{view.normal_stiffness * rate.closing.value, view.normal_stiffness * rate.closing.error};
    const Rate shear{view.shear_stiffness * std::abs(rate.slipping.value), view.shear_stiffness * rate.slipping.error};
    bond.closing = rate.closing.value * strain;
    bond.normal_force = normal.value * strain;
    bond.shear_force = -view.shear_stiffness * rate.slipping.value * strain;
    const bool held = (world.points.state[k].flags & point_held) != 0;
    const ElasticLimits limits = with_law(world.settings.bond_law, [&]<class Bond>() {
        return Bond::elastic_limits(law_of(world, k), view.bond_overlap, held, {rate.closing, normal, shear});
    });
    bond.strength = limits.strength;
    bond.break_strain = limits.break_strain;
    bond.slip_strain = limits.slip_strain;
    return bond;
}

/// Linear result for an intact face. @param growth  increase in the face's forces per unit of strain
LinearBond linear_face(const World& world, FaceIndex k, const FaceForces& growth, double strain) {
    const auto [i, j] = world.faces.bodies[k];
    const BodyState& body = world.bodies.state[i];
    const FaceLaw& law = world.faces.law_of(k);
    LinearBond bond;
    bond.body_i = world.bodies.info(i).id;
    bond.body_j = world.bodies.info(j).id;
    bond.position = Vec2{body.x, body.y} + turned_by(body, world.faces.place[k].arm_i);
    bond.closing = -growth.normal / world.faces.springs[k].normal * strain;
    bond.normal_force = -growth.normal * strain;
    bond.shear_force = growth.shear * strain;
    bond.strength = world.faces.springs[k].length * world.faces.strength_share[k] * law.tensile_strength;
    bond.break_strain = face_failure_load(law, world.faces.springs[k].length, world.faces.strength_share[k], growth);
    bond.slip_strain = infinite;
    return bond;
}

template <double LinearBond::*Strain>
std::optional<FirstEvent> first_of(const std::vector<LinearBond>& bonds, double modulus) {
    std::optional<FirstEvent> first;
    for (std::size_t k = 0; k < bonds.size(); ++k) {
        const double strain = bonds[k].*Strain;
        if (std::isfinite(strain) && (!first || strain < first->strain)) first = {strain, modulus * strain, k};
    }
    return first;
}

/// Converts the linear solution, whose strain is tensile, to the direction of loading: -1 in compression, otherwise 1.
double sense_of(const PlacedApparatus& apparatus) { return apparatus.compression ? -1.0 : 1.0; }

/// Rates at all points per unit of strain in the direction of loading.
std::vector<PointRates> rates_of_test(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli) {
    const double sense = sense_of(apparatus);
    std::vector<PointRates> rates = rates_of(world, moduli.solution);
    for (auto& [closing, slipping] : rates) {
        closing.value *= sense;
        slipping.value *= sense;
    }
    return rates;
}

std::vector<LinearBond> linear_bonds(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli,
                                     double strain) {
    const std::vector<PointRates> rates = rates_of_test(world, apparatus, moduli);
    std::vector<LinearBond> bonds;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        bonds.push_back(linear_bond(world, k, rates[k], strain));
    }
    const double sense = sense_of(apparatus);
    const std::vector<FaceForces> growth = face_force_rates(world, moduli.solution.displacement);
    for (FaceIndex k = 0; k < growth.size(); ++k) {
        if (world.faces.broken_at[k] != no_face) continue;
        bonds.push_back(linear_face(
            world, k, {sense * growth[k].normal, sense * growth[k].shear, sense * growth[k].moment}, strain));
    }
    return bonds;
}

}  // namespace

double yield_strain(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli, double share) {
    std::vector<double> strains;
    for (const LinearBond& bond : linear_bonds(world, apparatus, moduli, 0.0))
        strains.push_back(std::min(bond.slip_strain, bond.break_strain));
    if (strains.empty()) return infinite;
    const auto nth = strains.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(strains.size()));
    std::nth_element(strains.begin(), nth, strains.end());
    return *nth;
}

double joint_slip_strain(const World& world, const PlacedApparatus& apparatus, const Moduli& moduli) {
    const std::vector<PointRates> rates = rates_of_test(world, apparatus, moduli);
    std::vector<double> strains;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if (!view.closed_joint || !(view.normal_force > 0.0)) continue;
        const double gained = view.friction * view.normal_stiffness * rates[k].closing.value;
        double slides = infinite;
        for (const double way : {1.0, -1.0}) {
            const double shear = -view.shear_stiffness * rates[k].slipping.value;
            slides = std::min(slides, strain_of_loss(view.friction * view.normal_force - way * view.shear_force,
                                                     {gained - way * shear, 0.0}));
        }
        strains.push_back(slides);
    }
    if (strains.empty()) return infinite;
    const auto half = strains.begin() + static_cast<std::ptrdiff_t>(strains.size() / 2);
    std::nth_element(strains.begin(), half, strains.end());
    return *half;
}

ElasticAnalysis analyse_elastic(const World& world, const TestSetup& setup, const Moduli& moduli, double strain,
                                int modes) {
    ElasticAnalysis result;
    result.youngs_modulus = moduli.youngs_modulus;
    result.poissons_ratio = moduli.poissons_ratio;
    result.residual = moduli.solution.residual;
    result.unknowns = moduli.solution.unknowns;
    result.strain = strain;
    result.bonds = linear_bonds(world, setup.apparatus, moduli, strain);
    result.first_break = first_of<&LinearBond::break_strain>(result.bonds, result.youngs_modulus);
    result.first_slip = first_of<&LinearBond::slip_strain>(result.bonds, result.youngs_modulus);
    result.stable_time_step = setup.stable_time_step;
    result.stable_time_step_proved = setup.stable_time_step_proved;
    result.time_step_bound = setup.time_step_bound;
    result.time_step = world.stepping.time_step;
    result.free = find_free_motions(world, bodies_of_parts(setup.apparatus));
    const std::int64_t all_free = result.free.count;
    // A wall is not part of the specimen and no bond holds it along x, so it would count as a free motion.
    result.free.count -= static_cast<std::int64_t>(std::erase_if(result.free.bodies, [&](BodyIndex b) {
        return std::ranges::any_of(setup.apparatus.parts,
                                   [&](const SetupPart& part) { return part.wall && part.body == b; });
    }));
    for (const BodyIndex b : result.free.bodies) result.free_ids.push_back(world.bodies.info(b).id);
    if (modes > 0) {
        for (const VibrationMode& mode : lowest_modes(world, modes, all_free))
            result.frequencies.push_back(mode.frequency);
    }
    return result;
}

}  // namespace crackle
