// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/frame_forces.hpp"

#include <cmath>

#include "solver/geometry/contact_share.hpp"

namespace crackle {
namespace {

/// Adds the contribution of one contact to the stresses of its bodies. @param normal, shear  forces as in PointView, N
void add_contact(std::vector<ParticleStress>& sums, const ContactPoint& point, const ContactGeometry& g, double normal,
                 double shear) {
    const Vec2 on_i = shear * Vec2{-g.ny, g.nx} - normal * Vec2{g.nx, g.ny};
    const auto add = [](ParticleStress& sum, Vec2 force, Vec2 arm) {
        sum.xx -= arm.x * force.x;
        sum.yy -= arm.y * force.y;
        sum.xy -= 0.5 * (arm.x * force.y + arm.y * force.x);
    };
    add(sums[point.body_i], on_i, {g.aix, g.aiy});
    add(sums[point.body_j], -on_i, {g.ajx, g.ajy});
}

/// Divides the sums of contributions by the areas of the bodies. Platens have no stress.
void divide_by_areas(std::vector<ParticleStress>& sums, const World& world, const PlacedApparatus& apparatus) {
    for (BodyIndex b = 0; b < sums.size(); ++b) {
        if (apparatus.is_platen(b)) {
            sums[b] = {};
            continue;
        }
        const double share = 1.0 / area_of(world, b);
        sums[b] = {share * sums[b].xx, share * sums[b].yy, share * sums[b].xy};
    }
}

}  // namespace

double area_of(const World& world, BodyIndex b) {
    return world.bodies.inertia[b].mass / world.settings.materials[world.bodies.info(b).material].density;
}

FrameForces find_forces(const PlacedFrame& placed) {
    const World& world = placed.world();
    const TestSetup& setup = placed.setup();
    const Frame& frame = placed.frame();
    FrameForces forces;
    forces.normal.reserve(setup.bonds.points.size() + frame.loose.contacts.size());
    forces.stress.resize(frame.bodies.size());
    const BodyView bodies(world);
    const auto geometry = [&]<PointKind K>(const ContactPoint& point) {
        std::uint32_t feature = point.feature_j;
        return contact_geometry<K>(bodies, point, placed.body(point.body_i), placed.body(point.body_j), feature);
    };
    const auto add_force = [&](const ContactPoint& point, const ContactGeometry& g, double normal, double shear) {
        forces.normal.push_back(normal);
        add_contact(forces.stress, point, g, normal, shear);
    };
    const auto add = [&]<PointKind K>(const ContactPoint& point, double rest_overlap, double share, double shear) {
        const ContactGeometry g = geometry.template operator()<K>(point);
        const ContactLaw& law = world.settings.laws[law_between(world, point.body_i, point.body_j)];
        add_force(point, g, share * law.normal_stiffness * (g.overlap - rest_overlap), shear);
    };
    auto of_joint = frame.joint_forces.begin();
    visit_kinds(setup.bonds.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            if (frame.states[k] == ContactState::broken) {
                forces.normal.push_back(0.0);
                continue;
            }
            if (of_joint != frame.joint_forces.end() && of_joint->bond == k) {
                const ContactPoint point = setup.bonds.points.at<K>(k);
                add_force(point, geometry.template operator()<K>(point), of_joint->normal, frame.shear_force[k]);
                ++of_joint;
                continue;
            }
            add.template operator()<K>(setup.bonds.points.at<K>(k),
                                       holds(frame.states[k]) ? setup.bonds.overlaps[k] : setup.bonds.rest_overlap(k),
                                       setup.bonds.shares.empty() ? 1.0 : setup.bonds.shares[k], frame.shear_force[k]);
        }
    });
    visit_kinds(frame.loose.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            const LooseContact& contact = frame.loose.contacts[k];
            if (!std::isnan(contact.joint_force)) {
                add_force(contact.point, geometry.template operator()<K>(contact.point), contact.joint_force,
                          contact.shear_force);
                continue;
            }
            const double share = world.settings.units == StiffnessUnits::area
                                     ? static_cast<float>(share_of_contact(world, K, contact.point).stiffness())
                                     : 1.0;
            add.template operator()<K>(contact.point, 0.0, share, contact.shear_force);
        }
    });
    divide_by_areas(forces.stress, world, setup.apparatus);
    return forces;
}

}  // namespace crackle
