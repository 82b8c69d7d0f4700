// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/loading/press.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/linear/elastic.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/elastic/held_parts.hpp"
#include "specimens/loading/displace.hpp"

namespace crackle {
namespace {

constexpr int most_press_rounds = 50;
// A linear solution with bonds only is useful if it reduces the largest unbalanced force to at most this fraction.
constexpr double most_left_by_bonds = 0.5;

/// Unbalanced force on every body, including the normal force on the upper box.
std::vector<BodyMotion> forces_left(const VirtualTest& test) {
    std::vector<BodyMotion> left;
    for (const BodyForce& force : test.world.bodies.force) left.push_back({force.fx, force.fy, force.torque});
    left[test.setup.apparatus.top].y -= test.setup.apparatus.normal_force;
    return left;
}

/// Rejects a normal spring that is stiffer than the bonds of the upper box. Such a spring would limit the time step,
/// which is derived without the spring.
void check_spring(const VirtualTest& test) {
    double holding = 0.0;
    for (const Spring& spring : springs_of(test.world, ClosedPoints::bonded))
        if (spring.i == test.setup.apparatus.top || spring.j == test.setup.apparatus.top) holding += spring.stiffness;
    if (test.setup.apparatus.normal_spring <= holding) return;
    throw InputError(fmt::format(
        "{}: found {:g} {}/m, expected at most {:.3g}, the stiffness of the bonds of the upper box; lower this value",
        test.description.at(CaseKey::loading_normal_stiffness), test.description.loading.normal_stiffness,
        test.description.stress_unit(), holding / test.setup.specimen.width));
}

/// Moves the bodies until the specimen carries the normal force.
void find_equilibrium(VirtualTest& test) {
    World& world = test.world;
    const TestSetup& setup = test.setup;
    if (!test.small_strain) {
        throw InputError(fmt::format("{}: expected an elastic solution, which is needed to apply the normal stress: {}",
                                     test.description.at(CaseKey::loading_normal_stress), test.no_small_strain));
    }
    std::vector<bool> held(world.bodies.size(), true);
    for (const BodyIndex b : find_free_motions(world, bodies_of_parts(setup.apparatus)).bodies) held[b] = false;
    const double particle =
        std::sqrt(setup.specimen.width * setup.specimen.height / static_cast<double>(setup.specimen.particles));
    const double of_particle = setup.apparatus.normal_force * particle / setup.specimen.width;
    // The first solutions include only bonds. If pressing closes gaps between particles, these contacts are included
    // from then on.
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0;; ++round) {
        std::vector<BodyMotion> left = forces_left(test);
        double largest = std::abs(left[setup.apparatus.top].y) / setup.apparatus.normal_force;
        for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
            if (!held[b]) left[b] = {};
            if (setup.apparatus.is_platen(b)) continue;
            largest = std::max(largest, std::hypot(left[b].x, left[b].y) / of_particle);
        }
        if (largest <= most_unbalanced_pressed) break;
        if (round == most_press_rounds || !std::isfinite(largest)) {
            throw InputError(
                fmt::format("{}: found no equilibrium under {:g} {}: a force of {:.2g} of that stress on a particle "
                            "was left, expected at most {:g}, and {} bonds had broken; lower the normal stress",
                            test.description.at(CaseKey::loading_normal_stress), test.description.loading.normal_stress,
                            test.description.stress_unit(), largest, most_unbalanced_pressed, world.bonds.broken));
        }
        if (largest > most_left_by_bonds * before) test.closed = ClosedPoints::touching;
        before = largest;
        displace(world, solve_elastic(world, prescribed_parts(setup.apparatus, 0.0), left, test.closed).displacement);
    }
    // Loading starts with a solution that includes the contacts closed by pressing.
    if (test.closed == ClosedPoints::touching)
        test.small_strain->moduli.solution =
            solve_elastic(world, prescribed_parts(setup.apparatus, setup.apparatus.length), {}, test.closed);
    if (world.bonds.broken > 0)
        test.setup.origin.notices.push_back(
            fmt::format("{} of {} bonds broke under the normal stress alone, before loading", world.bonds.broken,
                        world.bonds.initial));
}

}  // namespace

void press(VirtualTest& test) {
    if (test.setup.apparatus.normal_spring > 0.0) check_spring(test);
    if (test.setup.apparatus.normal_force > 0.0) find_equilibrium(test);
    restart_account(test.world);
    compute_forces(test.world);
    strains_begin_at(test.setup, test.world);
    relax_drives(test.world);
}

}  // namespace crackle
