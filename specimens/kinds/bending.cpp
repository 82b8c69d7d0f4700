// SPDX-License-Identifier: GPL-3.0-or-later
// Three-point bending: the whole packing is a beam of depth W on two supports at a span S, pressed at midspan.
//
// The stress is that in the outer fibre according to slender-beam theory (ISRM, ASTM C880): σ = 3PS/(2W²), where P is
// the force. The strain is ε = 6Wδ/S², where δ is the deflection. Hence section = 2W²/(3S) and length = S²/(6W). For a
// slender beam, σ/ε is Young's modulus; for a short beam, the ratio is smaller because of shear. With a notch of length
// a from the lower face and S = 4W, K_I = P S/W^1.5 f(a/W) = σ 2/3 sqrt(W) f. Pads are bonded and rotate with the beam;
// the supports slide along x, so that the beam can lengthen.
// Tested by tests/specimens/kinds/test_kind_test.cpp.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr double default_span = 4.0;                           // S divided by the depth W
constexpr double notched_span_share = 0.01;                    // largest relative difference between S and 4W
constexpr double shortest_notch = 0.05, longest_notch = 0.95;  // length divided by the depth W

double span_of(const KindRequest& request) {
    const Domain& box = request.packing;
    return request.test.loading.span.value_or(default_span * (box.y2 - box.y1));
}

}  // namespace

double notched_beam_factor(double ratio) {
    const double a = ratio, rest = 1.0 - a;
    return 3.0 * std::sqrt(a) * (1.99 - a * rest * (2.15 - 3.93 * a + 2.7 * a * a)) /
           (2.0 * (1.0 + 2.0 * a) * rest * std::sqrt(rest));
}

namespace {

Shape bending_shape(const KindRequest& request) {
    Shape shape = whole_packing(request);
    if (!request.test.shape.notch) return shape;
    const double depth = shape.height, notch = *request.test.shape.notch;
    if (notch < shortest_notch * depth || notch > longest_notch * depth) {
        request.refuse(
            CaseKey::shape_notch, fmt::format("{} m", notch),
            fmt::format("between {} and {} of the beam's depth of {:.6g} m", shortest_notch, longest_notch, depth),
            "use a shorter notch, or a deeper beam");
    }
    const double middle = 0.5 * (request.packing.x1 + request.packing.x2), low = request.packing.y1;
    // The mouth of the notch lies outside the beam, so that no grain bridges it.
    const double beyond = request.particle;
    shape.notch = Notch{{middle, low - beyond}, {middle, low + notch}};
    const double near = 1.5 * request.particle;
    shape.left = Region{middle - near, middle, low, low + request.particle};
    shape.right = Region{middle, middle + near, low, low + request.particle};
    return shape;
}

Apparatus bending_apparatus(const KindRequest& request, const Shape& shape) {
    const Domain& box = request.packing;
    const double depth = shape.height, span = span_of(request), pad = pad_width(request, depth);
    if (span + pad > shape.width) {
        request.refuse(
            CaseKey::loading_span,
            fmt::format("{:.6g} m{}", span, request.test.loading.span ? "" : ", four times the beam's depth"),
            fmt::format(
                "a span that, together with the pad width of {:.4g} m, is at most the beam's length of {:.6g} m", pad,
                shape.width),
            "increase packing.width, or reduce the span");
    }
    if (span < 2.0 * pad) {
        request.refuse(CaseKey::loading_span, fmt::format("{:.6g} m", span),
                       fmt::format("at least twice the pad width of {:.4g} m", pad), "increase the span");
    }
    if (shape.notch && std::abs(span / (default_span * depth) - 1.0) > notched_span_share) {
        request.refuse(CaseKey::loading_span, fmt::format("{:.6g} m", span),
                       fmt::format("four times the depth, {:.6g} m, for a notched beam", default_span * depth),
                       "the stress intensity of a notched beam is known only for this span; remove the key");
    }
    const double middle = 0.5 * (box.x1 + box.x2);
    Apparatus apparatus;
    for (const double x : {middle - 0.5 * span, middle + 0.5 * span}) {
        LoadingPart support = flat_pad(x, box.y1 - request.offset, pad, true);
        support.y = {Drive::velocity, 0.0};
        apparatus.parts.push_back(support);
    }
    LoadingPart driver = flat_pad(middle, box.y2 + request.offset, pad, false);
    driver.x = driver.y = {Drive::velocity, 0.0};
    apparatus.parts.push_back(driver);
    apparatus.section = 2.0 * depth * depth / (3.0 * span);
    apparatus.length = span * span / (6.0 * depth);
    apparatus.span = span;
    if (shape.notch) {
        const double ratio = *request.test.shape.notch / depth;
        apparatus.stress_intensity = 2.0 / 3.0 * std::sqrt(depth) * notched_beam_factor(ratio);
    }
    return apparatus;
}

constexpr std::array bending_keys{KindKey{"shape.notch"}, KindKey{"loading.span"}, KindKey{"loading.pad_width"}};

}  // namespace

extern constexpr TestKind bending_kind{.curve = {"fibre stress", "fibre strain"},
                                       .keys = bending_keys,
                                       .bonded_because = bonded_parts,
                                       .valid_failure = ValidFailure::from_midspan,
                                       .driver = "pad that presses",
                                       .support = "support",
                                       .shape = bending_shape,
                                       .apparatus = bending_apparatus};

}  // namespace crackle
