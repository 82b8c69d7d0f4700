// SPDX-License-Identifier: GPL-3.0-or-later
// Records broken bonds after the force pass, in point order, so that events do not depend on the number of threads.
//
// If a break is found at time n, the bond's forces vanish between n-1 and n. By the trapezoidal rule, which is used for
// all work and losses, they still do half their work over that drift. The remaining stored energy is recorded as
// fracture energy; its formula, and when a break is in shear, are those of the bond law (solver/laws). Source:
// solver/MODEL.md 5.

#include "solver/stepping/record_breaks.hpp"

#include "solver/contact/point_motion.hpp"
#include "solver/geometry/event_place.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/laws/bond_laws.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

/// Whether a bond remains between the two bodies of a point. Bonds that broke in the same pass but are not yet recorded
/// still count, so that an interface that loses several bonds at once is counted as lost only once. The points between
/// two bodies are stored contiguously.
bool interface_holds(const World& world, PointIndex k) {
    const auto has_bond = [&](PointIndex other) {
        return (world.points.state[other].flags & (point_bonded | point_just_broken)) != 0;
    };
    const auto [begin, end] = points_between(world, k);
    for (PointIndex other = begin; other < end; ++other)
        if (has_bond(other)) return true;
    return false;
}

/// Fills in the event of a broken bond except its time and position, and sets the state of the point after the break.
template <PointKind K>
void part(World& world, const PassView& pass, PointIndex k, BreakEvent& event) {
    Points& points = world.points;
    const auto g = geometry_of_point<K>(pass, k);
    const RelativeMotion<double> motion = motion_of_point<K>(pass, points.contact[k], g);
    BondMemory memory{{}, (points.state[k].flags & point_slid) != 0, {}};
    if (!points.strong_normal.empty()) memory.strong = {points.strong_normal[k], points.strong_shear[k]};
    if (by_guide(K) && !points.spring_work.empty()) memory.normal_work = points.spring_work[k].stored;
    const BrokenBond broken = with_law(world.settings.bond_law, [&]<class Bond>() {
        const double from = Bond::facts.from_rest_overlap ? points.bond_overlap[k] : 0.0;
        return Bond::break_bond(law_of_point(pass, k), bonded_point<Bond>(pass, k, g.overlap - from, motion), memory);
    });
    event.energy = broken.energy;
    event.strength = broken.strength;
    event.normal_force = broken.reported.normal;
    event.shear_force = broken.reported.shear;
    event.slid = broken.slid;
    event.shear_mode = broken.in_shear;
    points.shear_force[k] = broken.shear;
    points.bond_overlap[k] = broken.rest_overlap;
    // This flag stays set until the stable bound is computed again.
    const int counted = points.state[k].flags & point_counted;
    const int touching = broken.normal > 0.0 ? point_touching : 0;
    const int had_bond = world.settings.own_shares() ? point_had_bond : 0;
    points.state[k].flags = static_cast<std::uint16_t>(counted | touching | had_bond);
}

}  // namespace

void record_breaks(World& world) {
    const PassView pass(world);
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end && K != PointKind::element_wall; ++k) {
            if ((world.points.state[k].flags & point_just_broken) == 0) continue;
            const PointView view = view_point(world, k);
            auto event = event_at<BreakEvent>(world, view.body_i, view.body_j, view.position, view.normal);
            part<K>(world, pass, k, event);
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
