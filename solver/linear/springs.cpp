// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/linear/springs.hpp"

#include <cmath>

#include "solver/laws/dashpot.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

bool closed(const World& world, const PointView& view, ClosedPoints which) {
    switch (which) {
        case ClosedPoints::bonded:
            return world.bonds.made ? view.bonded || view.closed_joint : view.touching;
        case ClosedPoints::touching:
            return view.touching || view.closed_joint;
        case ClosedPoints::listed:
            break;
    }
    return true;
}

}  // namespace

double times(const Spring& s, const OverlapGradient& row, const std::vector<BodyMotion>& u) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        const auto k = static_cast<std::size_t>(d);
        sum += row[k] * component(u[s.i], d);
        if (s.j != no_body) sum += row[k + 3] * component(u[s.j], d);
    }
    return sum;
}

double scaled_square(const World& world, const OverlapGradient& row, BodyIndex i, BodyIndex j) {
    const auto half = [&](BodyIndex body, std::size_t d) {
        if (body == no_body) return 0.0;
        const BodyInertia& m = world.bodies.inertia[body];
        return m.inverse_mass_x * row[d] * row[d] + m.inverse_mass_y * row[d + 1] * row[d + 1] +
               m.inverse_moment * row[d + 2] * row[d + 2];
    };
    return half(i, 0) + half(j, 3);
}

std::vector<Spring> symmetric_majorant(const World& world, const std::vector<Spring>& springs) {
    std::vector<Spring> result;
    result.reserve(springs.size());
    for (const Spring& s : springs) {
        const double push = scaled_square(world, s.push, s.i, s.j),
                     gradient = scaled_square(world, s.gradient, s.i, s.j);
        if (s.symmetric() || push == 0.0 || gradient == 0.0) {
            result.push_back(s);  // already symmetric, or without effect on free motions
            result.back().gradient = s.push;
            continue;
        }
        const double share = std::sqrt(gradient / push);
        Spring half = s;
        half.stiffness = 0.5 * s.stiffness * share;
        half.gradient = s.push;
        result.push_back(half);
        half.stiffness = 0.5 * s.stiffness / share;
        half.damping = 0.0;
        half.push = half.gradient = s.gradient;
        result.push_back(half);
    }
    return result;
}

std::vector<Spring> springs_of(const World& world, ClosedPoints which) {
    std::vector<Spring> springs;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    const auto count = which == ClosedPoints::bonded ? walls : static_cast<PointIndex>(world.points.size());
    for (PointIndex k = 0; k < count; ++k) {
        const PointView v = view_point(world, k);
        if (!closed(world, v, which)) continue;
        const ContactLaw law = law_of(world, k);
        const double root_mass = root_mass_of(world, k);
        const auto add = [&](bool shear, double stiffness, double damping, const OverlapGradient& push,
                             const OverlapGradient& gradient) {
            if (stiffness == 0.0 && damping == 0.0) return;
            springs.push_back({v.body_i, k < walls ? v.body_j : no_body, k, shear, stiffness, damping, push, gradient});
        };
        const OverlapGradient along = closing_gradient(v.normal, v.arm_i, v.arm_j),
                              across = closing_gradient(perpendicular(v.normal), v.arm_i, v.arm_j);
        add(false, v.normal_stiffness, normal_damping(law, root_mass), along, v.overlap_gradient);
        // A frictionless point slides immediately, so neither its shear spring nor its shear dashpot ever acts.
        if (v.sticks) add(true, v.shear_stiffness, shear_damping(law, root_mass), across, across);
    }
    return springs;
}

}  // namespace crackle
