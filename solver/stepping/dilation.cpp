// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/dilation.hpp"

#include <algorithm>

#include "solver/contact/point_motion.hpp"
#include "solver/laws/friction.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

/// Opens one contact as it slides. @param tangent the tangent of the dilation angle, tan ψ
template <PointKind K>
void dilate(World& world, const PassView& view, PointIndex k, const Joint& joint, double tangent) {
    const double left = joint.dilation_slip - world.points.slip[k];  // m, slip remaining until dilation ends
    if (!(left > 0.0)) return;
    const ContactPoint point = point_of<K>(view, k);
    const auto g = geometry_of_point<K>(view, k);
    double& rest = world.points.bond_overlap[k];
    const double overlap = g.overlap - rest;
    if (!(overlap > 0.0)) return;
    const Law<double> law = law_of_point(view, k);
    const RelativeMotion<double> motion = motion_of_point<K>(view, point, g);
    const double dt = world.stepping.drift;
    const ShearTrial<double> trial = try_shear_within(law, world.points.shear_force[k], motion.slipping * dt,
                                                      law.friction * spring_force(law, overlap));
    const double excess = magnitude(trial.force) - trial.limit;
    if (!(excess > 0.0)) return;
    const double slip = std::min(left, excess / (law.shear_stiffness + law.limit_stiffness * tangent));
    const double opening = slip * tangent;
    const double before = spring_force(law, std::max(0.0, overlap - motion.closing * dt)),
                 now = spring_force(law, overlap + opening);
    world.account.friction_loss -= 0.5 * (before + now) * opening;
    rest -= opening;
    world.points.slip[k] += slip;
    world.points.state[k].flags |= point_had_bond;  // makes the point keep its bond_overlap in later neighbour lists
    if (!world.points.last_overlap.empty()) world.points.last_overlap[k].value += opening;
}

template <PointKind K>
void dilate_points(World& world, const PassView& view) {
    const Settings& settings = world.settings;
    const std::size_t first = settings.first_joint_law();
    constexpr auto kind = static_cast<std::size_t>(K);
    for (PointIndex k = world.points.kind_begin[kind]; k < world.points.kind_begin[kind + 1]; ++k) {
        const PointState& state = world.points.state[k];
        if (state.law < first || (state.flags & (point_bonded | point_touching)) != point_touching) continue;
        const double tangent = settings.laws[state.law].dilation;
        if (tangent > 0.0) dilate<K>(world, view, k, settings.joint_of_law(state.law), tangent);
    }
}

}  // namespace

void dilate_joints(World& world) {
    const PassView view(world);
    dilate_points<PointKind::element_outline>(world, view);
    dilate_points<PointKind::face_face>(world, view);
}

}  // namespace crackle
