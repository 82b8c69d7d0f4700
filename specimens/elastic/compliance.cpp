// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/elastic/compliance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/correctly_rounded.hpp"
#include "solver/base/errors.hpp"
#include "solver/linear/elastic.hpp"
#include "solver/measure/point_view.hpp"

namespace crackle {
namespace {

/// Part of one side of the box covered by a body.
struct OuterFace {
    BodyIndex body;
    double from, to;  // m, along the side
    Vec2 middle, outwards;
};

struct Side {
    const char* name;
    bool upright;
    double at, low, high;  // m
    double outwards;       // 1 or -1
};

/// For each body, the number of its bonded or closed contact points with other bodies.
std::vector<int> bonds_of_bodies(const World& world) {
    std::vector<int> bonds(world.bodies.size(), 0);
    const PointIndex walls = world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
    for (PointIndex k = 0; k < walls; ++k) {
        if ((world.points.state[k].flags & (point_bonded | point_closed)) == 0) continue;
        ++bonds[world.points.contact.pairs[k].body_i];
        ++bonds[world.points.contact.pairs[k].body_j];
    }
    return bonds;
}

/// The faces of bodies on a side of the box. They are extended until they meet each other and the corners. A circle
/// that reaches the side has a face as wide as its diameter. Circles with fewer than two bonds are left out, since they
/// cannot carry a load.
std::vector<OuterFace> faces_on(const World& world, const Side& side, double inset) {
    const double near = inset + 1e-6 * (side.high - side.low);
    std::vector<OuterFace> faces;
    const std::vector<int> bonds = bonds_of_bodies(world);
    for (BodyIndex b = 0; b < world.bodies.size(); ++b) {
        const std::vector<Vec2> corners = element_positions(world, b);
        OuterFace face{b, side.high, side.low, {}, {}};
        if (const BodyInfo info = world.bodies.info(b); info.single_circle) {
            const Vec2 centre = corners.front();
            if (std::abs((side.upright ? centre.x : centre.y) - side.at) > info.reach + near) continue;
            if (bonds[b] < 2) continue;
            const double along = side.upright ? centre.y : centre.x;
            faces.push_back({b, along - info.reach, along + info.reach, {}, {}});
            continue;
        }
        int count = 0;
        for (const Vec2 corner : corners) {
            if (std::abs((side.upright ? corner.x : corner.y) - side.at) > near) continue;
            const double along = side.upright ? corner.y : corner.x;
            face.from = std::min(face.from, along);
            face.to = std::max(face.to, along);
            ++count;
        }
        if (count >= 2) faces.push_back(face);
    }
    if (faces.empty())
        throw InputError(
            fmt::format("compliance: found no edges on the {} side of the box, expected cells that end on it; fill the "
                        "box with cells (mesh.boundary = \"domain\")",
                        side.name));
    std::ranges::sort(faces, {}, &OuterFace::from);
    faces.front().from = side.low;
    faces.back().to = side.high;
    for (std::size_t k = 0; k + 1 < faces.size(); ++k)
        faces[k].to = faces[k + 1].from = 0.5 * (faces[k].to + faces[k + 1].from);
    for (OuterFace& face : faces) {
        const double along = 0.5 * (face.from + face.to);
        face.middle = side.upright ? Vec2{side.at, along} : Vec2{along, side.at};
        face.outwards = side.upright ? Vec2{side.outwards, 0.0} : Vec2{0.0, side.outwards};
    }
    return faces;
}

Vec2 centroid_of(const World& world, BodyIndex b) { return {world.bodies.state[b].x, world.bodies.state[b].y}; }

BodyIndex nearest_to_middle(const World& world, Vec2 middle) {
    BodyIndex nearest = 0;
    for (BodyIndex b = 1; b < world.bodies.size(); ++b)
        if (norm(centroid_of(world, b) - middle) < norm(centroid_of(world, nearest) - middle)) nearest = b;
    return nearest;
}

}  // namespace

Compliance compliance_of(const World& world, const Domain& box, double inset) {
    std::vector<OuterFace> faces;
    for (const Side& side : {Side{"left", true, box.x1, box.y1, box.y2, -1.0},
                             {"right", true, box.x2, box.y1, box.y2, 1.0},
                             {"lower", false, box.y1, box.x1, box.x2, -1.0},
                             {"upper", false, box.y2, box.x1, box.x2, 1.0}}) {
        const std::vector<OuterFace> on_side = faces_on(world, side, inset);
        faces.insert(faces.end(), on_side.begin(), on_side.end());
    }
    const double area = (box.x2 - box.x1) * (box.y2 - box.y1);
    const BodyIndex held = nearest_to_middle(world, {0.5 * (box.x1 + box.x2), 0.5 * (box.y1 + box.y2)});
    Compliance compliance{};
    for (std::size_t load = 0; load < 3; ++load) {
        const double xx = load == 0 ? 1.0 : 0.0, yy = load == 1 ? 1.0 : 0.0, xy = load == 2 ? 1.0 : 0.0;
        std::vector<BodyMotion> loads(world.bodies.size());
        for (const OuterFace& face : faces) {
            const Vec2 n = face.outwards, arm = face.middle - centroid_of(world, face.body);
            const Vec2 force = (face.to - face.from) * Vec2{xx * n.x + xy * n.y, xy * n.x + yy * n.y};
            loads[face.body].x += force.x;
            loads[face.body].y += force.y;
            loads[face.body].rotation += cross(arm, force);
        }
        const ElasticSolution solution = solve_elastic(world, {{held, {}}}, loads);
        for (const OuterFace& face : faces) {
            const BodyMotion& motion = solution.displacement[face.body];
            const Vec2 arm = face.middle - centroid_of(world, face.body), n = face.outwards;
            const Vec2 u{motion.x - motion.rotation * arm.y, motion.y + motion.rotation * arm.x};
            const double share = (face.to - face.from) / area;
            compliance[0][load] += share * u.x * n.x;
            compliance[1][load] += share * u.y * n.y;
            compliance[2][load] += share * (u.x * n.y + u.y * n.x);
        }
    }
    return compliance;
}

Compliance compliance_of_set(double angle, double spacing, double normal_stiffness, double shear_stiffness) {
    const Vec2 n{-correctly_rounded::sin(angle), correctly_rounded::cos(angle)};
    Compliance compliance{};
    for (std::size_t load = 0; load < 3; ++load) {
        const double xx = load == 0 ? 1.0 : 0.0, yy = load == 1 ? 1.0 : 0.0, xy = load == 2 ? 1.0 : 0.0;
        const Vec2 traction{xx * n.x + xy * n.y, xy * n.x + yy * n.y};
        const double pull = dot(traction, n);
        const Vec2 jump = (pull / normal_stiffness) * n + (1.0 / shear_stiffness) * (traction - pull * n);
        compliance[0][load] = jump.x * n.x / spacing;
        compliance[1][load] = jump.y * n.y / spacing;
        compliance[2][load] = (jump.x * n.y + jump.y * n.x) / spacing;
    }
    return compliance;
}

}  // namespace crackle
