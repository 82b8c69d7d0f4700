// SPDX-License-Identifier: GPL-3.0-or-later
// Semi-circular bend: half a disc of radius R lies with its flat side down on two supports at span s and is loaded at
// the top by a force P. A notch of length a extends upwards from the middle of the flat side.
//
// The stress is P/(2R), so section = 2R; length = R. K_I = Y' P sqrt(πa)/(2R) = Y' sqrt(πa) σ (Kuruppu, Obara,
// Ayatollahi, Chong & Funatsu, Rock Mech. Rock Eng. 47, 2014, ISRM's suggested method). Pads are as in bending.cpp; the
// top is flattened over the width of its pad.
// Tested by tests/specimens/kinds/test_kind_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "solver/base/correctly_rounded.hpp"
#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr double half_disc_notch = 0.5, half_disc_shortest_notch = 0.4,
                 half_disc_longest_notch = 0.6;  // default and limits of the notch length, relative to the radius
constexpr double half_disc_span = 0.8, half_disc_shortest_span = 0.5,
                 half_disc_longest_span = 0.8;  // default and limits of the span, relative to the diameter

double notch_of(const KindRequest& request, double radius) {
    const double notch = request.test.shape.notch.value_or(half_disc_notch * radius);
    if (notch < half_disc_shortest_notch * radius * (1.0 - 1e-12) ||
        notch > half_disc_longest_notch * radius * (1.0 + 1e-12)) {
        request.refuse(CaseKey::shape_notch, fmt::format("{} m", notch),
                       fmt::format("{} to {} of the radius of {:.6g} m", half_disc_shortest_notch,
                                   half_disc_longest_notch, radius),
                       "the stress intensity is known only in this range");
    }
    return notch;
}

Vec2 foot_of(const KindRequest& request) {
    return {0.5 * (request.packing.x1 + request.packing.x2), request.packing.y1};
}

}  // namespace

double semicircle_factor(double ratio, double half_span) {
    return -1.297 + 9.516 * half_span - (0.47 + 16.457 * half_span) * ratio +
           (1.071 + 34.401 * half_span) * ratio * ratio;
}

namespace {

Shape scb_shape(const KindRequest& request) {
    const Domain& box = request.packing;
    const double radius = 0.5 * disc_diameter(request, std::min(box.x2 - box.x1, 2.0 * (box.y2 - box.y1)));
    const double half_pad = 0.5 * pad_width(request, radius);
    const Vec2 foot = foot_of(request);
    if (!(half_pad < 0.5 * radius)) {
        request.refuse(CaseKey::loading_pad_width, fmt::format("{:.4g} m", 2.0 * half_pad),
                       fmt::format("less than the radius of {:.6g} m", radius),
                       "use narrower pads, or smaller particles");
    }
    const double end = std::sqrt(radius * radius - half_pad * half_pad);
    const double to = correctly_rounded::atan2(end, half_pad);
    const int sides = std::max(4, static_cast<int>(std::lround(to * radius / request.particle)));
    Shape shape;
    const auto place = [&](int k, double side) {
        const double angle = to * static_cast<double>(k) / sides;
        return Vec2{foot.x + side * radius * correctly_rounded::cos(angle),
                    foot.y + radius * correctly_rounded::sin(angle)};
    };
    for (int k = 0; k <= sides; ++k) shape.outline.push_back(place(k, 1.0));
    for (int k = sides; k >= 0; --k) shape.outline.push_back(place(k, -1.0));
    shape.width = 2.0 * radius;
    shape.height = radius;
    shape.notch = Notch{{foot.x, foot.y - request.particle}, {foot.x, foot.y + notch_of(request, radius)}};
    const double near = 1.5 * request.particle;
    shape.left = Region{foot.x - near, foot.x, foot.y, foot.y + request.particle};
    shape.right = Region{foot.x, foot.x + near, foot.y, foot.y + request.particle};
    return shape;
}

Apparatus scb_apparatus(const KindRequest& request, const Shape& shape) {
    const double radius = shape.height, pad = pad_width(request, radius);
    const double span = request.test.loading.span.value_or(half_disc_span * shape.width);
    if (span < half_disc_shortest_span * shape.width * (1.0 - 1e-12) ||
        span > half_disc_longest_span * shape.width * (1.0 + 1e-12)) {
        request.refuse(CaseKey::loading_span, fmt::format("{} m", span),
                       fmt::format("{} to {} of the diameter of {:.6g} m", half_disc_shortest_span,
                                   half_disc_longest_span, shape.width),
                       "the stress intensity is known only in this range");
    }
    const Vec2 foot = foot_of(request);
    Apparatus apparatus;
    for (const double x : {foot.x - 0.5 * span, foot.x + 0.5 * span}) {
        LoadingPart support = flat_pad(x, foot.y - request.offset, pad, true);
        support.y = {Drive::velocity, 0.0};
        apparatus.parts.push_back(support);
    }
    const double top = foot.y + std::sqrt(radius * radius - 0.25 * pad * pad);
    LoadingPart driver = flat_pad(foot.x, top + request.cut_offset, pad, false);
    driver.x = driver.y = {Drive::velocity, 0.0};
    apparatus.parts.push_back(driver);
    apparatus.section = shape.width;
    apparatus.length = radius;
    apparatus.span = span;
    const double notch = notch_of(request, radius);
    apparatus.stress_intensity =
        semicircle_factor(notch / radius, span / shape.width) * std::sqrt(std::numbers::pi * notch);
    return apparatus;
}

constexpr std::array scb_keys{KindKey{"shape.diameter"}, KindKey{"shape.notch"}, KindKey{"loading.span"},
                              KindKey{"loading.pad_width"}};

}  // namespace

extern constexpr TestKind scb_kind{.curve = {"P/2R", "displacement over R"},
                                   .notched = true,
                                   .keys = scb_keys,
                                   .bonded_because = bonded_parts,
                                   .valid_failure = ValidFailure::from_midspan,
                                   .driver = "pad that presses",
                                   .support = "support",
                                   .shape = scb_shape,
                                   .apparatus = scb_apparatus};

}  // namespace crackle
