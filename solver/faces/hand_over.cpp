// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/hand_over.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/joint_law.hpp"
#include "solver/faces/broken_face.hpp"
#include "solver/geometry/contact_share.hpp"
#include "solver/geometry/face_motion.hpp"
#include "solver/geometry/geometry.hpp"

namespace crackle {
namespace {

// Relative rotations between which contact points gradually replace a broken face, rad. The springs of a face use φ in
// place of 2 sin(φ/2). At φ₁ (last_turn), the ends of an edge of length L are therefore misplaced by L φ₁³/48, about
// 1e-6 L.
constexpr double first_turn = 0.02, last_turn = 0.04;
constexpr double turn_ahead = 0.005;  // rad, margin below first_turn within which contact points are already listed

/// Smallest fraction of the full stiffness of a contact point. It is not 0, so that ratios of stiffnesses stay finite.
constexpr float least_share = 1e-6F;

FaceIndex face_between(const World& world, BodyIndex i, BodyIndex j) {
    const Faces& faces = world.faces;
    if (faces.size() == 0) return no_face;
    for (std::uint32_t e = faces.first_face[i]; e < faces.first_face[i + 1]; ++e) {
        const FaceIndex k = faces.face_ends[e] / 2;
        const BodyPair& pair = faces.bodies[k];
        if (pair.body_i == j || pair.body_j == j) return k;
    }
    return no_face;
}

/// Changes the stiffness of a contact point without moving it; the forces of the point change in proportion. @return
/// energy that the point loses, J
double change_share(World& world, const BodyView& bodies, PointIndex p, float share) {
    Points& points = world.points;
    const double ratio = static_cast<double>(share) / static_cast<double>(points.stiffness_share[p]);
    double lost = 0.0;
    if ((points.state[p].flags & point_touching) != 0) {
        const ContactLaw law = law_of(world, p);
        const double overlap =
            std::max(0.0, overlap_at<PointKind::element_outline>(bodies, points.contact[p]) - points.bond_overlap[p]);
        const double shear = points.shear_force[p];
        const double energy = 0.5 * law.normal_stiffness * overlap * overlap +
                              (law.shear_stiffness > 0.0 ? 0.5 * shear * shear / law.shear_stiffness : 0.0);
        lost = (1.0 - ratio) * energy;
    }
    points.stiffness_share[p] = share;
    points.shear_force[p] *= ratio;
    points.root_mass[p] *= std::sqrt(ratio);
    return lost;
}

/// Whether the edges of a face lie opposite each other without touching, at a distance of more than `thick`, m.
bool have_parted(const FaceSprings& s, const BondFaceMotion& m, double thick) {
    return m.opening > thick + half_lap_of(s, m) * std::abs(m.turn);
}

}  // namespace

double share_of_points(const FaceSprings& s, const BondFaceMotion& m, double thick) {
    const double lap = 2.0 * half_lap_of(s, m);
    const double by_lap = std::min(1.0, lap / std::min(2.0 * thick, s.length));
    const double by_turn = std::clamp((last_turn - std::abs(m.turn)) / (last_turn - first_turn), 0.0, 1.0);
    return 1.0 - by_lap * by_turn;
}

void rest_new_points(World& world, const std::function<bool(PointIndex)>& is_new) {
    constexpr auto kind = static_cast<std::size_t>(PointKind::element_outline);
    const BodyView bodies(world);
    for (PointIndex k = world.points.kind_begin[kind]; k < world.points.kind_begin[kind + 1]; ++k) {
        const ContactPoint point = world.points.contact[k];
        if (!is_new(k) || face_between(world, point.body_i, point.body_j) == no_face) continue;
        world.points.bond_overlap[k] = std::max(0.0, overlap_at<PointKind::element_outline>(bodies, point));
    }
}

bool face_replaces_points(const World& world, BodyIndex i, BodyIndex j) {
    const FaceIndex k = face_between(world, i, j);
    if (k == no_face) return false;
    const Faces& faces = world.faces;
    const FaceIndex broken = faces.broken_at[k];
    if (broken == no_face) return true;
    if (faces.broken[broken].retired) return false;
    const FaceSprings s = faces.springs[k];
    const BondFaceMotion m = motion_of(faces.place[k], world.bodies.state[faces.bodies[k].body_i],
                                       world.bodies.state[faces.bodies[k].body_j]);
    // With these margins on sliding and rotation, contact points are listed before they are needed. Few faces then
    // require an additional rebuild of the neighbour list.
    BondFaceMotion least = m;
    least.sliding = std::abs(m.sliding) + world.list.half_skin_of(i) + world.list.half_skin_of(j);
    least.turn = std::abs(m.turn) + turn_ahead;
    return share_of_points(s, least, world.settings.thick) <= 0.0;
}

void list_hand_over(World& world) {
    constexpr auto kind = static_cast<std::size_t>(PointKind::element_outline);
    Faces& faces = world.faces;
    for (BrokenFace& face : faces.broken) {
        const auto [i, j] = faces.bodies[face.face];
        face.alone = face_replaces_points(world, i, j);
    }
    faces.hand_over.clear();
    faces.whole_share.clear();
    const PointIndex last = world.points.kind_begin[kind + 1];
    for (PointIndex begin = world.points.kind_begin[kind], end = begin; begin < last; begin = end) {
        const ContactPoint pair = world.points.contact[begin];
        while (end < last && same_pair(world.points.contact[end], pair)) ++end;
        const FaceIndex k = face_between(world, pair.body_i, pair.body_j);
        if (k == no_face) continue;
        if (faces.whole_share.empty()) faces.whole_share.assign(world.points.size(), 0.0F);
        faces.hand_over.push_back({k, begin, end});
        for (PointIndex p = begin; p < end; ++p) {
            const ContactShare share = share_of_contact(world, PointKind::element_outline, world.points.contact[p]);
            faces.whole_share[p] =
                static_cast<float>(share.stiffness() * series_shares(world, p, share.distance).normal);
        }
    }
}

void hand_over(World& world) {
    Faces& faces = world.faces;
    for (BrokenFace& face : faces.broken) {
        const FaceSprings springs = faces.springs[face.face];
        const BondFaceMotion motion = faces.motion[face.face];
        face.taken = share_of_points(springs, motion, world.settings.thick);
        if (face.taken == 1.0)
            face.retired = true;
        else if (face.retired && have_parted(springs, motion, world.settings.thick))
            face.retired = false;
        if (face.retired) face.taken = 1.0;
        if (face.alone && face.taken > 0.0) world.list.valid = false;  // this pair's contact points are not listed
    }
    if (faces.hand_over.empty()) return;
    const BodyView bodies(world);
    double lost = 0.0;
    for (const HandOver& one : faces.hand_over) {
        const FaceIndex broken = faces.broken_at[one.face];
        const float taken = broken == no_face ? 0.0F : static_cast<float>(faces.broken[broken].taken);
        for (PointIndex p = one.begin; p < one.end; ++p) {
            const float share = faces.whole_share[p] * std::max(least_share, taken);
            if (share != world.points.stiffness_share[p]) lost += change_share(world, bodies, p, share);
        }
    }
    world.account.friction_loss += lost;
}

}  // namespace crackle
