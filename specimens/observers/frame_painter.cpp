// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/frame_painter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <ostream>
#include <sstream>
#include <utility>

namespace crackle {
namespace {

/// Platens first, as VTK counts lines before polygons, then by id.
std::vector<BodyIndex> drawing_order(const World& world, const TestSetup& setup) {
    std::vector<BodyIndex> order(world.bodies.size());
    std::iota(order.begin(), order.end(), BodyIndex{0});
    const auto rank = [&](BodyIndex b) { return std::pair(!setup.is_platen(b), world.info[b].id); };
    std::sort(order.begin(), order.end(), [&](BodyIndex a, BodyIndex b) { return rank(a) < rank(b); });
    return order;
}

bool is_circles(const World& world, BodyIndex b) { return world.info[b].piece_count == 0; }

Vec2 rotated(Vec2 turn, Vec2 arm) { return {turn.x * arm.x - turn.y * arm.y, turn.y * arm.x + turn.x * arm.y}; }

/// Cosine and sine by which each body has turned since loading began.
std::vector<Vec2> turns_of(const TestSetup& setup, const Frame& frame) {
    std::vector<Vec2> turns(frame.bodies.size());
    for (std::size_t b = 0; b < turns.size(); ++b) {
        const double turn = frame.bodies[b].angle - setup.start[b].angle;
        turns[b] = {std::cos(turn), std::sin(turn)};
    }
    return turns;
}

void add_point(PackedArray<float>& points, Vec2 place) {
    points.add(static_cast<float>(place.x));
    points.add(static_cast<float>(place.y));
    points.add(0.0F);
}

void add_vector(PackedArray<double>& vectors, double x, double y) {
    vectors.add(x);
    vectors.add(y);
    vectors.add(0.0);
}

void write_head(std::ostream& out, const Frame& frame, const VtpCounts& counts) {
    write_vtp_head(out,
                   {{"axial_strain", frame.axial_strain}, {"axial_stress", frame.axial_stress}, {"time", frame.time}},
                   counts);
}

void write_points(std::ostream& out, PackedArray<float>& points) {
    begin_element(out, "Points");
    points.write(out);
    end_element(out, "Points");
}

/// Lines or Polys while they are listed.
template <class Index>
struct CellList {
    PackedArray<Index> connectivity{"connectivity", 1}, offsets{"offsets", 1};
    std::size_t cells = 0, corners = 0;

    void add_corner(std::size_t point) {
        connectivity.add(static_cast<Index>(point));
        ++corners;
    }
    void end_cell() {
        offsets.add(static_cast<Index>(corners));
        ++cells;
    }
    void write(std::ostream& out, const char* name) {
        begin_element(out, name);
        connectivity.write(out);
        offsets.write(out);
        end_element(out, name);
    }
};

constexpr std::size_t most_in_int32 = std::numeric_limits<std::int32_t>::max();

}  // namespace

int circle_corners(std::int64_t particles) {
    constexpr std::int64_t most_seen_closely = 2000;
    return particles <= most_seen_closely ? 24 : 12;
}

std::vector<Vec2> unit_circle_outline(int corners) {
    const double sector = 2.0 * std::numbers::pi / corners;
    const double radius = std::sqrt(sector / std::sin(sector));  // of n triangles, each ½ radius² sin(sector)
    std::vector<Vec2> outline;
    outline.reserve(static_cast<std::size_t>(corners));
    for (int k = 0; k < corners; ++k) outline.push_back(radius * Vec2{std::cos(k * sector), std::sin(k * sector)});
    return outline;
}

FramePainter::FramePainter(const World& world, const TestSetup& setup)
    : world_(world),
      setup_(setup),
      order_(drawing_order(world, setup)),
      outline_(unit_circle_outline(circle_corners(setup.particles))) {
    std::size_t corners = 0;
    visit_cells([&](BodyIndex, std::uint32_t, std::size_t count, double) { corners += count; });
    corners <= most_in_int32 ? list_particles<std::int32_t>() : list_particles<std::int64_t>();
    const std::size_t bond_corners = 3 * setup.bonds.size() + world.bodies.size();  // at most
    bond_corners <= most_in_int32 ? list_bonds<std::int32_t>() : list_bonds<std::int64_t>();
}

/// Each drawn cell to visit(body, its first element, number of corners, radius or 0): of a circle one of its elements,
/// of a platen its face, which is all that touches.
template <class Visit>
void FramePainter::visit_cells(const Visit& visit) const {
    for (const BodyIndex b : order_) {
        const BodyInfo& info = world_.info[b];
        if (!is_circles(world_, b)) {
            visit(b, info.first_element, setup_.is_platen(b) ? std::size_t{2} : std::size_t{info.element_count}, 0.0);
            continue;
        }
        for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e)
            visit(b, e, outline_.size(), world_.elements[e].radius);
    }
}

template <class Index>
void FramePainter::list_particles() {
    CellList<Index> lines, polygons;
    PackedArray<std::int32_t> id("id", 1), material("material", 1);
    PackedArray<double> radius("radius", 1);
    std::size_t points = 0;
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double circle_radius) {
        CellList<Index>& list = setup_.is_platen(b) ? lines : polygons;
        for (std::size_t k = 0; k < corners; ++k) list.add_corner(points++);
        list.end_cell();
        id.add(world_.info[b].id);
        material.add(world_.info[b].material + 1);  // as decks number them
        radius.add(circle_radius);
    });
    particle_counts_ = {points, lines.cells, polygons.cells};
    std::ostringstream out;
    lines.write(out, "Lines");
    polygons.write(out, "Polys");
    begin_element(out, "CellData");
    id.write(out);
    radius.write(out);
    material.write(out);
    particle_cells_ = std::move(out).str();
}

void FramePainter::write_particles(std::ostream& out, const Frame& frame) const {
    write_head(out, frame, particle_counts_);
    const std::vector<Vec2> turns = turns_of(setup_, frame);
    PackedArray<float> points("points", 3);
    visit_cells([&](BodyIndex b, std::uint32_t element, std::size_t corners, double radius) {
        const Frame::Body& body = frame.bodies[b];
        const Vec2 centroid{body.x, body.y}, turn = turns[b];
        const auto place_of = [&](std::uint32_t e) {
            return centroid + rotated(turn, {world_.elements[e].x, world_.elements[e].y});
        };
        if (radius == 0.0) {
            for (std::uint32_t e = element; e < element + corners; ++e) add_point(points, place_of(e));
            return;
        }
        const Vec2 centre = place_of(element);
        const Vec2 scaled = radius * turn;
        for (const Vec2 corner : outline_) add_point(points, centre + rotated(scaled, corner));
    });
    write_points(out, points);
    out << particle_cells_;

    PackedArray<double> angle("angle", 1), displacement("displacement", 3), velocity("velocity", 3);
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
        const Frame::Body& body = frame.bodies[b];
        const StartPlace& start = setup_.start[b];
        angle.add(body.angle - start.angle);
        add_vector(displacement, body.x - start.x, body.y - start.y);
        add_vector(velocity, body.vx, body.vy);
    });
    angle.write(out);
    displacement.write(out);
    velocity.write(out);
    end_element(out, "CellData");
    write_vtp_end(out);
}

/// Points between circles: the centres, each once, then those of the bonds; between polygons two a bond.
template <class Index>
void FramePainter::list_bonds() {
    std::vector<std::uint32_t> centre(setup_.polygons ? 0 : world_.bodies.size());
    std::size_t points = 0;
    for (std::size_t b = 0; b < centre.size(); ++b) {
        if (is_circles(world_, static_cast<BodyIndex>(b))) centre[b] = static_cast<std::uint32_t>(points++);
    }
    CellList<Index> lines;
    PackedArray<std::int32_t> body_i("body_i", 1), body_j("body_j", 1);
    for (const BondAnchor& bond : setup_.bonds) {
        if (setup_.polygons) {
            lines.add_corner(points++);
            lines.add_corner(points++);
        } else {
            if (is_circles(world_, bond.body_i)) lines.add_corner(centre[bond.body_i]);
            lines.add_corner(points++);
            if (is_circles(world_, bond.body_j)) lines.add_corner(centre[bond.body_j]);
        }
        lines.end_cell();
        body_i.add(world_.info[bond.body_i].id);
        body_j.add(world_.info[bond.body_j].id);
    }
    bond_counts_ = {points, lines.cells, 0};
    std::ostringstream out;
    lines.write(out, "Lines");
    begin_element(out, "CellData");
    body_i.write(out);
    body_j.write(out);
    bond_cells_ = std::move(out).str();
}

void FramePainter::write_bonds(std::ostream& out, const Frame& frame) const {
    write_head(out, frame, bond_counts_);
    const std::vector<Vec2> turns = turns_of(setup_, frame);
    // Where a place that moved along with a body since the start is now.
    const auto carried = [&](BodyIndex b, Vec2 place) {
        const Frame::Body& body = frame.bodies[b];
        return Vec2{body.x, body.y} + rotated(turns[b], place - Vec2{setup_.start[b].x, setup_.start[b].y});
    };
    PackedArray<float> points("points", 3);
    for (std::size_t b = 0; b < frame.bodies.size() && !setup_.polygons; ++b) {
        if (is_circles(world_, static_cast<BodyIndex>(b))) add_point(points, {frame.bodies[b].x, frame.bodies[b].y});
    }
    for (const BondAnchor& bond : setup_.bonds) {
        const Vec2 on_i = carried(bond.body_i, bond.on_i), on_j = carried(bond.body_j, bond.on_j);
        if (setup_.polygons) {
            add_point(points, on_i);
            add_point(points, on_j);
        } else {
            add_point(points, 0.5 * (on_i + on_j));
        }
    }
    write_points(out, points);
    out << bond_cells_;

    const auto write_array = [&](auto array, const auto& values) {
        for (const auto value : values) array.add(value);
        array.write(out);
    };
    write_array(PackedArray<double>("normal_force", 1), frame.normal_force);
    write_array(PackedArray<double>("shear_force", 1), frame.shear_force);
    write_array(PackedArray<std::uint8_t>("broken", 1), frame.broken);
    end_element(out, "CellData");
    write_vtp_end(out);
}

}  // namespace crackle
