// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "solver/contact_geometry.hpp"
#include "specimens/observers/curve.hpp"

namespace crackle {
namespace {

/// By this the world sorts its points (solver/neighbours.cpp): kind, pair, which of the two owns the element, element,
/// partner's feature.
auto place_in_list(const BondAnchor& bond) {
    const auto [low, high] = std::minmax(bond.body_i, bond.body_j);
    return std::tuple(bond.kind, low, high, bond.body_i > bond.body_j, bond.element_i, bond.feature_j);
}

bool holds(const BondAnchor& bond, PointKind kind, const ContactPoint& point) {
    const bool named = kind == PointKind::element_element || by_guide(kind);
    return bond.body_i == point.body_i && bond.body_j == point.body_j && bond.kind == kind &&
           bond.element_i == point.element_i && bond.feature_j == (named ? point.feature_j : 0);
}

}  // namespace

Camera::Camera(const TestSetup& setup) : setup_(setup), listed_(setup.bonds.size()) {
    std::iota(listed_.begin(), listed_.end(), 0U);
    std::sort(listed_.begin(), listed_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return place_in_list(setup.bonds[a]) < place_in_list(setup.bonds[b]);
    });
}

void Camera::take(const World& world, const CurveRow& row, std::int64_t row_index, Frame& frame) const {
    frame.row = row_index;
    frame.axial_strain = row.axial_strain;
    frame.axial_stress = row.axial_stress;
    frame.time = row.time;
    frame.bodies.resize(world.bodies.size());
    std::transform(world.bodies.begin(), world.bodies.end(), frame.bodies.begin(), [](const BodyState& body) {
        return Frame::Body{body.x, body.y, body.angle, body.vx, body.vy};
    });
    // Bonds are never made anew: what the walk along the list does not meet is broken.
    const std::size_t bonds = setup_.bonds.size();
    frame.normal_force.assign(bonds, 0.0);
    frame.shear_force.assign(bonds, 0.0);
    frame.broken.assign(bonds, 1);
    auto first = listed_.begin();  // of a kind
    visit_kinds(world, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        while (first != listed_.end() && setup_.bonds[*first].kind < K) ++first;
        auto next = first;
        for (PointIndex k = begin; k < end; ++k) {
            if (k == world.fours_end) next = first;  // here the order of a kind begins anew
            const ContactPoint& point = world.points[k];
            if ((world.point_states[k].flags & point_bonded) == 0) continue;
            while (next != listed_.end() && !holds(setup_.bonds[*next], K, point)) ++next;
            if (next == listed_.end())
                throw std::logic_error("a bonded point is not where the start of loading listed it");
            const double stiffness = world.laws[world.point_states[k].law].normal_stiffness;
            frame.normal_force[*next] = stiffness * (overlap_at<K>(world, point) - world.bond_overlaps[k]);
            frame.shear_force[*next] = world.shear_forces[k];
            frame.broken[*next] = 0;
        }
    });
}

std::int64_t default_frames(std::int64_t bodies, std::int64_t curve_rows) {
    constexpr std::int64_t most = 100, fewest = 20, bodies_drawn = 200'000;
    const std::int64_t shared = bodies_drawn / std::max<std::int64_t>(1, bodies);
    return std::min(std::clamp(shared, fewest, most), curve_rows);
}

std::string particles_file(std::int64_t row) { return fmt::format("particles_{:05}.vtp", row); }
std::string bonds_file(std::int64_t row) { return fmt::format("bonds_{:05}.vtp", row); }

}  // namespace crackle
