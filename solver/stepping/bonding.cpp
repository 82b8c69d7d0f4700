// SPDX-License-Identifier: GPL-3.0-or-later
// Back-tension bonding: every contact of overlap δ0 > 0 gets f_b = -k_n δ0, so a packing under pressure becomes a
// stress-free solid without added springs; stiffness is the same before and after breakage, tensile strength is k_n δ0.
// Source: DEMseg guide.

#include <algorithm>

#include "solver/contact/pass.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

constexpr std::int64_t events_at_once = 1024;  // for which there is room before steps allocate any

std::int64_t count_interfaces(const World& world) {
    std::vector<std::uint64_t> pairs;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & point_bonded) == 0) continue;
        const ContactPoint& point = world.points.contact[k];
        const std::uint64_t low = std::min(point.body_i, point.body_j), high = std::max(point.body_i, point.body_j);
        pairs.push_back((low << 32) | high);
    }
    std::sort(pairs.begin(), pairs.end());
    return std::distance(pairs.begin(), std::unique(pairs.begin(), pairs.end()));
}

}  // namespace

void set_thickness(World& world, double thick) {
    world.settings.thick = thick;
    for (const BodyInfo& info : world.bodies.info) {
        for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e) {
            Element& element = world.bodies.elements[e];
            if (info.piece_count > 0) element.radius = 0.5 * thick;
            element.target_reach = info.piece_count > 0 ? 0.5 * thick : thick;
        }
    }
    bodies_moved(world);
}

std::int64_t bond_all(World& world, double thick) {
    if (thick != world.settings.thick) set_thickness(world, thick);
    refresh_neighbours(world);
    std::int64_t bonds = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        world.points.shear_force[k] = 0.0;
        world.points.state[k].flags = 0;
        world.points.bond_overlap[k] = 0.0;
        if (k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)]) continue;
        const PointView view = view_point(world, k);
        if (view.overlap <= 0.0) continue;
        world.points.bond_overlap[k] = view.overlap;
        world.points.state[k].flags = point_bonded | point_touching;
        ++bonds;
    }
    finish_bonding(world);
    return bonds;
}

void finish_bonding(World& world) {
    world.bonds.made = true;
    world.bonds.initial = std::count_if(world.points.state.begin(), world.points.state.end(),
                                        [](const PointState& p) { return (p.flags & point_bonded) != 0; });
    world.bonds.interfaces_initial = count_interfaces(world);
    const CriticalStep exact = critical_step(world, ClosedPoints::touching);
    world.stepping.exact_step = exact.step;
    world.stepping.exact_step_proved = exact.proved;
    world.stepping.step_goal =
        world.stepping.automatic_step && world.bonds.initial > 0 ? world.stepping.safety_factor * exact.step : 0.0;
    evaluate_step_bound(world);
    world.bonds.broken = 0;
    world.bonds.interfaces_lost = 0;
    visit_remembered(world.points, [&]<class T>(std::vector<T>& values, Remembered remembered) {
        if (remembered != Remembered::always) values.assign(keeps(world, remembered) ? world.points.size() : 0, T{});
    });
    world.bonds.events.clear();
    world.bonds.events.reserve(static_cast<std::size_t>(std::min<std::int64_t>(world.bonds.initial, events_at_once)));
    restart_account(world);
    world.stepping.drift = 0.0;  // nothing has moved since
    world.stepping.forces_current = false;
    if (world.settings.intact.no_new_contacts) {
        world.list.valid = false;
        refresh_neighbours(world);
    }
}

}  // namespace crackle
