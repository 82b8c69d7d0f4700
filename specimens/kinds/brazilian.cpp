// SPDX-License-Identifier: GPL-3.0-or-later
// The Brazilian test: a disc of diameter D is loaded along y by two opposite arcs of half angle α.
//
// Tensile stress at the centre (Hondros, Aust. J. Appl. Sci. 10, 1959; ISRM 1978):
//       σ_t = k 2P/(πD),   k = (sin 2α - α)/sin α: 0.991, 0.965, 0.920 at α = 5, 10, 15 degrees
// With flat and curved jaws, k = 1. Hence section = πD/(2k) and length = D; the strain is the shortening of the
// diameter divided by D. The outline is a polygon with sides about one particle long and with corners where the arcs
// end.
// Tested by tests/specimens/kinds/test_kind_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
// Radius of a curved jaw divided by that of the disc (ISRM 1978); half-width of the jaw's face divided by its radius.
constexpr double jaw_radius = 1.5, jaw_half_width = 0.5;
constexpr int jaw_sides = 40;
constexpr double jaw_depth = 0.2;  // height of the back of a jaw above the disc, relative to the disc's radius
constexpr double flat_jaw_half_width = 0.75;  // half-width of a flat jaw, relative to the disc's radius

Vec2 on_circle(Vec2 centre, double radius, double angle) {
    return {centre.x + radius * correctly_rounded::cos(angle), centre.y + radius * correctly_rounded::sin(angle)};
}

Vec2 centre_of(const Domain& box) { return {0.5 * (box.x1 + box.x2), 0.5 * (box.y1 + box.y2)}; }

/// Number of sides of a polygonal arc; each is about one particle long.
int sides_of_arc(double angle, double radius, double particle, int fewest) {
    return std::max(fewest, static_cast<int>(std::lround(angle * radius / particle)));
}

/// Points along an arc, including both ends.
std::vector<Vec2> arc(Vec2 centre, double radius, double from, double to, int sides) {
    std::vector<Vec2> places;
    for (int k = 0; k <= sides; ++k)
        places.push_back(on_circle(centre, radius, from + (to - from) * static_cast<double>(k) / sides));
    return places;
}

/// The upper jaw; the points of its face are given from left to right.
LoadingPart upper_jaw(std::vector<Vec2> face, double top) {
    LoadingPart jaw;
    jaw.face = static_cast<std::uint32_t>(face.size());
    const double left = face.front().x, right = face.back().x;
    jaw.corners = std::move(face);
    jaw.corners.push_back({right, top});
    jaw.corners.push_back({left, top});
    return jaw;
}

/// A part rotated by 180° about a centre.
LoadingPart turned(const LoadingPart& part, Vec2 centre) {
    LoadingPart other = part;
    for (Vec2& corner : other.corners) corner = {2.0 * centre.x - corner.x, 2.0 * centre.y - corner.y};
    return other;
}

/// The face of the upper jaw if it is bonded to the disc; its sides are parallel to those of the outline.
std::vector<Vec2> bonded_face(const KindRequest& request, Vec2 centre, double radius, double alpha) {
    return arc(centre, radius + request.cut_offset, quarter + alpha, quarter - alpha,
               sides_of_arc(2.0 * alpha, radius, request.particle, 2));
}

/// The face of an upper jaw that just touches the specimen from above.
/// @param upside_down  whether the face is meant for the lower jaw; the specimen is then treated as rotated by 180°
/// about the centre
std::vector<Vec2> touching_face(const KindRequest& request, Vec2 centre, double radius, double alpha,
                                bool upside_down) {
    const JawShape jaws = request.test.loading.jaws;
    const bool flat = jaws == JawShape::flat, curved = jaws == JawShape::curved;
    double farthest = 0.0;  // m; largest distance of a surface point from the centre
    for (const SurfacePoint& point : request.surface)
        farthest = std::max(farthest, norm(point.place - centre) + point.reach);
    // Chords lie inside the arc: the distance of their midpoints from the centre is the radius times the cosine of half
    // the angle of a side.
    const double half = curved ? correctly_rounded::asin(jaw_half_width / jaw_radius) : alpha;
    const double inner = correctly_rounded::cos(half / jaw_sides);
    const double curve = curved ? jaw_radius * radius : farthest / inner;
    const double half_width = flat ? flat_jaw_half_width * radius : curve * correctly_rounded::sin(half);
    double height = -std::numeric_limits<double>::infinity();  // m; y of the flat face, or of the arc's centre
    for (const SurfacePoint& point : request.surface) {
        const double side = upside_down ? -1.0 : 1.0;
        const double x = side * (point.place.x - centre.x), y = side * (point.place.y - centre.y);
        if (y < 0.0 || std::abs(x) > half_width + point.reach) continue;
        const double clear = curve * inner - point.reach;
        height = std::max(height, flat ? y + point.reach : y - std::sqrt(std::max(0.0, clear * clear - x * x)));
    }
    if (flat) return {{centre.x - half_width, centre.y + height}, {centre.x + half_width, centre.y + height}};
    return arc({centre.x, centre.y + height}, curve, quarter + half, quarter - half, jaw_sides);
}

}  // namespace

double brazilian_factor(double alpha) {
    return (correctly_rounded::sin(2.0 * alpha) - alpha) / correctly_rounded::sin(alpha);
}

double disc_diameter(const KindRequest& request, double room) {
    const double width = request.packing.x2 - request.packing.x1, height = request.packing.y2 - request.packing.y1;
    const double diameter = request.test.shape.diameter.value_or(room);
    if (diameter > room * (1.0 + 1e-12)) {
        request.refuse(CaseKey::shape_diameter, fmt::format("{} m", diameter),
                       fmt::format("at most {:.6g} m, because the packing is {:.6g} m wide and {:.6g} m high", room,
                                   width, height),
                       "use a larger packing, or a smaller disc");
    }
    return diameter;
}

namespace {

Shape brazilian_shape(const KindRequest& request) {
    const Domain& box = request.packing;
    const double diameter = disc_diameter(request, std::min(box.x2 - box.x1, box.y2 - box.y1));
    const double radius = 0.5 * diameter, alpha = half_angle(request);
    const Vec2 centre = centre_of(request.packing);
    const int of_jaw = sides_of_arc(2.0 * alpha, radius, request.particle, 2);
    const int of_side = sides_of_arc(2.0 * (quarter - alpha), radius, request.particle, 4);
    Shape shape;
    const auto add = [&](double from, double to, int sides) {
        std::vector<Vec2> places = arc(centre, radius, from, to, sides);
        places.pop_back();  // the next arc starts at this point
        shape.outline.insert(shape.outline.end(), places.begin(), places.end());
    };
    add(-quarter + alpha, quarter - alpha, of_side);
    add(quarter - alpha, quarter + alpha, of_jaw);
    add(quarter + alpha, 3.0 * quarter - alpha, of_side);
    add(3.0 * quarter - alpha, 3.0 * quarter + alpha, of_jaw);
    shape.width = shape.height = diameter;
    const double near = 2.0 * request.particle;  // size of the gauge regions at the ends of the horizontal diameter
    shape.left = Region{centre.x - radius - near, centre.x - radius + near, centre.y - near, centre.y + near};
    shape.right = Region{centre.x + radius - near, centre.x + radius + near, centre.y - near, centre.y + near};
    return shape;
}

Apparatus brazilian_apparatus(const KindRequest& request, const Shape& shape) {
    const double diameter = shape.width, radius = 0.5 * diameter, alpha = half_angle(request);
    const Vec2 centre = centre_of(request.packing);
    const bool bonded = request.test.loading.platens != PlatenKind::frictional;
    const double top = centre.y + (1.0 + jaw_depth) * radius;
    const auto jaw = [&](bool lower) {
        LoadingPart part = upper_jaw(
            bonded ? bonded_face(request, centre, radius, alpha) : touching_face(request, centre, radius, alpha, lower),
            top);
        part.x = part.y = part.rotation = {Drive::velocity, 0.0};
        return lower ? turned(part, centre) : part;
    };
    Apparatus apparatus;
    apparatus.parts = {jaw(true), jaw(false)};
    const bool over_an_arc = bonded || request.test.loading.jaws == JawShape::arc;
    apparatus.section = 0.5 * std::numbers::pi * diameter / (over_an_arc ? brazilian_factor(alpha) : 1.0);
    apparatus.length = diameter;
    return apparatus;
}

constexpr std::array brazilian_keys{KindKey{"shape.diameter"}, KindKey{"loading.half_angle"}, KindKey{"loading.jaws"}};

}  // namespace

extern constexpr TestKind brazilian_kind{.curve = {"tensile stress at the centre", "shortening of the diameter"},
                                         .keys = brazilian_keys,
                                         .valid_failure = ValidFailure::splits_disc,
                                         .driver = "upper jaw",
                                         .support = "lower jaw",
                                         .shape = brazilian_shape,
                                         .apparatus = brazilian_apparatus};

}  // namespace crackle
