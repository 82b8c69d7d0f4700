// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/measure/last_pass.hpp"

#include <cmath>

#include "solver/base/correctly_rounded.hpp"
#include "solver/faces/face_pass.hpp"
#include "solver/geometry/face_motion.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"

namespace crackle {
namespace {

BodyState body_at_last_pass(const World& world, BodyIndex b) {
    BodyState body = world.bodies.state[b];
    if (world.stepping.forces_current) return body;
    const double drift = world.stepping.drift, turn = drift * body.omega;
    body.x -= drift * body.vx;
    body.y -= drift * body.vy;
    body.angle -= turn;
    if (world.bodies.names[b].shape == no_shape) return body;
    const double c = body.shape[0], s = body.shape[1], q = turn * turn;
    double cosine = 1.0 - q * (0.5 - q * (1.0 / 24.0 - q / 720.0)),
           sine =
               turn *
               (1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q / 5040.0)));  // same polynomials as in motion_kernels.cpp
    if (std::abs(turn) >= 0.01) {
        cosine = correctly_rounded::cos(turn);
        sine = correctly_rounded::sin(turn);
    }
    body.shape[0] = c * cosine + s * sine;
    body.shape[1] = s * cosine - c * sine;
    return body;
}

template <PointKind K>
PointLoad load_of_kind(const World& world, PointIndex k) {
    const ContactPoint point = world.points.contact.at<K>(k);
    const BodyState i = body_at_last_pass(world, point.body_i);
    const BodyState j = K == PointKind::element_wall ? i : body_at_last_pass(world, point.body_j);
    std::uint32_t feature = point.feature_j;
    const ContactGeometry g = contact_geometry<K>(BodyView(world), point, i, j, feature);
    const bool bonded = (world.points.state[k].flags & point_bonded) != 0;
    PointLoad load{{}, {i.x + g.aix, i.y + g.aiy}, {g.nx, g.ny}};
    if (!bonded && !(g.overlap > world.points.bond_overlap[k])) return load;
    const double normal = law_of(world, k).normal_stiffness * (g.overlap - world.points.bond_overlap[k]);
    load.force = world.points.shear_force[k] * perpendicular(load.normal) - normal * load.normal;
    return load;
}

}  // namespace

PointLoad load_of_last_pass(const World& world, PointIndex k) {
    PointLoad load;
    visit_kinds(world.points.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        if (k >= begin && k < end) load = load_of_kind<K>(world, k);
    });
    return load;
}

PointLoad end_load_of_last_pass(const World& world, FaceIndex face, bool at_start) {
    const Faces& faces = world.faces;
    const BondFaceMotion m = faces.motion[face];
    const FacePlace place = faces.place[face];
    const BodyState body = body_at_last_pass(world, faces.bodies[face].body_i);
    const Vec2 along = perpendicular(m.normal), arm = turned_by(body, place.arm_i);
    const double length = faces.springs[face].length, side = at_start ? -0.5 : 0.5;
    const FaceForces force = forces_of_face(faces, face);
    // The moment turns body i from the normal's direction at the start towards that at the end of the face.
    const double normal = 0.5 * force.normal - 2.0 * side * force.moment / length;
    return {normal * m.normal + 0.5 * force.shear * along,
            Vec2{body.x, body.y} + arm + 0.5 * m.opening * m.normal + (0.5 * m.sliding + side * length) * along,
            m.normal};
}

double time_of_last_pass(const World& world) {
    return world.stepping.forces_current ? world.stepping.time : world.stepping.time - world.stepping.drift;
}

}  // namespace crackle
