// SPDX-License-Identifier: GPL-3.0-or-later
// Direct shear: the whole packing lies in two rigid half boxes with a gap between them. The lower box is fixed. The
// upper one moves along x without rotation and is free in y under a normal stress. This stress is constant, or it
// increases as the box rises (tests with constant normal load or constant normal stiffness).
//
// The inner corners of a box have relief pockets. Without them, a particle that touches both faces at a corner would be
// in contact only with the nearer face. As the particle is pressed into the corner, this contact and its energy would
// change abruptly.
//
// The shear stress is the force along x divided by the initial length L, and the strain is the displacement along x
// divided by L. Hence section = length = L.
// Tested by tests/specimens/kinds/test_kind_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr double default_box_gap = 2.0;  // gap between the half boxes if none is given, in mean particle sizes
constexpr double wall_share = 0.05;      // thickness of the box walls relative to the specimen's height
constexpr double widest_box_gap = 0.5;   // largest gap between the half boxes, relative to the specimen's height
constexpr double relieved = 1.5;         // size of the relief pockets in mean particle sizes

/// The lower half box. The corners of its inner faces come first.
LoadingPart half_box(const Domain& box, double offset, double rim, double wall, double relief) {
    const double x1 = box.x1 - offset, x2 = box.x2 + offset, y = box.y1 - offset;
    const double pocket = 0.5 * wall, low = y + std::min(relief, 0.5 * (rim - y));
    LoadingPart part;
    part.corners = {
        {x2, rim}, {x2, low}, {x2 + pocket, low}, {x2 + pocket, y},      {x1 - pocket, y},      {x1 - pocket, low},
        {x1, low}, {x1, rim}, {x1 - wall, rim},   {x1 - wall, y - wall}, {x2 + wall, y - wall}, {x2 + wall, rim}};
    part.face = 8;
    return part;
}

Apparatus direct_shear_apparatus(const KindRequest& request, const Shape& shape) {
    const Domain& box = request.packing;
    const double gap = request.test.loading.box_gap.value_or(default_box_gap * request.particle);
    if (gap > widest_box_gap * shape.height) {
        request.refuse(CaseKey::loading_box_gap, fmt::format("{:.4g} m", gap),
                       fmt::format("at most half of the height of {:.6g} m", shape.height),
                       "the boxes must hold the specimen; use a higher specimen, or a narrower gap");
    }
    const Vec2 middle{0.5 * (box.x1 + box.x2), 0.5 * (box.y1 + box.y2)};
    LoadingPart lower =
        half_box(box, request.offset, middle.y - 0.5 * gap, wall_share * shape.height, relieved * request.particle);
    LoadingPart upper = lower;
    for (Vec2& corner : upper.corners) corner = {2.0 * middle.x - corner.x, 2.0 * middle.y - corner.y};
    lower.x = lower.y = lower.rotation = upper.x = upper.rotation = {Drive::velocity, 0.0};
    Apparatus apparatus;
    apparatus.normal_force = request.test.loading.normal_stress * shape.width;
    apparatus.normal_spring = request.test.loading.normal_stiffness * shape.width;
    upper.y = {Drive::force, -apparatus.normal_force, apparatus.normal_spring};
    apparatus.parts = {lower, upper};
    apparatus.axis = 0;
    apparatus.section = apparatus.length = shape.width;
    return apparatus;
}

constexpr std::array direct_shear_keys{
    KindKey{"loading.normal_stress", "kind = \"direct_shear\" needs this key; 0 means no normal stress"},
    KindKey{"loading.box_gap"}, KindKey{"loading.normal_stiffness"}};

}  // namespace

extern constexpr TestKind direct_shear_kind{.curve = {"shear stress", "displacement over length"},
                                            .compression = false,
                                            .shear_box = true,
                                            .keys = direct_shear_keys,
                                            .bonded_because = bonded_parts,
                                            .valid_failure = ValidFailure::along_gap,
                                            .driver = "upper box",
                                            .support = "lower box",
                                            .shape = whole_packing,
                                            .apparatus = direct_shear_apparatus};

}  // namespace crackle
