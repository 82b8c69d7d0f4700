// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/kinds/test_kind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

// Width of a pad relative to the depth of a beam or the radius of a half disc, and smallest width in particle sizes.
// Narrower pads would push single grains into the specimen.
constexpr double pad_share = 0.1, fewest_particles_of_a_pad = 2.0;

double side_of(Vec2 a, Vec2 b, Vec2 p) { return cross(b - a, p - a); }

}  // namespace

bool Notch::parts(Vec2 a, Vec2 b) const {
    const bool across = side_of(mouth, tip, a) * side_of(mouth, tip, b) < 0.0;
    return across && side_of(a, b, mouth) * side_of(a, b, tip) < 0.0;
}

double Notch::distance(Vec2 place) const {
    const Vec2 way = tip - mouth, from = place - mouth;
    return norm(from - std::clamp(dot(from, way) / dot(way, way), 0.0, 1.0) * way);
}

double Shape::area(const Domain& box) const {
    if (outline.empty()) return (box.x2 - box.x1) * (box.y2 - box.y1);
    double twice = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * twice;
}

bool Shape::holds(Vec2 place) const {
    for (std::size_t k = 0; k < outline.size(); ++k)
        if (side_of(outline[k], outline[k + 1 == outline.size() ? 0 : k + 1], place) < 0.0) return false;
    return true;
}

void KindRequest::refuse(CaseKey key, const std::string& found, const std::string& expected,
                         const std::string& remedy) const {
    throw InputError(fmt::format("{}: found {}, expected {}; {}", test.at(key), found, expected, remedy));
}

#define CRACKLE_DECLARED(name) extern const TestKind name##_kind;
#define CRACKLE_ADDRESS(name) &name##_kind,
CRACKLE_TEST_KINDS(CRACKLE_DECLARED)

const TestKind& test_kind(LoadingKind kind) {
    static constexpr std::array all{CRACKLE_TEST_KINDS(CRACKLE_ADDRESS)};
    return *all[static_cast<std::size_t>(kind)];
}

std::string kinds_with(const std::function<bool(const TestKind&)>& is) {
    std::vector<std::string> names;
    for (const std::string& name : names_of<LoadingKind>())
        if (is(test_kind(*from_name<LoadingKind>(name)))) names.push_back(fmt::format("\"{}\"", name));
    const std::string last = names.back();
    names.pop_back();
    return names.empty() ? last : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

double half_angle(const KindRequest& request) { return request.test.loading.half_angle * std::numbers::pi / 180.0; }

double pad_width(const KindRequest& request, double size) {
    return request.test.loading.pad_width.value_or(
        std::max(pad_share * size, fewest_particles_of_a_pad * request.particle));
}

LoadingPart flat_pad(double x, double y, double width, bool up) {
    // The part is half as deep as it is wide; no corner of the specimen is ever pressed in that far.
    const double half = 0.5 * width, back = up ? y - half : y + half;
    LoadingPart pad;
    if (up)
        pad.corners = {{x + half, y}, {x - half, y}, {x - half, back}, {x + half, back}};
    else
        pad.corners = {{x - half, y}, {x + half, y}, {x + half, back}, {x - half, back}};
    return pad;
}

Shape whole_packing(const KindRequest& request) {
    Shape shape;
    shape.width = request.packing.x2 - request.packing.x1;
    shape.height = request.packing.y2 - request.packing.y1;
    return shape;
}

}  // namespace crackle
