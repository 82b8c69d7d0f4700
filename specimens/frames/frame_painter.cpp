// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/frame_painter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <ostream>
#include <sstream>
#include <utility>

#include "solver/base/correctly_rounded.hpp"
#include "solver/geometry/geometry.hpp"
#include "solver/world/world.hpp"
#include "specimens/frames/crack_faces.hpp"
#include "specimens/frames/fragments.hpp"
#include "specimens/frames/frame_arrays.hpp"

namespace crackle {
namespace {

/// Number of corners of the face if the body is a part that holds or drives the specimen; otherwise empty.
std::optional<std::size_t> face_of_part(const PlacedApparatus& apparatus, BodyIndex b) {
    for (const SetupPart& part : apparatus.parts)
        if (part.body == b) return part.face;
    return std::nullopt;
}

/// Order of the bodies in files: platens first, because VTK numbers lines before polygons; then other bodies by id.
std::vector<BodyIndex> drawing_order(const World& world, const PlacedApparatus& apparatus) {
    std::vector<BodyIndex> order(world.bodies.size());
    std::iota(order.begin(), order.end(), BodyIndex{0});
    const auto rank = [&](BodyIndex b) { return std::pair(!apparatus.is_platen(b), world.bodies.info(b).id); };
    std::sort(order.begin(), order.end(), [&](BodyIndex a, BodyIndex b) { return rank(a) < rank(b); });
    return order;
}

/// Writes the element Points with `count` points.
/// @param add  function that passes each position to the function that it receives as an argument
template <class Add>
void write_points(std::ostream& out, FramePrecision precision, std::size_t count, const Add& add) {
    begin_element(out, "Points");
    const auto write = [&]<class T>(T) {
        PackedArray<T> points(out, "points", 3, 3 * count);
        add([&](Vec2 place) {
            points.add(static_cast<T>(place.x));
            points.add(static_cast<T>(place.y));
            points.add(T{});
        });
        points.finish();
    };
    precision == FramePrecision::single_ ? write(float{}) : write(double{});
    end_element(out, "Points");
}

void add_vector(PackedArray<double>& vectors, Vec2 value) {
    vectors.add(value.x);
    vectors.add(value.y);
    vectors.add(0.0);
}

void write_head(std::ostream& out, const Frame& frame, const VtpCounts& counts) {
    write_vtp_head(out,
                   {{declared(frame_fields(), "axial_strain").name, frame.axial_strain},
                    {declared(frame_fields(), "axial_stress").name, frame.axial_stress},
                    {declared(frame_fields(), "time").name, frame.time}},
                   counts);
}

const char* of_particles(std::string_view name) { return declared(particle_arrays(), name).name; }
const char* of_contacts(std::string_view name) { return declared(contact_arrays(), name).name; }
const char* of_cracks(std::string_view name) { return declared(crack_arrays(), name).name; }
const char* of_joints(std::string_view name) { return declared(joint_arrays(), name).name; }

/// Index of the first bond that is a face; these bonds are last in the list.
PointIndex first_face_of(const BondRecord& bonds) {
    return bonds.kind_begin[static_cast<std::size_t>(PointKind::bonded_face)];
}

/// Relative motion of the two sides of a bonded face, or of a broken one, since bonding.
BondFaceMotion motion_of_face(const PlacedFrame& placed, PointIndex bond) {
    const ContactPoint point = placed.setup().bonds.points[bond];
    return motion_of(placed.world().faces.place[point.element_i], placed.body(point.body_i), placed.body(point.body_j));
}

/// Traction on a face that is bonded or was bonded. @param normal  normal force, N, compression positive
FaceTraction traction_of(const PlacedFrame& placed, PointIndex bond, double normal) {
    const World& world = placed.world();
    const FaceSprings springs = world.faces.springs[placed.setup().bonds.points[bond].element_i];
    const BondFaceMotion motion = motion_of_face(placed, bond);
    return holds(placed.frame().states[bond]) ? traction_of_intact(springs, motion, normal)
                                              : traction_of_broken(springs, motion, world.settings.thick, normal);
}

constexpr std::int64_t most_kept =
    2000;  // largest number of particles whose constant arrays are kept in compressed form

}  // namespace

int circle_corners(std::int64_t particles) {
    constexpr std::int64_t most_seen_closely = 2000;
    return particles <= most_seen_closely ? 24 : 12;
}

std::vector<Vec2> unit_circle_outline(int corners) {
    const double sector = 2.0 * std::numbers::pi / corners;
    // Ratio that makes the area of n triangles, each ½ radius² sin(sector), equal to that of the circle.
    const double radius = std::sqrt(sector / correctly_rounded::sin(sector));
    std::vector<Vec2> outline;
    outline.reserve(static_cast<std::size_t>(corners));
    for (int k = 0; k < corners; ++k)
        outline.push_back(radius * Vec2{correctly_rounded::cos(k * sector), correctly_rounded::sin(k * sector)});
    return outline;
}

FramePainter::FramePainter(const World& world, const TestSetup& setup, FramePrecision precision)
    : world_(world),
      setup_(setup),
      precision_(precision),
      order_(drawing_order(world, setup.apparatus)),
      outline_(unit_circle_outline(circle_corners(setup.specimen.particles))) {
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
        particle_counts_.points += corners;
        ++(setup.apparatus.is_platen(b) ? particle_counts_.lines : particle_counts_.polygons);
    });
    for (BodyIndex b = 0; b < world.bodies.size() && !setup.specimen.polygons; ++b) centres_ += is_circles(world, b);
    if (setup.specimen.particles > most_kept) return;
    std::ostringstream particles, bonds;
    write_particle_cells(particles);
    write_contact_cells(bonds, LooseContacts{});
    particle_cells_ = std::move(particles).str();
    bond_cells_ = std::move(bonds).str();
}

/// Calls visit(body, its first element, number of corners, radius or 0) for each cell in the file. Each circle of a
/// clump is a cell. A platen is represented by its face alone, because only the face touches the specimen.
template <class Visit>
void FramePainter::visit_cells(const Visit& visit) const {
    const BodyView bodies(world_);
    for (const BodyIndex b : order_) {
        const BodyInfo info = world_.bodies.info(b);
        if (!is_circles(world_, b)) {
            visit(b, info.first_element, face_of_part(setup_.apparatus, b).value_or(info.element_count), 0.0);
            continue;
        }
        for (std::uint32_t e = info.first_element; e < info.first_element + info.element_count; ++e)
            visit(b, e, outline_.size(), element_of(bodies, b, e).radius);
    }
}

/// Writes the cells, and those arrays of particles that never change.
void FramePainter::write_particle_cells(std::ostream& out) const {
    const VtpCounts& counts = particle_counts_;
    const std::size_t cells = counts.lines + counts.polygons;
    std::size_t line_points = 0;
    visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
        if (setup_.apparatus.is_platen(b)) line_points += corners;
    });
    // Corners are numbered consecutively; those of lines come first.
    const auto write_cells = [&](const char* name, bool lines) {
        const std::size_t first = lines ? 0 : line_points, end = lines ? line_points : counts.points;
        begin_element(out, name);
        write_indices(out, "connectivity", end - first, counts.points, [&](const auto& add) {
            for (std::size_t point = first; point < end; ++point) add(point);
        });
        write_indices(out, "offsets", lines ? counts.lines : counts.polygons, counts.points, [&](const auto& add) {
            std::size_t offset = 0;
            visit_cells([&](BodyIndex b, std::uint32_t, std::size_t corners, double) {
                if (setup_.apparatus.is_platen(b) == lines) add(offset += corners);
            });
        });
        end_element(out, name);
    };
    write_cells("Lines", true);
    write_cells("Polys", false);
    begin_element(out, "CellData");
    write_array<std::int32_t>(out, of_particles("id"), cells, [&](const auto& add) {
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) { add(world_.bodies.info(b).id); });
    });
    write_array<double>(out, of_particles("radius"), cells, [&](const auto& add) {
        visit_cells([&](BodyIndex, std::uint32_t, std::size_t, double radius) { add(radius); });
    });
    write_array<std::int32_t>(out, of_particles("material"), cells, [&](const auto& add) {
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) {
            add(world_.bodies.info(b).material + 1);  // numbered from 1, as in decks
        });
    });
}

void FramePainter::write_particles(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces) const {
    const Frame& frame = placed.frame();
    write_head(out, frame, particle_counts_);
    write_points(out, precision_, particle_counts_.points, [&](const auto& add) {
        const BodyView shapes(world_);
        visit_cells([&](BodyIndex b, std::uint32_t element, std::size_t corners, double radius) {
            const Frame::Body& body = frame.bodies[b];
            const Vec2 centroid{body.x, body.y}, turn = placed.turn(b);
            const auto place_of = [&](std::uint32_t e) {
                const Element at = element_of(shapes, b, e);
                return centroid + rotated(turn, {at.x, at.y});
            };
            if (radius == 0.0) {
                for (std::uint32_t e = element; e < element + corners; ++e) add(place_of(e));
                return;
            }
            const Vec2 centre = place_of(element);
            const Vec2 scaled = radius * turn;
            for (const Vec2 corner : outline_) add(centre + rotated(scaled, corner));
        });
    });
    particle_cells_.empty() ? write_particle_cells(out) : void(out << particle_cells_);

    const std::size_t cells = particle_counts_.lines + particle_counts_.polygons;
    const auto write_scalars = [&](const char* name, const auto& value_of) {
        write_array<double>(out, of_particles(name), cells, [&](const auto& add) {
            visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) { add(value_of(b)); });
        });
    };
    const auto write_vectors = [&](const char* name, const auto& value_of) {
        PackedArray<double> array(out, of_particles(name), 3, 3 * cells);
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) { add_vector(array, value_of(b)); });
        array.finish();
    };
    const auto& bodies = frame.bodies;
    const auto& start = setup_.bonds.start;
    write_scalars("angle", [&](BodyIndex b) { return bodies[b].angle - start[b].angle; });
    write_vectors("displacement", [&](BodyIndex b) {
        return Vec2{bodies[b].x - start[b].x, bodies[b].y - start[b].y};
    });
    write_vectors("velocity", [&](BodyIndex b) { return Vec2{bodies[b].vx, bodies[b].vy}; });
    write_scalars("rotation_rate", [&](BodyIndex b) { return bodies[b].omega; });
    write_scalars("stress_xx", [&](BodyIndex b) { return forces.stress[b].xx; });
    write_scalars("stress_yy", [&](BodyIndex b) { return forces.stress[b].yy; });
    write_scalars("stress_xy", [&](BodyIndex b) { return forces.stress[b].xy; });
    write_array<std::int32_t>(out, of_particles("fragment"), cells, [&](const auto& add) {
        const std::vector<std::int32_t> fragments = find_fragments(world_, setup_, frame);
        visit_cells([&](BodyIndex b, std::uint32_t, std::size_t, double) { add(fragments[b]); });
    });
    end_element(out, "CellData");
    write_vtp_end(out);
}

/// Calls visit(contact point) for each contact: first for the bonds, then for the loose contacts.
template <class Visit>
void FramePainter::visit_contacts(const LooseContacts& loose, const Visit& visit) const {
    for (const BodyPair& bond : setup_.bonds.points.pairs) visit(bond);
    for (const LooseContact& contact : loose.contacts) visit(BodyPair{contact.point.body_i, contact.point.body_j});
}

/// Writes the cells of contacts, as write_particle_cells() does for particles. Without loose contacts, they never
/// change.
void FramePainter::write_contact_cells(std::ostream& out, const LooseContacts& loose) const {
    std::vector<std::uint32_t> centre(setup_.specimen.polygons ? 0 : world_.bodies.size());
    std::size_t centres = 0;
    for (BodyIndex b = 0; b < centre.size(); ++b) {
        if (is_circles(world_, b)) centre[b] = static_cast<std::uint32_t>(centres++);
    }
    const auto corners = [&](const BodyPair& point) {
        if (setup_.specimen.polygons) return std::size_t{2};
        return std::size_t{1} + is_circles(world_, point.body_i) + is_circles(world_, point.body_j);
    };
    std::size_t all_corners = 0;
    visit_contacts(loose, [&](const BodyPair& point) { all_corners += corners(point); });
    const std::size_t contacts = setup_.bonds.points.size() + loose.contacts.size();
    begin_element(out, "Lines");
    write_indices(out, "connectivity", all_corners, all_corners, [&](const auto& add) {
        std::size_t next = centres;
        visit_contacts(loose, [&](const BodyPair& point) {
            if (!setup_.specimen.polygons && is_circles(world_, point.body_i)) add(centre[point.body_i]);
            add(next++);
            if (setup_.specimen.polygons) add(next++);
            if (!setup_.specimen.polygons && is_circles(world_, point.body_j)) add(centre[point.body_j]);
        });
    });
    write_indices(out, "offsets", contacts, all_corners, [&](const auto& add) {
        std::size_t offset = 0;
        visit_contacts(loose, [&](const BodyPair& point) { add(offset += corners(point)); });
    });
    end_element(out, "Lines");
    begin_element(out, "CellData");
    write_array<std::int32_t>(out, of_contacts("body_i"), contacts, [&](const auto& add) {
        visit_contacts(loose, [&](const BodyPair& point) { add(world_.bodies.info(point.body_i).id); });
    });
    write_array<std::int32_t>(out, of_contacts("body_j"), contacts, [&](const auto& add) {
        visit_contacts(loose, [&](const BodyPair& point) { add(world_.bodies.info(point.body_j).id); });
    });
}

/// Writes the points of contacts. With circles, they are all centres, followed by one point per contact. With polygons,
/// they are two points per contact.
void FramePainter::write_contact_points(std::ostream& out, const PlacedFrame& placed, std::size_t count,
                                        std::span<const FaceTraction> tractions) const {
    const Frame& frame = placed.frame();
    write_points(out, precision_, count, [&](const auto& add) {
        for (BodyIndex b = 0; b < frame.bodies.size() && !setup_.specimen.polygons; ++b) {
            if (is_circles(world_, b)) add({frame.bodies[b].x, frame.bodies[b].y});
        }
        const auto add_places = [&](Vec2 on_i, Vec2 on_j) {
            if (setup_.specimen.polygons) {
                add(on_i);
                add(on_j);
            } else {
                add(0.5 * (on_i + on_j));
            }
        };
        visit_kinds(setup_.bonds.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
            for (PointIndex k = begin; k < end; ++k) {
                const ContactPoint point = setup_.bonds.points.at<K>(k);
                const Facing held = facing_at_start<K>(world_, setup_, point);
                const Vec2 on_i = placed.carried(point.body_i, held.on_i),
                           on_j = placed.carried(point.body_j, held.on_j);
                if constexpr (K == PointKind::bonded_face) {
                    const Vec2 middle = 0.5 * (on_i + on_j), half = tractions[k - begin].half_length *
                                                                    perpendicular(motion_of_face(placed, k).normal);
                    add_places(middle - half, middle + half);
                } else {
                    add_places(on_i, on_j);
                }
            }
        });
        const BodyView bodies(world_);
        visit_kinds(frame.loose.kind_begin, [&]<PointKind K>(PointIndex begin, PointIndex end) {
            for (PointIndex k = begin; k < end; ++k) {
                const ContactPoint& point = frame.loose.contacts[k].point;
                std::uint32_t feature = point.feature_j;
                const BodyState i = placed.body(point.body_i), j = placed.body(point.body_j);
                const Facing now = facing_at(setup_, K, i, contact_geometry<K>(bodies, point, i, j, feature));
                add_places(now.on_i, now.on_j);
            }
        });
    });
}

void FramePainter::write_contacts(std::ostream& out, const PlacedFrame& placed, const FrameForces& forces,
                                  std::span<const Crack> cracks) const {
    const Frame& frame = placed.frame();
    const auto& loose = frame.loose.contacts;
    const std::size_t contacts = setup_.bonds.points.size() + loose.size();
    const VtpCounts counts{setup_.specimen.polygons ? 2 * contacts : centres_ + contacts, contacts, 0};
    write_head(out, frame, counts);
    const PointIndex first_face = first_face_of(setup_.bonds);
    std::vector<FaceTraction> tractions;
    for (PointIndex bond = first_face; bond < setup_.bonds.points.size(); ++bond)
        tractions.push_back(traction_of(placed, bond, forces.normal[bond]));
    write_contact_points(out, placed, counts.points, tractions);
    loose.empty() && !bond_cells_.empty() ? void(out << bond_cells_) : write_contact_cells(out, frame.loose);

    write_array<double>(out, of_contacts("normal_force"), contacts, [&](const auto& add) {
        for (const double force : forces.normal) add(force);
    });
    write_array<double>(out, of_contacts("shear_force"), contacts, [&](const auto& add) {
        for (const double force : frame.shear_force) add(force);
        for (const LooseContact& contact : loose) add(contact.shear_force);
    });
    write_array<std::uint8_t>(out, of_contacts("state"), contacts, [&](const auto& add) {
        for (const ContactState state : frame.states) add(static_cast<std::uint8_t>(state));
        for (std::size_t k = 0; k < loose.size(); ++k) add(static_cast<std::uint8_t>(ContactState::loose));
    });
    write_array<double>(out, of_contacts("age"), contacts, [&](const auto& add) {
        std::vector<std::pair<PointIndex, double>> breaks;  // broken bonds, and the times at which they broke
        for (const Crack& crack : cracks) breaks.emplace_back(crack.bond, crack.time);
        std::sort(breaks.begin(), breaks.end());
        auto broken = breaks.begin();
        for (PointIndex bond = 0; bond < setup_.bonds.points.size(); ++bond) {
            const bool breaks_here = broken != breaks.end() && broken->first == bond;
            add(breaks_here ? frame.time - (broken++)->second : frame.time);
        }
        for (const LooseContact& contact : loose) add(frame.time - contact.since);
    });
    const auto write_of_faces = [&](const char* name, const auto& value_of) {
        write_array<double>(out, of_contacts(name), contacts, [&](const auto& add) {
            for (PointIndex bond = 0; bond < first_face; ++bond) add(0.0);
            for (const FaceTraction& traction : tractions) add(value_of(traction));
            for (std::size_t k = 0; k < loose.size(); ++k) add(0.0);
        });
    };
    if (!tractions.empty()) {
        write_of_faces("moment", [](const FaceTraction& of) { return of.moment; });
        write_of_faces("stress_begin", [](const FaceTraction& of) { return of.at_begin; });
        write_of_faces("stress_end", [](const FaceTraction& of) { return of.at_end; });
    }
    end_element(out, "CellData");
    write_vtp_end(out);
}

void FramePainter::write_cracks(std::ostream& out, const PlacedFrame& placed, std::span<const Crack> cracks) const {
    write_head(out, placed.frame(), {2 * cracks.size(), cracks.size(), 0});
    std::vector<double> openings;
    openings.reserve(cracks.size());
    write_points(out, precision_, 2 * cracks.size(), [&](const auto& add) {
        for (const Crack& crack : cracks) {
            const CrackFace face = find_crack_face(placed, crack.bond);
            add(face.begin);
            add(face.end);
            openings.push_back(face.opening);
        }
    });
    write_pairs_as_lines(out, cracks.size());
    begin_element(out, "CellData");
    const auto write_values = [&]<class T>(const char* name, T, const auto& value_of) {
        write_array<T>(out, of_cracks(name), cracks.size(), [&](const auto& add) {
            for (const Crack& crack : cracks) add(value_of(crack));
        });
    };
    const auto point_of = [&](const Crack& crack) { return setup_.bonds.points[crack.bond]; };
    write_values("body_i", std::int32_t{},
                 [&](const Crack& crack) { return world_.bodies.info(point_of(crack).body_i).id; });
    write_values("body_j", std::int32_t{},
                 [&](const Crack& crack) { return world_.bodies.info(point_of(crack).body_j).id; });
    write_values("time", double{}, [](const Crack& crack) { return crack.time; });
    write_values("mode", std::uint8_t{}, [](const Crack& crack) { return crack.shear_mode ? 1 : 0; });
    write_values("energy", double{}, [](const Crack& crack) { return crack.energy; });
    write_values("orientation", double{}, [](const Crack& crack) { return crack.orientation; });
    write_values("strength", double{}, [](const Crack& crack) { return crack.strength; });
    write_array<double>(out, of_cracks("opening"), cracks.size(), [&](const auto& add) {
        for (const double opening : openings) add(opening);
    });
    const PointIndex first_face = first_face_of(setup_.bonds);
    if (first_face < setup_.bonds.points.size())
        write_values("slip", double{}, [&](const Crack& crack) {
            return crack.bond < first_face ? 0.0 : motion_of_face(placed, crack.bond).sliding;
        });
    if (!setup_.bonds.traces.empty())
        write_values("trace", std::int32_t{}, [&](const Crack& crack) { return setup_.bonds.trace_of(crack.bond); });
    end_element(out, "CellData");
    write_vtp_end(out);
}

void FramePainter::write_joints(std::ostream& out, const PlacedFrame& placed) const {
    const Frame& frame = placed.frame();
    std::vector<std::int32_t> holding(setup_.bonds.trace_faces.size(), 0);  // number of intact bonds on each face
    for (std::size_t bond = 0; bond < setup_.bonds.face_of_bond.size(); ++bond)
        if (setup_.bonds.face_of_bond[bond] >= 0 && holds(frame.states[bond]))
            ++holding[static_cast<std::size_t>(setup_.bonds.face_of_bond[bond])];
    struct Drawn {
        const TraceFace* face;
        FaceMotion motion;
        ContactState state;
    };
    std::vector<Drawn> drawn;
    const auto place = [&](BodyIndex b) {
        const Frame::Body& body = frame.bodies[b];
        return StartPlace{body.x, body.y, body.angle};
    };
    for (std::size_t k = 0; k < setup_.bonds.trace_faces.size(); ++k) {
        const TraceFace& face = setup_.bonds.trace_faces[k];
        if (face.length == 0.0) continue;
        const ContactState state = face.bonds == 0   ? ContactState::loose
                                   : holding[k] == 0 ? ContactState::broken
                                                     : ContactState::bonded;
        drawn.push_back({&face, motion_of(face, setup_.bonds.start_of(face), {place(face.i), place(face.j)}), state});
    }
    const std::size_t count = drawn.size();
    write_head(out, frame, {2 * count, count, 0});
    write_points(out, precision_, 2 * count, [&](const auto& add) {
        for (const Drawn& one : drawn) {
            add(one.motion.begin);
            add(one.motion.end);
        }
    });
    write_pairs_as_lines(out, count);
    begin_element(out, "CellData");
    const auto write_values = [&]<class T>(const char* name, T, const auto& value_of) {
        write_array<T>(out, of_joints(name), count, [&](const auto& add) {
            for (const Drawn& one : drawn) add(value_of(one));
        });
    };
    write_values("body_i", std::int32_t{}, [&](const Drawn& one) { return world_.bodies.info(one.face->i).id; });
    write_values("body_j", std::int32_t{}, [&](const Drawn& one) { return world_.bodies.info(one.face->j).id; });
    write_values("trace", std::int32_t{}, [](const Drawn& one) { return one.face->trace; });
    write_values("state", std::uint8_t{}, [](const Drawn& one) { return static_cast<std::uint8_t>(one.state); });
    write_values("opening", double{}, [](const Drawn& one) { return one.motion.opening; });
    write_values("slip", double{}, [](const Drawn& one) { return one.motion.slip; });
    end_element(out, "CellData");
    write_vtp_end(out);
}

}  // namespace crackle
