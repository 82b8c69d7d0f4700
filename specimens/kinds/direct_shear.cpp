// SPDX-License-Identifier: GPL-3.0-or-later
// Direct shear: the whole packing in two rigid half boxes with a gap between them. The lower one stays; the upper one
// is drawn along x, does not turn, and floats in y under a normal stress, constant or growing as it rises (constant
// normal load and constant normal stiffness of the field).
//
// Where a box's sides meet its floor they are relieved: a particle that touched both faces of the hollow would have a
// contact with the nearer one alone, which changes while it is pressed into the corner, and its energy with it.
//
// Shear stress τ = force along x over the initial length L, strain = displacement u over L: section = length = L.
// Tested by tests/specimens/kinds/test_kind_test.cpp.

#include <fmt/format.h>

#include <algorithm>

#include "specimens/kinds/test_kind.hpp"

namespace crackle {
namespace {

constexpr double default_box_gap = 2.0;  // mean particles
constexpr double wall_share = 0.05;      // thickness of the boxes over the specimen's height
constexpr double widest_box_gap = 0.5;   // over the height
constexpr double relieved = 1.5;         // mean particles

/// The lower half box, its inner faces first.
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

}  // namespace

Apparatus direct_shear_apparatus(const KindRequest& request, const Shape& shape) {
    const Domain& box = request.packing;
    const double gap = request.test.loading.box_gap.value_or(default_box_gap * request.particle);
    if (gap > widest_box_gap * shape.height) {
        request.refuse("loading.box_gap", fmt::format("{:.4g} m", gap),
                       fmt::format("at most half of the height of {:.6g} m", shape.height),
                       "the boxes must hold the specimen; make it higher, or the gap narrower");
    }
    const Vec2 middle{0.5 * (box.x1 + box.x2), 0.5 * (box.y1 + box.y2)};
    LoadingPart lower =
        half_box(box, request.offset, middle.y - 0.5 * gap, wall_share * shape.height, relieved * request.particle);
    LoadingPart upper = lower;
    for (Vec2& corner : upper.corners) corner = {2.0 * middle.x - corner.x, 2.0 * middle.y - corner.y};
    lower.x = lower.y = lower.rotation = upper.x = upper.rotation = {Drive::velocity, 0.0};
    Apparatus apparatus;
    apparatus.normal_force = *request.test.loading.normal_stress * shape.width;
    apparatus.normal_spring = request.test.loading.normal_stiffness.value_or(0.0) * shape.width;
    upper.y = {Drive::force, -apparatus.normal_force, apparatus.normal_spring};
    apparatus.parts = {lower, upper};
    apparatus.axis = 0;
    apparatus.section = apparatus.length = shape.width;
    return apparatus;
}

}  // namespace crackle
