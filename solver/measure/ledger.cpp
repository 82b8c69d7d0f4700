// SPDX-License-Identifier: GPL-3.0-or-later
// Energy account. Between the force pass and the kick, all quantities are known at time n: positions x(n), the mean
// velocity v(n) = v(n-½) + ½a(n)Δt, and forces. Losses and work are known up to x(n), each by the trapezoidal rule over
// the drifts. With leapfrog the energies then balance to second order in the step; the remainder is the closing error.
// With the consistent integrator, the strain energy includes the energy defects of the contact points.

#include <cmath>

#include "solver/contact/opening.hpp"
#include "solver/faces/face_pass.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/laws/law.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

// The point kinds of the DEMseg guide's segment law are adjacent in PointKind.
constexpr auto first_guide_kind = static_cast<std::size_t>(PointKind::disc_segment);
constexpr std::size_t guide_kinds = 2;
static_assert(by_guide(PointKind::disc_segment) && by_guide(PointKind::segment_segment));

double kinetic_energy(const World& world) {
    const double share = kick_before(world.stepping);
    double sum = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyState& body = world.bodies.state[b];
        const BodyInertia& inertia = world.bodies.inertia[b];
        const BodyForce& force = world.bodies.force[b];
        const double vx =
            body.vx + share * (force.fx + inertia.mass * world.settings.gravity.x) * inertia.inverse_mass_x;
        const double vy =
            body.vy + share * (force.fy + inertia.mass * world.settings.gravity.y) * inertia.inverse_mass_y;
        const double omega = body.omega + share * force.torque * inertia.inverse_moment;
        sum += 0.5 * (inertia.mass * (vx * vx + vy * vy) + world.bodies.info(b).moment * omega * omega);
    }
    // The forces of drives also accelerate bodies.
    for (const ControlState& control : world.bodies.controls) {
        const BodyState& body = world.bodies.state[control.body];
        const BodyInertia& inertia = world.bodies.inertia[control.body];
        const BodyForce& force = world.bodies.force[control.body];
        const double load[3] = {force.fx + inertia.mass * world.settings.gravity.x,
                                force.fy + inertia.mass * world.settings.gravity.y, force.torque};
        const double inverse[3] = {inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_moment};
        const double velocity[3] = {body.vx, body.vy, body.omega};
        const double weight[3] = {inertia.mass, inertia.mass, world.bodies.info(control.body).moment};
        for (int d = 0; d < 3; ++d) {
            if (control.dof[d].drive != Drive::force) continue;
            const double without = velocity[d] + share * load[d] * inverse[d];
            const double with = without + share * control.force(d, body) * inverse[d];
            sum += 0.5 * weight[d] * (with * with - without * without);
        }
    }
    return sum;
}

double potential_energy(const World& world) {
    if (world.settings.gravity == Vec2{}) return 0.0;
    double sum = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        sum -= world.bodies.inertia[b].mass * (world.settings.gravity.x * world.bodies.state[b].x +
                                               world.settings.gravity.y * world.bodies.state[b].y);
    }
    return sum;
}

double energy_at(const World& world, PointIndex k, double overlap) {
    const ContactLaw law = law_of(world, k);
    const bool guide = !world.points.spring_work.empty() && k >= world.points.kind_begin[first_guide_kind] &&
                       k < world.points.kind_begin[first_guide_kind + guide_kinds];
    if (!guide) return strain_energy(law, overlap, world.points.bond_overlap[k], world.points.shear_force[k]);
    const double shear = law.shear_stiffness > 0.0
                             ? 0.5 * world.points.shear_force[k] * world.points.shear_force[k] / law.shear_stiffness
                             : 0.0;
    return world.points.spring_work[k].stored + shear;
}

// flatten inlines all calls. Otherwise the calls for each point would cost 1 % of a run whose rate is adapted.
[[gnu::flatten]] double strain_of_points(const World& world) {
    const BodyView bodies(world);  // created once, since overlap_at() would create one for each point
    double sum = 0.0;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            if ((world.points.state[k].flags & point_touching) == 0) continue;
            const double overlap = overlap_at<K>(bodies, world.points.contact[k]);
            const bool bonded = (world.points.state[k].flags & point_bonded) != 0;
            if (bonded || overlap > world.points.bond_overlap[k]) sum += energy_at(world, k, overlap);
        }
    });
    for (std::size_t k = 0; k < world.points.opening.size(); ++k)
        sum += opening_energy(world.points.opening[k], world.points.last_overlap[k].value);
    for (const double energy : world.account.opening_defects) sum += energy;
    return sum;
}

}  // namespace

Ledger measure_ledger(const World& world) {
    Ledger ledger;
    ledger.potential = potential_energy(world);
    ledger.kinetic = kinetic_energy(world);
    ledger.strain = strain_of_points(world);
    if (world.faces.size() > 0) ledger.strain += face_energy(world.faces);
    ledger.dashpot_loss = world.account.dashpot_loss;
    ledger.friction_loss = world.account.friction_loss;
    ledger.fracture_loss = world.account.fracture_loss;
    ledger.law_loss = world.account.law_loss;
    ledger.displacement_work = world.account.displacement_work;
    ledger.force_work = world.account.force_work;
    ledger.closing_error = ledger.potential + ledger.kinetic + ledger.strain + ledger.dashpot_loss +
                           ledger.friction_loss + ledger.fracture_loss + ledger.law_loss - ledger.displacement_work -
                           ledger.force_work - world.account.initial_energy;
    return ledger;
}

}  // namespace crackle
