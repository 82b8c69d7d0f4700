// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "solver/contact_geometry.hpp"
#include "solver/point_order.hpp"
#include "specimens/observers/curve.hpp"

namespace crackle {

void take_frame(const World& world, const TestSetup& setup, const CurveRow& row, std::int64_t row_index, Frame& frame) {
    frame.row = row_index;
    frame.axial_strain = row.axial_strain;
    frame.axial_stress = row.axial_stress;
    frame.time = row.time;
    frame.bodies.resize(world.bodies.size());
    std::transform(world.bodies.begin(), world.bodies.end(), frame.bodies.begin(), [](const BodyState& body) {
        return Frame::Body{body.x, body.y, body.angle, body.vx, body.vy};
    });
    // Bonds are never made anew: what the walk along the list does not meet is broken.
    const std::vector<Bond>& bonds = setup.bonds;
    frame.shear_force.assign(bonds.size(), 0.0);
    frame.broken.assign(bonds.size(), 1);
    visit_kinds(world.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        const PointIndex first = setup.bond_kind_begin[static_cast<std::size_t>(K)];
        const PointIndex last = setup.bond_kind_begin[static_cast<std::size_t>(K) + 1];
        PointIndex next = first;
        for (PointIndex k = begin; k < end; ++k) {
            if (k == world.fours_end) next = first;  // here the order of a kind begins anew
            const ContactPoint& point = world.points[k];
            if ((world.point_states[k].flags & point_bonded) == 0) continue;
            while (next < last && !same_point(K, bonds[next].point, point)) ++next;
            if (next == last) throw std::logic_error("a bonded point is not where the start of loading listed it");
            frame.shear_force[next] = world.shear_forces[k];
            frame.broken[next] = 0;
        }
    });
}

void visit_normal_forces(const World& world, const TestSetup& setup, const Frame& frame,
                         const std::function<void(double)>& visit) {
    const auto body = [&](BodyIndex b) {
        const Frame::Body& place = frame.bodies[b];
        return placed_body(world, setup, b, place.x, place.y, place.angle);
    };
    visit_kinds(setup.bond_kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            if (frame.broken[k] != 0) {
                visit(0.0);
                continue;
            }
            const auto& [point, bond_overlap] = setup.bonds[k];
            std::uint32_t feature = point.feature_j;
            const double overlap =
                contact_geometry<K>(world, point, body(point.body_i), body(point.body_j), feature).overlap;
            const ContactLaw& law = world.laws[law_between(world, point.body_i, point.body_j)];
            visit(law.normal_stiffness * (overlap - bond_overlap));
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
