// SPDX-License-Identifier: GPL-3.0-or-later
// Back-tension bonding: every contact of overlap δ0 > 0 gets f_b = -k_n δ0, so a packing under pressure becomes a
// stress-free solid without added springs; stiffness is the same before and after breakage, tensile strength is k_n δ0.
// Source: DEMseg guide.

#include <algorithm>

#include "solver/contact/pass.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

constexpr std::int64_t events_at_once = 1024;  // for which there is room before steps allocate any

std::int64_t count_interfaces(const World& world) {
    std::vector<std::uint64_t> pairs;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.point_states[k].flags & point_bonded) == 0) continue;
        const ContactPoint& point = world.points[k];
        const std::uint64_t low = std::min(point.body_i, point.body_j), high = std::max(point.body_i, point.body_j);
        pairs.push_back((low << 32) | high);
    }
    std::sort(pairs.begin(), pairs.end());
    return std::distance(pairs.begin(), std::unique(pairs.begin(), pairs.end()));
}

}  // namespace

void set_thickness(World& world, double thick) {
    world.thick = thick;
    for (const BodyInfo& info : world.info) {
        for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e) {
            Element& element = world.elements[e];
            if (info.piece_count > 0) element.radius = 0.5 * thick;
            element.target_reach = info.piece_count > 0 ? 0.5 * thick : thick;
        }
    }
    world.list_valid = false;
    world.forces_current = false;
}

std::int64_t bond_all(World& world, double thick) {
    if (thick != world.thick) set_thickness(world, thick);
    refresh_neighbours(world);
    std::int64_t bonds = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        world.shear_forces[k] = 0.0;
        world.point_states[k].flags = 0;
        world.bond_overlaps[k] = 0.0;
        if (k >= world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]) continue;
        const PointView view = view_point(world, k);
        if (view.overlap <= 0.0) continue;
        world.bond_overlaps[k] = view.overlap;
        world.point_states[k].flags = point_bonded | point_touching;
        ++bonds;
    }
    finish_bonding(world);
    return bonds;
}

void finish_bonding(World& world) {
    world.has_bonds = true;
    world.bonds_initial = std::count_if(world.point_states.begin(), world.point_states.end(),
                                        [](const PointState& p) { return (p.flags & point_bonded) != 0; });
    world.interfaces_initial = count_interfaces(world);
    const CriticalStep exact = critical_step(world, ClosedPoints::touching);
    world.exact_step = exact.step;
    world.exact_step_proved = exact.proved;
    world.step_goal = world.automatic_step && world.bonds_initial > 0 ? world.safety_factor * exact.step : 0.0;
    evaluate_step_bound(world);
    world.bonds_broken = 0;
    world.interfaces_lost = 0;
    world.strong_normal.assign(world.points.size(), 0.0F);
    world.strong_shear = world.strong_normal;
    world.normal_dashpot.assign(world.ledger_on ? world.points.size() : 0, 0.0F);
    world.shear_dashpot = world.normal_dashpot;
    world.spring_work.assign(keeps_spring_work(world) ? world.points.size() : 0, SpringWork{});
    world.openings.assign(world.integrator == Integrator::consistent ? world.points.size() : 0, OpeningMemory{});
    std::fill(world.owed.begin(), world.owed.end(), 0.0);
    world.events.clear();
    world.events.reserve(static_cast<std::size_t>(std::min<std::int64_t>(world.bonds_initial, events_at_once)));
    world.dashpot_loss = world.friction_loss = world.fracture_loss = world.law_loss = 0.0;
    world.displacement_work = world.force_work = 0.0;
    world.initial_energy_taken = false;
    world.largest_supply = 0.0;
    world.drift = 0.0;  // nothing has moved since
    world.forces_current = false;
    if (world.intact.no_new_contacts) {
        world.list_valid = false;
        refresh_neighbours(world);
    }
}

}  // namespace crackle
