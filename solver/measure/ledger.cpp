// SPDX-License-Identifier: GPL-3.0-or-later
// The account of energy. Between force pass and kick everything is known at time n: positions x(n), the mean velocity
// v(n) = v(n-½) + ½a(n)Δt, forces, and the losses and works up to x(n), each taken by the trapezoidal rule over the
// drifts. Leapfrog then closes the account to second order in the step; what is left is the closing error. Under the
// consistent integrator the strain energy contains what its points owe.

#include <cmath>

#include "solver/contact/geometry.hpp"
#include "solver/contact/law.hpp"
#include "solver/contact/opening.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

// The guide's kinds lie side by side.
constexpr auto first_guide_kind = static_cast<std::size_t>(PointKind::disc_segment);
constexpr std::size_t guide_kinds = 2;
static_assert(by_guide(PointKind::disc_segment) && by_guide(PointKind::segment_segment));

double kinetic_energy(const World& world) {
    const double share = kick_before(world);
    double sum = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies[b];
        const BodyInertia& inertia = world.inertia[b];
        const BodyForce& force = world.forces[b];
        const double vx = body.vx + share * (force.fx + inertia.mass * world.gravity.x) * inertia.inverse_mass_x;
        const double vy = body.vy + share * (force.fy + inertia.mass * world.gravity.y) * inertia.inverse_mass_y;
        const double omega = body.omega + share * force.torque * inertia.inverse_moment;
        sum += 0.5 * (inertia.mass * (vx * vx + vy * vy) + world.info[b].moment * omega * omega);
    }
    // Driving forces accelerate too.
    for (const ControlState& control : world.controls) {
        const BodyState& body = world.bodies[control.body];
        const BodyInertia& inertia = world.inertia[control.body];
        const BodyForce& force = world.forces[control.body];
        const double load[3] = {force.fx + inertia.mass * world.gravity.x, force.fy + inertia.mass * world.gravity.y,
                                force.torque};
        const double inverse[3] = {inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_moment};
        const double velocity[3] = {body.vx, body.vy, body.omega};
        const double weight[3] = {inertia.mass, inertia.mass, world.info[control.body].moment};
        for (int d = 0; d < 3; ++d) {
            if (control.dof[d].drive != Drive::force) continue;
            const double without = velocity[d] + share * load[d] * inverse[d];
            const double with = without + share * control.dof[d].value * inverse[d];
            sum += 0.5 * weight[d] * (with * with - without * without);
        }
    }
    return sum;
}

double potential_energy(const World& world) {
    if (world.gravity == Vec2{}) return 0.0;
    double sum = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        sum -= world.inertia[b].mass * (world.gravity.x * world.bodies[b].x + world.gravity.y * world.bodies[b].y);
    }
    return sum;
}

double energy_at(const World& world, PointIndex k, double overlap) {
    const ContactLaw& law = world.laws[world.point_states[k].law];
    const bool guide = !world.spring_work.empty() && k >= world.kind_begin[first_guide_kind] &&
                       k < world.kind_begin[first_guide_kind + guide_kinds];
    if (!guide) return strain_energy(law, overlap, world.bond_overlaps[k], world.shear_forces[k]);
    const double shear =
        law.shear_stiffness > 0.0 ? 0.5 * world.shear_forces[k] * world.shear_forces[k] / law.shear_stiffness : 0.0;
    return world.spring_work[k].stored + shear;
}

double strain_of_points(const World& world) {
    double sum = 0.0;
    visit_kinds(world.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            if ((world.point_states[k].flags & point_touching) == 0) continue;
            const double overlap = overlap_at<K>(world, world.points[k]);
            if ((world.point_states[k].flags & point_bonded) != 0 || overlap > 0.0) sum += energy_at(world, k, overlap);
        }
    });
    for (const OpeningMemory& memory : world.openings) sum += opening_energy(memory);
    for (const double energy : world.owed) sum += energy;
    return sum;
}

}  // namespace

double stored_energy(const World& world, PointIndex k) { return energy_at(world, k, overlap_of(world, k)); }

Ledger measure_ledger(const World& world) {
    Ledger ledger;
    ledger.potential = potential_energy(world);
    ledger.kinetic = kinetic_energy(world);
    ledger.strain = strain_of_points(world);
    ledger.dashpot_loss = world.dashpot_loss;
    ledger.friction_loss = world.friction_loss;
    ledger.fracture_loss = world.fracture_loss;
    ledger.law_loss = world.law_loss;
    ledger.displacement_work = world.displacement_work;
    ledger.force_work = world.force_work;
    ledger.closing_error = ledger.potential + ledger.kinetic + ledger.strain + ledger.dashpot_loss +
                           ledger.friction_loss + ledger.fracture_loss + ledger.law_loss - ledger.displacement_work -
                           ledger.force_work - world.initial_energy;
    return ledger;
}

}  // namespace crackle
