// SPDX-License-Identifier: GPL-3.0-or-later
// Breaking of bonds: bookkeeping after the force pass, in the order of the points, so that events never depend on
// threads.
//
// A break found at time n lets the forces go between n-1 and n: by the trapezoidal rule, as every other work and loss
// is taken, they still do half their work over that drift. What is left of the stored energy goes to the account of
// fracture: ½k_n(δ-δ0)' (δ-δ0) + ½f_t' f_t/k_s, the primed values those of n-1; ½k_n(δ-δ0)² + ½f_t²/k_s as Δt → 0. A
// spring whose force has turned within that step has passed through none, and nothing is left in it. A break is `shear`
// if the point had been at its Coulomb limit since bonding and |f_t| > |f_n| in the last step in which it carried at
// least half its strength; else `tension`. Of a coulomb bond contact/coulomb_bond.hpp says the same.
// Source: solver/MODEL.md 5.

#include "solver/stepping/record_breaks.hpp"

#include <cmath>

#include "solver/contact/point_motion.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/event_place.hpp"

namespace crackle {
namespace {

/// What a spring stores over its stiffness, by elongations one step apart; or times it, by forces.
double half_product(double before, double now) { return before * now > 0.0 ? 0.5 * before * now : 0.0; }

/// Energy that a break takes, J (see above). Under the guide's law the normal spring's work has been added up just so.
template <PointKind K>
double fracture_energy(World& world, PointIndex k, const PointView& view) {
    const ContactPoint point = world.points.contact[k];
    const ContactLaw law = law_of(world, k);
    const RelativeMotion<double> motion = motion_of_point<K>(world, point, geometry_of_point<K>(world, k));
    const double opening = view.overlap - world.points.bond_overlap[k];
    const double before = opening - world.stepping.drift * motion.closing;
    const double normal = by_guide(view.kind) && !world.points.spring_work.empty()
                              ? world.points.spring_work[k].stored
                              : law.normal_stiffness * half_product(before, opening);
    if (law.shear_stiffness == 0.0) return normal;
    const double shear = world.points.shear_force[k] - law.shear_stiffness * world.stepping.drift * motion.slipping;
    return normal + half_product(shear, world.points.shear_force[k]) / law.shear_stiffness;
}

/// Whether a bond is left between the two bodies of a point; one found broken in the same pass but not yet recorded
/// still counts, so that an interface that loses several at once is lost once. Points of two bodies lie together.
bool interface_holds(const World& world, PointIndex k) {
    const auto has_bond = [&](PointIndex other) {
        return (world.points.state[other].flags & (point_bonded | point_just_broken)) != 0;
    };
    const auto [begin, end] = points_between(world, k);
    for (PointIndex other = begin; other < end; ++other)
        if (has_bond(other)) return true;
    return false;
}

/// What a back-tension bond's event says beyond place and time; the point is as after a break.
template <PointKind K>
void part_back_tension(World& world, PointIndex k, const PointView& view, BreakEvent& event) {
    event.energy = fracture_energy<K>(world, k, view);
    event.strength = law_of(world, k).normal_stiffness * world.points.bond_overlap[k];
    event.normal_force = world.points.strong_normal[k];
    event.shear_force = world.points.strong_shear[k];
    event.slid = (world.points.state[k].flags & point_slid) != 0;
    event.shear_mode = event.slid && std::abs(event.shear_force) > std::abs(event.normal_force);
    world.points.shear_force[k] = 0.0;
    world.points.bond_overlap[k] = 0.0;
    const int had_bond = world.settings.own_shares() ? point_had_bond : 0;
    world.points.state[k].flags = static_cast<std::uint16_t>((world.points.state[k].flags & point_counted) |
                                                             had_bond);  // until the bound is found again
}

/// The same of a coulomb bond, which can go on to push and to rub.
template <PointKind K>
void part_coulomb(World& world, PointIndex k, BreakEvent& event) {
    const Law<double> law = law_of_point(world, k);
    const auto g = geometry_of_point<K>(world, k);
    const RelativeMotion<double> moves = motion_of_point<K>(world, world.points.contact[k], g);
    const PointMotion motion{g.overlap - world.points.bond_overlap[k], moves.closing, moves.slipping};
    const BondForces now = forces_now(world, k, law, motion);
    const BrokenBond broken = broken_bond(world, k, law, motion);
    event.energy = broken.energy;
    event.strength = broken.strength;
    event.normal_force = now.normal;
    event.shear_force = now.shear;
    event.shear_mode = broken.in_shear;
    world.points.shear_force[k] = broken.shear;
    world.points.bond_overlap[k] = broken.rest_overlap;
    const int touching = broken.normal > 0.0 ? point_touching : 0;
    world.points.state[k].flags =
        static_cast<std::uint16_t>((world.points.state[k].flags & point_counted) | touching | point_had_bond);
}

}  // namespace

void record_breaks(World& world) {
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end && K != PointKind::element_wall; ++k) {
            if ((world.points.state[k].flags & point_just_broken) == 0) continue;
            const PointView view = view_point(world, k);
            auto event = event_at<BreakEvent>(world, view);
            if (world.settings.bond_law == BondLaw::coulomb) {
                part_coulomb<K>(world, k, event);
            } else {
                part_back_tension<K>(world, k, view, event);
            }
            if (!world.points.spring_work.empty()) world.points.spring_work[k] = {};
            if (!world.points.opening.empty()) {
                world.points.opening[k] = {};
                world.points.last_overlap[k] = {};
                world.points.last_normal[k] = 0.0;
            }
            event.last_of_interface = !interface_holds(world, k);
            event.kind = view.kind;
            event.point = world.points.contact[k];
            world.account.fracture_loss += event.energy;
            world.bonds.broken += 1;
            world.bonds.broken_after_sliding += event.slid ? 1 : 0;
            world.bonds.interfaces_lost += event.last_of_interface ? 1 : 0;
            world.bonds.events.push_back(event);
        }
    });
}

}  // namespace crackle
