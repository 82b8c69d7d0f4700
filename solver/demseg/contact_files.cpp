// SPDX-License-Identifier: GPL-3.0-or-later
// See contact_files.hpp.

#include "solver/demseg/contact_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"

namespace crackle {
namespace {

/// Identification of a point in the files, as seen from one of its bodies.
struct PointName {
    int body, other;  // input ids; negative for walls
    // Numbers of the two elements, counted from 1; 0 for an outline or a wall. Under the DEMseg guide's segment law
    // they are numbers of segments.
    int element, partner;
    auto operator<=>(const PointName&) const = default;

    PointName seen_from_other() const { return {other, body, partner, element}; }
};

int number_of(const BodyInfo& info, std::uint32_t element) {
    return static_cast<int>(element - info.first_element) + 1;
}

/// The standard identification of a point, as seen from the body that owns the element. For two circles or two segments
/// this is the body with the lower id; for a circle and a segment, the circle's body.
PointName name_of(const World& world, PointIndex k) {
    const PointKind kind = view_point(world, k).kind;
    const ContactPoint point = world.points.contact[k];
    const BodyInfo owner = world.bodies.info(point.body_i);
    PointName name{owner.id, partner_id(world, kind, point), number_of(owner, point.element_i), 0};
    if (kind != PointKind::element_outline && kind != PointKind::element_wall) {
        name.partner = number_of(world.bodies.info(point.body_j), point.feature_j);
        if (kind != PointKind::disc_segment && name.other < name.body) name = name.seen_from_other();
    }
    return name;
}

bool is_wall(PointIndex k, const World& world) {
    return k >= world.points.kind_begin[static_cast<std::size_t>(PointKind::element_wall)];
}

/// Index of each point, by its name.
std::map<PointName, PointIndex> points_by_name(const World& world) {
    std::map<PointName, PointIndex> points;
    for (PointIndex k = 0; k < world.points.size(); ++k) points.emplace(name_of(world, k), k);
    return points;
}

/// Finds the bodies of the scene by their input ids.
class BodyNames {
  public:
    explicit BodyNames(const Scene& scene) {
        for (const Body& body : scene.bodies) bodies_[body.id] = &body;
    }

    const Body* find(std::int64_t id) const {
        const auto found =
            id > 0 && id <= std::numeric_limits<int>::max() ? bodies_.find(static_cast<int>(id)) : bodies_.end();
        return found == bodies_.end() ? nullptr : found->second;
    }

  private:
    std::unordered_map<int, const Body*> bodies_;
};

int element_count(const Body& body) { return static_cast<int>(body.circle_count + body.vertex_count); }

/// Whether both bodies are single circles, for which the two columns of the DEMseg guide are sufficient.
bool plain_pair(const Body& a, const Body& b) { return a.circle_count == 1 && b.circle_count == 1; }

/// Lines to be written after the line `id count` of each body, by body id.
using LinesOfBodies = std::unordered_map<int, std::vector<std::pair<PointName, std::string>>>;

void write_lists(std::ostream& out, const Scene& scene, LinesOfBodies& lines) {
    for (const Body& body : scene.bodies) {
        auto& own = lines[body.id];
        std::sort(own.begin(), own.end());
        out << fmt::format("{} {}\n", body.id, own.size());
        for (const auto& [name, text] : own) out << text;
    }
}

double back_tension(const World& world, PointIndex k) {
    return (world.points.state[k].flags & point_bonded) != 0
               ? -law_of(world, k).normal_stiffness * world.points.bond_overlap[k]
               : 0.0;
}

/// The overlap δ0 that corresponds to a back-tension.
double bond_overlap(const World& world, PointIndex k, double tension) {
    return -tension / law_of(world, k).normal_stiffness;
}

/// Reads the line `id count` of the next list; lists must be in the order of the bodies in the scene.
std::int64_t read_list_head(DeckReader& reader, const Body& body) {
    reader.begin_read();
    const std::int64_t id = reader.integer("body id", 1, std::numeric_limits<int>::max());
    if (id != body.id) reader.refuse("body id", fmt::format("{}, in the order of in_gm.dat", body.id));
    return reader.integer(fmt::format("body {}: count", body.id), 0, std::numeric_limits<int>::max());
}

std::unordered_map<int, BodyIndex> indices_by_id(const World& world) {
    std::unordered_map<int, BodyIndex> indices;
    for (std::size_t b = 0; b < world.bodies.size(); ++b)
        indices.emplace(world.bodies.info(b).id, static_cast<BodyIndex>(b));
    return indices;
}

/// Whether a contact point that was touching one step ago can have left the neighbour list, because its surfaces
/// separated by more than the skin.
bool may_have_parted(const World& world, const std::unordered_map<int, BodyIndex>& index_of, const PointName& name) {
    double speed = 0.0;
    for (const int id : {name.body, name.other}) {
        if (id < 0) continue;  // a wall
        const BodyIndex b = index_of.at(id);
        const BodyState& body = world.bodies.state[b];
        speed += norm({body.vx, body.vy}) + world.bodies.info(b).reach * std::abs(body.omega);
    }
    return speed * world.stepping.time_step >= world.list.skin;
}

}  // namespace

int partner_id(const World& world, PointKind kind, const ContactPoint& point) {
    return kind == PointKind::element_wall ? -static_cast<int>(point.body_j) - 1 : world.bodies.info(point.body_j).id;
}

void write_contacts(std::ostream& out, const Scene& scene, const World& world) {
    LinesOfBodies lines;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        if ((world.points.state[k].flags & (point_touching | point_bonded)) == 0) continue;
        const PointName name = name_of(world, k);
        lines[name.body].emplace_back(name, fmt::format("{} {} {} {} {} {}\n", name.other, name.element, name.partner,
                                                        world.points.shear_force[k], back_tension(world, k),
                                                        (world.points.state[k].flags & point_slid) != 0 ? 1 : 0));
    }
    write_lists(out, scene, lines);
}

void read_contacts(DeckReader& reader, const Scene& scene, World& world) {
    const BodyNames names(scene);
    const std::map<PointName, PointIndex> points = points_by_name(world);
    const std::unordered_map<int, BodyIndex> index_of = indices_by_id(world);
    std::unordered_set<PointIndex> entered;
    bool bonds = false;
    for (const Body& body : scene.bodies) {
        const std::int64_t count = read_list_head(reader, body);
        for (std::int64_t c = 0; c < count; ++c) {
            const std::string key = fmt::format("body {}: contact {}: ", body.id, c + 1);
            reader.begin_read();
            const std::int64_t other = reader.integer(key + "other body", -4, std::numeric_limits<int>::max());
            const Body* partner = names.find(other);
            if (other >= 0 && (partner == nullptr || partner == &body))
                reader.refuse(key + "other body", "another body of in_gm.dat, or -1 to -4 for a wall");
            PointName name{body.id, static_cast<int>(other), 0, 0};
            name.element = static_cast<int>(reader.integer(key + "own element", 0, element_count(body)));
            name.partner = static_cast<int>(
                reader.integer(key + "other's element", 0, partner == nullptr ? 0 : element_count(*partner)));
            const double shear_force = reader.number(key + "shear force");
            const double tension = reader.number(key + "back-tension");
            if (tension > 0.0) reader.refuse(key + "back-tension", "0 (not bonded) or a negative number (bonded)");
            if (tension < 0.0 && partner == nullptr)
                reader.refuse(key + "back-tension", "0; domain walls are never bonded");
            const bool slid = reader.integer(key + "slid", 0, 1) == 1;
            const std::string contact = fmt::format("body {}: contact {}", body.id, c + 1);
            const std::string with = partner == nullptr ? fmt::format("wall {}", other) : fmt::format("body {}", other);
            auto found = points.find(name);
            // Seen from the other body, the normal and the shear force are both reversed, so the value is the same.
            if (found == points.end()) found = points.find(name.seen_from_other());
            if (found == points.end()) {
                // A contact that opened by more than the skin in its last step has ended; a bond would have broken.
                if (tension == 0.0 && may_have_parted(world, index_of, name)) continue;
                reader.refuse(contact,
                              fmt::format("no contact between its element {} and element {} of {}", name.element,
                                          name.partner, with),
                              "these elements to touch; check that in_gm.dat and in_cf.dat are from the same run");
            }
            if (!entered.insert(found->second).second)
                reader.refuse(contact, fmt::format("the contact with {} a second time", with),
                              "each contact point only once");
            world.points.shear_force[found->second] = shear_force;
            world.points.state[found->second].flags =
                static_cast<std::uint16_t>(point_touching | (slid ? point_slid : 0));
            if (tension == 0.0) continue;
            bonds = true;
            world.points.state[found->second].flags |= point_bonded;
            world.points.bond_overlap[found->second] = bond_overlap(world, found->second, tension);
        }
    }
    reader.end_reads();
    if (bonds) finish_bonding(world);
}

void write_back_tensions(std::ostream& out, const Scene& scene, const World& world) {
    const BodyNames names(scene);
    LinesOfBodies lines;
    for (PointIndex k = 0; k < world.points.size() && !is_wall(k, world); ++k) {
        double tension = back_tension(world, k);
        if (!world.bonds.made) tension = -law_of(world, k).normal_stiffness * std::max(0.0, overlap_of(world, k));
        if (!(tension < 0.0)) continue;
        const PointName name = name_of(world, k);
        const bool plain = plain_pair(*names.find(name.body), *names.find(name.other));
        for (const PointName& side : {name, name.seen_from_other()}) {
            lines[side.body].emplace_back(
                side, plain ? fmt::format("{} {}\n", side.other, tension)
                            : fmt::format("{} {} {} {}\n", side.other, tension, side.element, side.partner));
        }
    }
    write_lists(out, scene, lines);
}

void read_back_tensions(DeckReader& reader, const Scene& scene, World& world) {
    const BodyNames names(scene);
    const std::map<PointName, PointIndex> points = points_by_name(world);
    struct Listing {
        double tension;
        int line;
    };
    std::map<PointName, Listing> listed;
    for (const Body& body : scene.bodies) {
        const std::int64_t count = read_list_head(reader, body);
        for (std::int64_t c = 0; c < count; ++c) {
            const std::string key = fmt::format("body {}: back-tension {}: ", body.id, c + 1);
            reader.begin_read();
            const std::int64_t other = reader.integer(key + "other body", 1, std::numeric_limits<int>::max());
            const Body* partner = names.find(other);
            if (partner == nullptr || partner == &body) reader.refuse(key + "other body", "another body of in_gm.dat");
            const double tension = reader.number(key + "value");
            if (tension > 0.0) reader.refuse(key + "value", "0 or a negative number, because tension is negative");
            PointName name{body.id, static_cast<int>(other), 1, 1};
            if (!plain_pair(body, *partner)) {
                if (!reader.numbers_follow(2)) {
                    reader.refuse(
                        fmt::format("body {}: back-tension {}", body.id, c + 1), "no element numbers after the value",
                        fmt::format(
                            "the four values other body, value, own_element and other_element, because bodies {} and "
                            "{} are not both single circles; remove the file to bond all bodies that overlap",
                            body.id, other));
                }
                name.element = static_cast<int>(reader.integer(key + "own element", 0, element_count(body)));
                name.partner = static_cast<int>(reader.integer(key + "other's element", 0, element_count(*partner)));
            }
            if (!listed.emplace(name, Listing{tension, reader.line()}).second)
                reader.refuse(key + "other body", "each contact point only once");
        }
    }
    reader.end_reads();
    for (const auto& [name, listing] : listed) {
        const std::string where =
            fmt::format("{}:{}: bodies {} and {}", reader.name(), listing.line, name.body, name.other);
        const auto mirror = listed.find(name.seen_from_other());
        if (mirror == listed.end() || mirror->second.tension != listing.tension) {
            throw InputError(fmt::format(
                "{}: found the back-tension {} in one list and {} in the other, expected the same in both", where,
                listing.tension, mirror == listed.end() ? "none" : fmt::format("{}", mirror->second.tension)));
        }
        const auto found = points.find(name);
        if (found == points.end()) {
            if (points.contains(name.seen_from_other()) || listing.tension == 0.0) continue;
            throw InputError(
                fmt::format("{}: found no contact, expected bonded bodies to touch; check that in_gm.dat and "
                            "in_cf0.dat are from the same run",
                            where));
        }
        if (listing.tension == 0.0) continue;
        world.points.bond_overlap[found->second] = bond_overlap(world, found->second, listing.tension);
        world.points.state[found->second].flags = point_bonded | point_touching;
    }
    finish_bonding(world);
}

}  // namespace crackle
