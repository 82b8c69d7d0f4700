// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/neighbours/point_lists.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "solver/faces/hand_over.hpp"
#include "solver/geometry/across_joint.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/neighbours/near_pairs.hpp"
#include "solver/world/point_order.hpp"

namespace crackle {
namespace {

ContactPoint new_point(BodyIndex i, BodyIndex j, std::uint32_t element, std::uint32_t feature) {
    ContactPoint point{};
    point.body_i = i;
    point.body_j = j;
    point.element_i = element;
    point.feature_j = feature;
    return point;
}

/// Lists the contact of two single circles. Circles on opposite sides of a joint touch only through their flat faces.
void add_single_circles(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    if (!world.bodies.flat_faces.empty() && trace_between(world, i, j)) return;
    const BodyState &a = world.bodies.state[i], &b = world.bodies.state[j];
    if (norm(centre_of(b) - centre_of(a)) > a.shape[0] + b.shape[0] + skin_between(world, i, j)) return;
    lists[static_cast<std::size_t>(PointKind::circle_circle)].push_back(new_point(i, j, own_circle, own_circle));
}

/// Lists contacts between the circles of two bodies, at least one of which is a clump.
void add_circle_pairs(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo a = world.bodies.info(i), b = world.bodies.info(j);
    const BodyView bodies(world);
    const double skin = skin_between(world, i, j);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Element own = element_of(bodies, i, p);
        const Vec2 centre = centre_of(world.bodies.state[i]) + turned(world.bodies.state[i], own);
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            const Element partner = element_of(bodies, j, q);
            const Vec2 other = centre_of(world.bodies.state[j]) + turned(world.bodies.state[j], partner);
            if (norm(other - centre) > own.radius + partner.radius + skin) continue;
            lists[static_cast<std::size_t>(PointKind::element_element)].push_back(new_point(i, j, p, q));
        }
    }
}

/// Lists contacts of the elements of i with the outline of j.
void add_outline_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo a = world.bodies.info(i), b = world.bodies.info(j);
    const BodyView bodies(world);
    const BodyState &own = world.bodies.state[i], &target = world.bodies.state[j];
    const double skin = skin_between(world, i, j);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Element element = element_of(bodies, i, p);
        const Vec2 w = centre_of(own) + turned(own, element) - centre_of(target);
        const double limit = element.radius + element.target_reach + skin;
        if (dot(w, w) > (b.reach + limit) * (b.reach + limit)) continue;
        const double c = target.shape[0], s = target.shape[1];
        const OutlineFacing facing = face_outline(bodies, b, b.first_piece, c * w.x + s * w.y, c * w.y - s * w.x);
        if (facing.distance > limit) continue;
        lists[static_cast<std::size_t>(PointKind::element_outline)].push_back(new_point(i, j, p, facing.edge));
    }
}

/// Lists contacts of the circles of i with the segments of j under the DEMseg guide's segment law.
void add_circle_segment_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo a = world.bodies.info(i), b = world.bodies.info(j);
    const BodyView bodies(world);
    const BodyState& own = world.bodies.state[i];
    const Vec2 to_j = centre_of(world.bodies.state[j]) - centre_of(own);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        const Element circle = element_of(bodies, i, p);
        const Vec2 centre = turned(own, circle);
        const double limit = circle.radius + world.settings.thick + skin_between(world, i, j);
        if (norm(centre - to_j) > b.reach + limit) continue;
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            if (world.bodies.segments[q].length == 0.0) continue;
            const DiscCase found = disc_case(bar_of(bodies, world.bodies.state[j], q, to_j), centre, limit);
            if (found.rule == DiscRule::none) continue;
            lists[static_cast<std::size_t>(PointKind::disc_segment)].push_back(new_point(i, j, p, q));
        }
    }
}

/// Lists contacts between segments of i and j under the DEMseg guide's segment law. A contact exists if an end of one
/// segment is close to the other segment.
void add_segment_pairs(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const BodyInfo a = world.bodies.info(i), b = world.bodies.info(j);
    const BodyView bodies(world);
    const Vec2 to_j = centre_of(world.bodies.state[j]) - centre_of(world.bodies.state[i]);
    const double limit = world.settings.thick + skin_between(world, i, j);
    for (std::uint32_t p = a.first_element; p < a.first_element + a.element_count; ++p) {
        if (world.bodies.segments[p].length == 0.0) continue;
        const Bar own = bar_of(bodies, world.bodies.state[i], p, {});
        if (std::sqrt(disc_case(own, to_j, 0.0).squared_distance) > b.reach + limit) continue;
        for (std::uint32_t q = b.first_element; q < b.first_element + b.element_count; ++q) {
            if (world.bodies.segments[q].length == 0.0) continue;
            const Bar other = bar_of(bodies, world.bodies.state[j], q, to_j);
            const auto near = [&](const Bar& bar, Vec2 end) {
                return disc_case(bar, end, 0.0).squared_distance < limit * limit;
            };
            if (near(other, own.start) || near(other, own.start + own.length * own.along) || near(own, other.start) ||
                near(own, other.start + other.length * other.along))
                lists[static_cast<std::size_t>(PointKind::segment_segment)].push_back(new_point(i, j, p, q));
        }
    }
}

/// Lists the contacts of two bodies under the DEMseg guide's segment law. @param i, j bodies, at least one of which is
/// a chain
void add_guide_points(const World& world, BodyIndex i, BodyIndex j, PointLists& lists) {
    const bool chain_i = world.bodies.info(i).piece_count > 0, chain_j = world.bodies.info(j).piece_count > 0;
    if (chain_i && chain_j) {
        add_segment_pairs(world, i, j, lists);
    } else if (chain_j) {
        add_circle_segment_points(world, i, j, lists);
    } else {
        add_circle_segment_points(world, j, i, lists);
    }
}

void add_wall_points(const World& world, BodyIndex i, PointLists& lists) {
    const BodyInfo info = world.bodies.info(i);
    const BodyView bodies(world);
    const BodyState& body = world.bodies.state[i];
    const Domain& d = world.settings.domain;
    const bool chain = info.piece_count > 0;
    const double skin = skin_between(world, i, i);
    for (std::uint32_t wall = 0; wall < 4; ++wall) {
        if (!d.wall_present[wall]) continue;
        const double whole = wall == 0   ? body.x - d.x1
                             : wall == 1 ? d.x2 - body.x
                             : wall == 2 ? body.y - d.y1
                                         : d.y2 - body.y;
        if (whole > info.reach + skin) continue;
        for (std::uint32_t p = info.first_element; p < info.first_element + info.element_count; ++p) {
            const Element element = element_of(bodies, i, p);
            const Vec2 o = turned(body, element);
            const double distance = whole + (wall == 0 ? o.x : wall == 1 ? -o.x : wall == 2 ? o.y : -o.y);
            if (distance > (chain ? 0.0 : element.radius) + skin) continue;
            ContactPoint point{};
            point.body_i = i;
            point.body_j = wall;
            point.element_i = p;
            point.feature_j = chain ? 1 : 0;
            lists[static_cast<std::size_t>(PointKind::element_wall)].push_back(point);
        }
    }
}

/// Whether the contacts between two bodies are omitted because both bodies are driven (DrivenContacts).
bool left_out(const World& world, BodyIndex i, BodyIndex j) {
    const DrivenContacts wanted = world.settings.driven_contacts;
    if (wanted == DrivenContacts::all) return false;
    const bool held = world.bodies.inertia[i].held() && world.bodies.inertia[j].held();
    if (held || wanted == DrivenContacts::unless_held) return held;
    const auto driven = [&](BodyIndex b) {
        return std::ranges::any_of(world.bodies.controls, [&](const ControlState& c) { return c.body == b; });
    };
    return driven(i) && driven(j);
}

/// Current position of a flat face along the straight part of the trace on which it lies.
struct FaceNow {
    std::uint32_t piece;
    bool right;
    double from, to;  // m, extent of the face, widened by the half skin at each end
    std::uint32_t face;
};

/// Current positions of all faces, sorted by straight part of a trace and then along it.
std::vector<FaceNow> faces_now(const World& world) {
    std::vector<FaceNow> faces;
    faces.reserve(world.bodies.flat_faces.size());
    for (const FlatFace& face : world.bodies.flat_faces) {
        const BodyState& body = world.bodies.state[face.body];
        const double at = body.x * face.along_x + body.y * face.along_y, half = world.list.half_skin_of(face.body);
        faces.push_back({face.piece, (face.side & 1) != 0, at + face.from - half, at + face.to + half,
                         static_cast<std::uint32_t>(&face - world.bodies.flat_faces.data())});
    }
    std::ranges::sort(faces, {}, [](const FaceNow& f) { return std::tuple(f.piece, f.from, f.face); });
    return faces;
}

/// Lists pairs of flat faces that are close to each other and have a lap (shared length), or could have one before the
/// list is rebuilt.
void add_face_points(const World& world, PointLists& lists) {
    auto& list = lists[static_cast<std::size_t>(PointKind::face_face)];
    const BodyView bodies(world);
    const auto meet = [&](std::uint32_t one, std::uint32_t other) {
        const BodyIndex a = world.bodies.flat_faces[one].body, b = world.bodies.flat_faces[other].body;
        if (left_out(world, a, b)) return;
        const ContactPoint point = a < b ? new_point(a, b, one, other) : new_point(b, a, other, one);
        if (flat_face_contact(bodies, point).closed > -skin_between(world, a, b)) list.push_back(point);
    };
    const std::vector<FaceNow> faces = faces_now(world);
    std::vector<FaceNow>
        open[2];  // for each side of the trace, faces that extend beyond the current position of the sweep
    for (const FaceNow& face : faces) {
        const auto behind = [&](const FaceNow& other) { return other.piece != face.piece || other.to < face.from; };
        for (std::vector<FaceNow>& side : open) std::erase_if(side, behind);
        for (const FaceNow& other : open[face.right ? 0 : 1]) meet(face.face, other.face);
        open[face.right ? 1 : 0].push_back(face);
    }
    std::ranges::sort(list, {}, [](const ContactPoint& point) { return key_of(PointKind::face_face, point); });
}

}  // namespace

PointLists list_points(const World& world, const std::vector<std::uint64_t>& pairs) {
    PointLists lists;
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        const PointIndex listed = world.points.kind_begin[kind + 1] - world.points.kind_begin[kind];
        lists[kind].reserve(listed + listed / 64);  // memory for slightly more points than the current list has
    }
    for (const std::uint64_t pair : pairs) {
        const auto i = static_cast<BodyIndex>(pair >> 32), j = static_cast<BodyIndex>(pair & 0xffffffffu);
        if (left_out(world, i, j) || face_replaces_points(world, i, j)) continue;
        if (world.bodies.names[i].shape == no_shape && world.bodies.names[j].shape == no_shape) {
            add_single_circles(world, i, j, lists);
            continue;
        }
        const bool chain_i = world.bodies.info(i).piece_count > 0, chain_j = world.bodies.info(j).piece_count > 0;
        if (!chain_i && !chain_j) add_circle_pairs(world, i, j, lists);
        if (world.settings.segment_law != SegmentLaw::rounded) {
            if (chain_i || chain_j) add_guide_points(world, i, j, lists);
            continue;
        }
        if (chain_j) add_outline_points(world, i, j, lists);
        if (chain_i) add_outline_points(world, j, i, lists);
    }
    if (!world.bodies.flat_faces.empty()) add_face_points(world, lists);
    for (std::size_t b = 0; b < world.bodies.size(); ++b) add_wall_points(world, static_cast<BodyIndex>(b), lists);
    return lists;
}

}  // namespace crackle
