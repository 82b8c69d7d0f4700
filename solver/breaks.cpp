// SPDX-License-Identifier: GPL-3.0-or-later
// Breaking of bonds: bookkeeping after the force pass, in the order of the points, so that events never depend on
// threads.
//
// The energy stored when the break is found, ½k_n(δ-δ0)² + ½f_t²/k_s, goes to the account of fracture. A break is
// `shear` if the point had been at its Coulomb limit since bonding and |f_t| > |f_n| in the last step in which it
// carried at least half its strength; else `tension`. Source: model.md 3.

#include "solver/breaks.hpp"

#include <cmath>
#include <numbers>

#include "solver/contact_law.hpp"

namespace crackle {
namespace {

/// Direction of a normal without its sense, in (-π/2, π/2].
double orientation_of(Vec2 normal) {
    double angle = std::atan2(normal.y, normal.x);
    if (angle > 0.5 * std::numbers::pi) angle -= std::numbers::pi;
    if (angle <= -0.5 * std::numbers::pi) angle += std::numbers::pi;
    return angle;
}

/// Whether a bond is left between the two; one found broken in the same pass but not yet recorded still counts, so that
/// an interface that loses several at once is lost once.
bool interface_holds(const World& world, BodyIndex a, BodyIndex b) {
    for (std::uint32_t s = world.body_begin[a]; s < world.body_begin[a + 1]; ++s) {
        const ContactPoint& point = world.points[world.body_slots[s] >> 1];
        if ((point.flags & (point_bonded | point_just_broken)) == 0) continue;
        if ((point.body_i == a && point.body_j == b) || (point.body_i == b && point.body_j == a)) return true;
    }
    return false;
}

}  // namespace

void record_breaks(World& world) {
    for (PointIndex k = 0; k < world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]; ++k) {
        ContactPoint& point = world.points[k];
        if ((point.flags & point_just_broken) == 0) continue;
        const PointView view = view_point(world, k);
        const ContactLaw& law = world.laws[point.law];
        const BondHistory& history = world.bond_history[k];
        BreakEvent event{};
        event.step = world.step;
        event.time = world.time;
        event.body_i = world.info[point.body_i].id;
        event.body_j = world.info[point.body_j].id;
        event.position = view.position;
        event.orientation = orientation_of(view.normal);
        event.energy = stored_energy(world, k);
        event.strength = law.normal_stiffness * point.bond_overlap;
        event.normal_force = history.normal_force;
        event.shear_force = history.shear_force;
        event.slid = (point.flags & point_slid) != 0;
        event.shear_mode = event.slid && std::abs(history.shear_force) > std::abs(history.normal_force);
        point.shear_force = 0.0;
        point.bond_overlap = 0.0;
        point.flags = 0;
        if (!world.spring_work.empty()) world.spring_work[k] = {};
        event.last_of_interface = !interface_holds(world, point.body_i, point.body_j);
        world.fracture_loss += event.energy;
        world.bonds_broken += 1;
        world.interfaces_lost += event.last_of_interface ? 1 : 0;
        world.events.push_back(event);
    }
}

}  // namespace crackle
