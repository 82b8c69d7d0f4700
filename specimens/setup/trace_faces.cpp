// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/setup/trace_faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/base/correctly_rounded.hpp"
#include "solver/geometry/across_joint.hpp"
#include "solver/geometry/contact_share.hpp"
#include "solver/geometry/face_motion.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

Vec2 turned(Vec2 v, double angle) {
    const double c = correctly_rounded::cos(angle), s = correctly_rounded::sin(angle);
    return c * v + s * perpendicular(v);
}

std::pair<BodyIndex, BodyIndex> ordered(BodyIndex i, BodyIndex j) { return {std::min(i, j), std::max(i, j)}; }

std::pair<BodyIndex, BodyIndex> pair_of(const TraceFace& face) { return {face.i, face.j}; }

/// Outward unit normal of a polygon's edge. Contact normals are not used: they are inclined where corners overhang.
Vec2 outwards(const World& world, BodyIndex body, std::uint32_t edge) {
    const std::vector<Vec2> corners = element_positions(world, body);
    const Vec2 along = corners[(edge + 1) % corners.size()] - corners[edge];
    return (-1.0 / norm(along)) * perpendicular(along);
}

/// The face of the pair whose contact points are [begin, end); empty if it lies on no trace.
std::optional<TraceFace> face_of(const World& world, PointIndex begin, PointIndex end) {
    TraceFace face;
    std::tie(face.i, face.j) = ordered(world.points.contact[begin].body_i, world.points.contact[begin].body_j);
    double overlap = 0.0;  // m, largest over the face's points
    std::int64_t points = 0;
    Vec2 normal;
    for (PointIndex k = begin; k < end; ++k) {
        const std::uint16_t flags = world.points.state[k].flags;
        if ((flags & (point_bonded | point_had_bond)) == 0) continue;
        const PointView view = view_point(world, k);
        overlap = points == 0 ? view.overlap : std::max(overlap, view.overlap);
        ++points;
        face.bonds += (flags & point_bonded) != 0 ? 1 : 0;
        normal = normal + (view.body_i == face.i ? 1.0 : -1.0) * view.normal;
        face.middle = face.middle + view.position;
    }
    if (points == 0) return std::nullopt;
    const double gap = world.settings.thick - overlap;
    const std::optional<std::int32_t> trace = trace_of_face(world, face.i, face.j, gap);
    if (!trace) return std::nullopt;
    const std::optional<ContactShare> share = share_of_face(world, face.i, face.j, gap);
    face.trace = *trace;
    face.length = share ? share->length : 0.0;  // 0 for a contact of two corners
    face.normal = share ? outwards(world, face.i, share->edge_i) : (1.0 / norm(normal)) * normal;
    face.middle = (1.0 / static_cast<double>(points)) * face.middle;
    return face;
}

/// The face between two circles whose flat faces meet. Where traces cross, the face on the first trace is used.
std::optional<TraceFace> flat_face_of(const World& world, PointIndex begin, PointIndex end) {
    TraceFace face;
    for (PointIndex k = begin; k < end; ++k) {
        const std::uint16_t flags = world.points.state[k].flags;
        if ((flags & (point_bonded | point_had_bond)) == 0) continue;
        const ContactPoint point = world.points.contact[k];
        const FlatFace &i = world.bodies.flat_faces[point.element_i], &j = world.bodies.flat_faces[point.feature_j];
        const FlatFaceContact g = flat_face_contact(BodyView(world), point);
        face.bonds += (flags & point_bonded) != 0 ? 1 : 0;
        if (face.length == 0.0) {
            std::tie(face.i, face.j) = ordered(point.body_i, point.body_j);
            face.trace = trace_of(i.side);
            face.normal = (point.body_i == face.i ? 1.0 : -1.0) * Vec2{g.nx, g.ny};
            const Vec2 along{i.along_x, i.along_y}, apart{2.0 * g.aix, 2.0 * g.aiy};
            const double offset = dot(apart, along);  // m, distance from i's centre to j's along the face
            const double middle = 0.5 * (std::max(i.from, offset + j.from) + std::min(i.to, offset + j.to));
            const BodyState& body = world.bodies.state[point.body_i];
            face.middle = Vec2{body.x, body.y} + middle * along + i.height * Vec2{g.nx, g.ny};
        }
        face.length += g.lap();
    }
    return face.length > 0.0 ? std::optional(face) : std::nullopt;
}

/// A bonded face of a world, if it lies on a trace.
std::optional<TraceFace> trace_face_of(const World& world, FaceIndex k) {
    TraceFace face;
    face.i = world.faces.bodies[k].body_i;
    face.j = world.faces.bodies[k].body_j;
    const std::optional<std::int32_t> trace = trace_of_face(world, face.i, face.j, world.settings.thick);
    if (!trace) return std::nullopt;
    const FacePlace place = world.faces.place[k];
    const BodyState& body = world.bodies.state[face.i];
    face.trace = *trace;
    face.bonds = world.faces.broken_at[k] == no_face ? 1 : 0;
    face.length = world.faces.springs[k].length;
    face.normal = turned_by(body, place.normal_i);
    face.middle = Vec2{body.x, body.y} + turned_by(body, place.arm_i);
    return face;
}

}  // namespace

FaceMotion motion_of(const TraceFace& face, const FacePlaces& start, const FacePlaces& now) {
    const double turn_i = now.i.angle - start.i.angle, turn_j = now.j.angle - start.j.angle;
    const auto carried = [](const StartPlace& from, const StartPlace& to, double turn, Vec2 p) {
        return Vec2{to.x, to.y} + turned(p - Vec2{from.x, from.y}, turn);
    };
    const auto on_i = [&](Vec2 p) { return carried(start.i, now.i, turn_i, p); };
    const auto on_j = [&](Vec2 p) { return carried(start.j, now.j, turn_j, p); };
    const auto mean = [&](Vec2 p) { return 0.5 * (on_i(p) + on_j(p)); };
    const Vec2 apart = on_j(face.middle) - on_i(face.middle), normal = turned(face.normal, 0.5 * (turn_i + turn_j));
    const Vec2 half = 0.5 * face.length * perpendicular(face.normal);
    return {dot(apart, normal), dot(apart, perpendicular(normal)), mean(face.middle - half), mean(face.middle + half)};
}

std::vector<TraceFace> find_trace_faces(const World& world) {
    std::vector<TraceFace> faces;
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex begin = 0, end = 0; begin < walls; begin = end) {
        end = points_between(world, begin).second;
        const bool flat = view_point(world, begin).kind == PointKind::face_face;
        const std::optional<TraceFace> face = (flat ? flat_face_of : face_of)(world, begin, end);
        if (face) faces.push_back(*face);
    }
    for (FaceIndex k = 0; k < world.faces.size(); ++k)
        if (const std::optional<TraceFace> face = trace_face_of(world, k)) faces.push_back(*face);
    std::ranges::sort(faces, {}, pair_of);
    return faces;
}

std::vector<std::int32_t> faces_of_bonds(const std::vector<TraceFace>& faces, const ContactList& bonds) {
    std::vector<std::int32_t> numbers;
    numbers.reserve(bonds.size());
    for (const BodyPair& bond : bonds.pairs) {
        const auto pair = ordered(bond.body_i, bond.body_j);
        const auto found = std::ranges::lower_bound(faces, pair, {}, pair_of);
        const bool on_trace = found != faces.end() && pair_of(*found) == pair;
        numbers.push_back(on_trace ? static_cast<std::int32_t>(found - faces.begin()) : -1);
    }
    return numbers;
}

}  // namespace crackle
