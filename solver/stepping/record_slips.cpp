// SPDX-License-Identifier: GPL-3.0-or-later
// Records when bonds first reach their Coulomb limit: shear damage that is not counted as a break.

#include "solver/stepping/record_slips.hpp"

#include "solver/geometry/event_place.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {

void record_slips(World& world) {
    constexpr int first_time = point_bonded | point_slid;
    const PointIndex end = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = 0; k < end; ++k) {
        PointState& state = world.points.state[k];
        if ((state.flags & (first_time | point_slip_noted)) != first_time) continue;
        state.flags |= point_slip_noted;
        const PointView view = view_point(world, k);
        auto event = event_at<SlipEvent>(world, view.body_i, view.body_j, view.position, view.normal);
        event.shear_force = world.points.shear_force[k];
        event.normal_force = view.normal_force;
        world.bonds.slips.push_back(event);
    }
}

}  // namespace crackle
