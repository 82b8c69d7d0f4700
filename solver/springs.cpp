// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/springs.hpp"

#include "solver/contact_law.hpp"

namespace crackle {
namespace {

bool closed(const World& world, const PointView& view, ClosedPoints which) {
    switch (which) {
        case ClosedPoints::bonded:
            return world.has_bonds ? view.bonded : view.touching;
        case ClosedPoints::touching:
            return view.touching;
        case ClosedPoints::listed:
            break;
    }
    return true;
}

}  // namespace

double stretch(const Spring& s, const std::vector<Motion>& u) {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d) {
        sum += s.coefficient[d] * component(u[s.i], d);
        if (s.j != no_body) sum += s.coefficient[d + 3] * component(u[s.j], d);
    }
    return sum;
}

std::vector<Spring> springs_of(const World& world, ClosedPoints which) {
    std::vector<Spring> springs;
    const PointIndex walls = world.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    const auto count = which == ClosedPoints::bonded ? walls : static_cast<PointIndex>(world.points.size());
    for (PointIndex k = 0; k < count; ++k) {
        const PointView v = view_point(world, k);
        if (!closed(world, v, which)) continue;
        const ContactLaw& law = world.laws[world.points[k].law];
        const double root_mass = world.points[k].root_effective_mass;
        const auto add = [&](bool shear, double stiffness, double damping, Vec2 d) {
            if (stiffness == 0.0 && damping == 0.0) return;
            springs.push_back({v.body_i,
                               k < walls ? v.body_j : no_body,
                               k,
                               shear,
                               stiffness,
                               damping,
                               {d.x, d.y, cross(v.arm_i, d), -d.x, -d.y, -cross(v.arm_j, d)}});
        };
        add(false, v.normal_stiffness, normal_damping(law, root_mass), v.normal);
        // A frictionless point slides at once: neither its shear spring nor its dashpot ever acts.
        if (v.friction > 0.0) add(true, v.shear_stiffness, shear_damping(law, root_mass), perpendicular(v.normal));
    }
    return springs;
}

}  // namespace crackle
