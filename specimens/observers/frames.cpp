// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "specimens/observers/curve.hpp"

namespace crackle {
namespace {

constexpr int circle_corners = 24;

std::vector<Vec2> circle_outline(Vec2 centre, double radius, double angle) {
    static const std::vector<Vec2> unit = [] {
        std::vector<Vec2> corners;
        for (int k = 0; k < circle_corners; ++k) {
            const double a = 2.0 * std::numbers::pi * k / circle_corners;
            corners.push_back({std::cos(a), std::sin(a)});
        }
        return corners;
    }();
    const double c = radius * std::cos(angle), s = radius * std::sin(angle);
    std::vector<Vec2> corners;
    corners.reserve(unit.size());
    for (const Vec2 u : unit) corners.push_back(centre + Vec2{c * u.x - s * u.y, s * u.x + c * u.y});
    return corners;
}

struct ParticleArrays {
    CellArray id{"id", 1, {}, {}}, material{"material", 1, {}, {}};
    CellArray radius{"radius", 1, {}, {}}, angle{"angle", 1, {}, {}};
    CellArray displacement{"displacement", 3, {}, {}}, velocity{"velocity", 3, {}, {}};

    void add(const World& world, const TestSetup& setup, BodyIndex b, double circle_radius) {
        const BodyState& body = world.bodies[b];
        const StartPlace& start = setup.start[b];
        id.integer.push_back(world.info[b].id);
        material.integer.push_back(world.info[b].material + 1);  // as decks number them
        radius.real.push_back(circle_radius);
        angle.real.push_back(body.angle - start.angle);
        displacement.real.insert(displacement.real.end(), {body.x - start.x, body.y - start.y, 0.0});
        velocity.real.insert(velocity.real.end(), {body.vx, body.vy, 0.0});
    }
};

/// Platens first, as VTK counts lines before polygons, then by id.
std::vector<BodyIndex> drawing_order(const World& world, const TestSetup& setup) {
    std::vector<BodyIndex> order(world.bodies.size());
    for (std::size_t b = 0; b < order.size(); ++b) order[b] = static_cast<BodyIndex>(b);
    const auto rank = [&](BodyIndex b) { return std::pair(!setup.is_platen(b), world.info[b].id); };
    std::sort(order.begin(), order.end(), [&](BodyIndex a, BodyIndex b) { return rank(a) < rank(b); });
    return order;
}

VtpData draw_particles(const World& world, const TestSetup& setup) {
    VtpData data;
    ParticleArrays arrays;
    for (const BodyIndex b : drawing_order(world, setup)) {
        const BodyInfo& info = world.info[b];
        const std::vector<Vec2> places = element_positions(world, b);
        if (info.piece_count > 0) {
            // Of a platen its face, which is all that touches.
            setup.is_platen(b) ? data.add_line({places[0], places[1]}) : data.add_polygon(places);
            arrays.add(world, setup, b, 0.0);
            continue;
        }
        for (std::uint32_t e = 0; e < info.element_count; ++e) {
            const double radius = world.elements[info.first_element + e].radius;
            data.add_polygon(circle_outline(places[e], radius, world.bodies[b].angle));
            arrays.add(world, setup, b, radius);
        }
    }
    data.cell_arrays = {arrays.id, arrays.radius, arrays.material, arrays.angle, arrays.displacement, arrays.velocity};
    return data;
}

/// Where a place that moved along with a body since the start is now.
Vec2 carried(const World& world, const TestSetup& setup, BodyIndex b, Vec2 place) {
    const BodyState& body = world.bodies[b];
    const StartPlace& start = setup.start[b];
    const double turn = body.angle - start.angle;
    const Vec2 arm = place - Vec2{start.x, start.y};
    return {body.x + std::cos(turn) * arm.x - std::sin(turn) * arm.y,
            body.y + std::sin(turn) * arm.x + std::cos(turn) * arm.y};
}

std::vector<Vec2> bond_line(const World& world, const TestSetup& setup, const BondAnchor& bond) {
    const Vec2 on_i = carried(world, setup, bond.body_i, bond.on_i);
    const Vec2 on_j = carried(world, setup, bond.body_j, bond.on_j);
    if (setup.polygons) return {on_i, on_j};
    std::vector<Vec2> line;
    const auto centre = [&](BodyIndex b) { return Vec2{world.bodies[b].x, world.bodies[b].y}; };
    if (world.info[bond.body_i].piece_count == 0) line.push_back(centre(bond.body_i));
    line.push_back(0.5 * (on_i + on_j));
    if (world.info[bond.body_j].piece_count == 0) line.push_back(centre(bond.body_j));
    return line;
}

struct BondForces {
    double normal = 0.0, shear = 0.0;
};

/// Forces of the bonds that hold, in the order of setup.bonds; nothing for broken ones.
std::vector<std::optional<BondForces>> forces_of_bonds(const World& world, const TestSetup& setup) {
    std::vector<std::optional<BondForces>> forces(setup.bonds.size());
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points[k].flags & point_bonded) == 0) continue;
        const BondAnchor key = anchor_of(world, k);
        const auto bond = std::lower_bound(setup.bonds.begin(), setup.bonds.end(), key,
                                           [](const BondAnchor& a, const BondAnchor& b) { return a.key() < b.key(); });
        const PointView view = view_point(world, k);
        forces[static_cast<std::size_t>(bond - setup.bonds.begin())] = BondForces{view.normal_force, view.shear_force};
    }
    return forces;
}

VtpData draw_bonds(const World& world, const TestSetup& setup) {
    VtpData data;
    CellArray normal{"normal_force", 1, {}, {}}, shear{"shear_force", 1, {}, {}}, broken{"broken", 1, {}, {}};
    CellArray body_i{"body_i", 1, {}, {}}, body_j{"body_j", 1, {}, {}};
    const auto forces = forces_of_bonds(world, setup);
    for (std::size_t k = 0; k < setup.bonds.size(); ++k) {
        const BondAnchor& bond = setup.bonds[k];
        data.add_line(bond_line(world, setup, bond));
        const BondForces held = forces[k].value_or(BondForces{});
        normal.real.push_back(held.normal);
        shear.real.push_back(held.shear);
        broken.integer.push_back(forces[k] ? 0 : 1);
        body_i.integer.push_back(world.info[bond.body_i].id);
        body_j.integer.push_back(world.info[bond.body_j].id);
    }
    data.cell_arrays = {normal, shear, broken, body_i, body_j};
    return data;
}

}  // namespace

Frame capture_frame(const World& world, const TestSetup& setup, const CurveRow& row, std::int64_t row_index) {
    Frame frame;
    frame.row = row_index;
    frame.axial_strain = row.axial_strain;
    frame.axial_stress = row.axial_stress;
    frame.time = row.time;
    frame.particles = draw_particles(world, setup);
    frame.bonds = draw_bonds(world, setup);
    for (VtpData* data : {&frame.particles, &frame.bonds}) {
        data->field_values = {
            {"axial_strain", row.axial_strain}, {"axial_stress", row.axial_stress}, {"time", row.time}};
    }
    return frame;
}

std::string particles_file(std::int64_t row) { return fmt::format("particles_{:05}.vtp", row); }
std::string bonds_file(std::int64_t row) { return fmt::format("bonds_{:05}.vtp", row); }

}  // namespace crackle
