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

#include "solver/contact_geometry.hpp"

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

/// A whole array. @param add  calls its argument with each value
template <class T, class Add>
void write_array(std::ostream& out, const char* name, std::size_t values, const Add& add) {
    PackedArray<T> array(out, name, 1, values);
    add([&](auto value) { array.add(static_cast<T>(value)); });
    array.finish();
}

/// The same of indices, Int32 where they are small enough.
template <class Add>
void write_indices(std::ostream& out, const char* name, std::size_t values, std::size_t largest, const Add& add) {
    constexpr std::size_t most_in_int32 = std::numeric_limits<std::int32_t>::max();
    largest <= most_in_int32 ? write_array<std::int32_t>(out, name, values, add)
                             : write_array<std::int64_t>(out, name, values, add);
}

void write_head(std::ostream& out, const Frame& frame, const VtpCounts& counts) {
    write_vtp_head(out,
                   {{"axial_strain", frame.axial_strain}, {"axial_stress", frame.axial_stress}, {"time", frame.time}},
                   counts);
}

/// Where a bond is held to its two bodies when loading begins, m: points of their surfaces, which between polygons are
/// the width of the gap apart.
struct BondPlaces {
    Vec2 on_i, on_j;
};

template <PointKind K>
BondPlaces places_at_start(const World& world, const TestSetup& setup, const ContactPoint& point) {
    const auto body = [&](BodyIndex b) {
        const StartPlace& start = setup.start[b];
        return placed_body(world, setup, b, start.x, start.y, start.angle);
    };
    const BodyState i = body(point.body_i);
    std::uint32_t feature = point.feature_j;
    const ContactGeometry g = contact_geometry<K>(world, point, i, body(point.body_j), feature);
    // A pair of segments sums up several overlaps: there the gap is that of the mesh.
    const bool outline = K == PointKind::element_outline && setup.polygons;
    const double gap = outline                           ? setup.bond_thick - g.overlap
                       : K == PointKind::segment_segment ? setup.mesh_thick
                                                         : 0.0;
    const Vec2 middle{i.x + g.aix, i.y + g.aiy}, half_gap = 0.5 * gap * Vec2{g.nx, g.ny};
    return {middle - half_gap, middle + half_gap};
}

constexpr std::int64_t most_kept = 2000;  // particles whose constant arrays are kept packed

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
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
        particle_counts_.points += corners;
        ++(setup.is_platen(b) ? particle_counts_.lines : particle_counts_.polygons);
    });
    // Between circles the centres, each once, then a point a bond; between polygons two points a bond.
    bond_counts_ = {setup.polygons ? 2 * setup.bonds.size() : setup.bonds.size(), setup.bonds.size(), 0};
    for (BodyIndex b = 0; b < world.bodies.size() && !setup.polygons; ++b) bond_counts_.points += is_circles(world, b);
    if (setup.particles > most_kept) return;
    std::ostringstream particles, bonds;
    write_particle_cells(particles);
    write_bond_cells(bonds);
    particle_cells_ = std::move(particles).str();
    bond_cells_ = std::move(bonds).str();
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

/// From the cells on to the last array that never changes.
void FramePainter::write_particle_cells(std::ostream& out) const {
    const VtpCounts& counts = particle_counts_;
    const std::size_t cells = counts.lines + counts.polygons;
    std::size_t line_points = 0;
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
        if (setup_.is_platen(b)) line_points += corners;
    });
    // Corners are numbered as they come, and lines come first.
    const auto write_cells = [&](const char* name, bool lines) {
        const std::size_t first = lines ? 0 : line_points, end = lines ? line_points : counts.points;
        begin_element(out, name);
        write_indices(out, "connectivity", end - first, counts.points, [&](const auto& add) {
            for (std::size_t point = first; point < end; ++point) add(point);
        });
        write_indices(out, "offsets", lines ? counts.lines : counts.polygons, counts.points, [&](const auto& add) {
            std::size_t offset = 0;
            visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
                if (setup_.is_platen(b) == lines) add(offset += corners);
            });
        });
        end_element(out, name);
    };
    write_cells("Lines", true);
    write_cells("Polys", false);
    begin_element(out, "CellData");
    write_array<std::int32_t>(out, "id", cells, [&](const auto& add) {
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) { add(world_.info[b].id); });
    });
    write_array<double>(out, "radius", cells, [&](const auto& add) {
        visit_cells([&](BodyIndex, std::uint32_t, std::size_t, double radius) { add(radius); });
    });
    write_array<std::int32_t>(out, "material", cells, [&](const auto& add) {
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
            add(world_.info[b].material + 1);  // as decks number them
        });
    });
}

void FramePainter::write_particles(std::ostream& out, const Frame& frame) const {
    write_head(out, frame, particle_counts_);
    const std::vector<Vec2> turns = turns_of(setup_, frame);
    begin_element(out, "Points");
    PackedArray<float> points(out, "points", 3, 3 * particle_counts_.points);
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
    points.finish();
    end_element(out, "Points");
    particle_cells_.empty() ? write_particle_cells(out) : void(out << particle_cells_);

    const std::size_t cells = particle_counts_.lines + particle_counts_.polygons;
    write_array<double>(out, "angle", cells, [&](const auto& add) {
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
            add(frame.bodies[b].angle - setup_.start[b].angle);
        });
    });
    PackedArray<double> displacement(out, "displacement", 3, 3 * cells);
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
        add_vector(displacement, frame.bodies[b].x - setup_.start[b].x, frame.bodies[b].y - setup_.start[b].y);
    });
    displacement.finish();
    PackedArray<double> velocity(out, "velocity", 3, 3 * cells);
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
        add_vector(velocity, frame.bodies[b].vx, frame.bodies[b].vy);
    });
    velocity.finish();
    end_element(out, "CellData");
    write_vtp_end(out);
}

/// As write_particle_cells().
void FramePainter::write_bond_cells(std::ostream& out) const {
    std::vector<std::uint32_t> centre(setup_.polygons ? 0 : world_.bodies.size());
    std::size_t centres = 0;
    for (BodyIndex b = 0; b < centre.size(); ++b) {
        if (is_circles(world_, b)) centre[b] = static_cast<std::uint32_t>(centres++);
    }
    const auto corners = [&](const Bond& bond) {
        if (setup_.polygons) return std::size_t{2};
        return std::size_t{1} + is_circles(world_, bond.point.body_i) + is_circles(world_, bond.point.body_j);
    };
    std::size_t all_corners = 0;
    for (const Bond& bond : setup_.bonds) all_corners += corners(bond);
    begin_element(out, "Lines");
    write_indices(out, "connectivity", all_corners, all_corners, [&](const auto& add) {
        std::size_t next = centres;
        for (const auto& [point, overlap] : setup_.bonds) {
            if (!setup_.polygons && is_circles(world_, point.body_i)) add(centre[point.body_i]);
            add(next++);
            if (setup_.polygons) add(next++);
            if (!setup_.polygons && is_circles(world_, point.body_j)) add(centre[point.body_j]);
        }
    });
    write_indices(out, "offsets", setup_.bonds.size(), all_corners, [&](const auto& add) {
        std::size_t offset = 0;
        for (const Bond& bond : setup_.bonds) add(offset += corners(bond));
    });
    end_element(out, "Lines");
    begin_element(out, "CellData");
    write_array<std::int32_t>(out, "body_i", setup_.bonds.size(), [&](const auto& add) {
        for (const Bond& bond : setup_.bonds) add(world_.info[bond.point.body_i].id);
    });
    write_array<std::int32_t>(out, "body_j", setup_.bonds.size(), [&](const auto& add) {
        for (const Bond& bond : setup_.bonds) add(world_.info[bond.point.body_j].id);
    });
}

void FramePainter::write_bonds(std::ostream& out, const Frame& frame) const {
    write_head(out, frame, bond_counts_);
    const std::vector<Vec2> turns = turns_of(setup_, frame);
    // Where a place that moved along with a body since the start is now.
    const auto carried = [&](BodyIndex b, Vec2 place) {
        const Frame::Body& body = frame.bodies[b];
        return Vec2{body.x, body.y} + rotated(turns[b], place - Vec2{setup_.start[b].x, setup_.start[b].y});
    };
    begin_element(out, "Points");
    PackedArray<float> points(out, "points", 3, 3 * bond_counts_.points);
    for (BodyIndex b = 0; b < frame.bodies.size() && !setup_.polygons; ++b) {
        if (is_circles(world_, b)) add_point(points, {frame.bodies[b].x, frame.bodies[b].y});
    }
    visit_kinds(setup_.bond_kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
        for (PointIndex k = begin; k < end; ++k) {
            const ContactPoint& point = setup_.bonds[k].point;
            const BondPlaces start = places_at_start<K>(world_, setup_, point);
            const Vec2 on_i = carried(point.body_i, start.on_i), on_j = carried(point.body_j, start.on_j);
            if (setup_.polygons) {
                add_point(points, on_i);
                add_point(points, on_j);
            } else {
                add_point(points, 0.5 * (on_i + on_j));
            }
        }
    });
    points.finish();
    end_element(out, "Points");
    bond_cells_.empty() ? write_bond_cells(out) : void(out << bond_cells_);

    const auto write_values = [&]<class T>(const char* name, const std::vector<T>& values) {
        write_array<T>(out, name, values.size(), [&](const auto& add) {
            for (const T value : values) add(value);
        });
    };
    write_array<double>(out, "normal_force", setup_.bonds.size(),
                        [&](const auto& add) { visit_normal_forces(world_, setup_, frame, add); });
    write_values("shear_force", frame.shear_force);
    write_values("broken", frame.broken);
    end_element(out, "CellData");
    write_vtp_end(out);
}

}  // namespace crackle
