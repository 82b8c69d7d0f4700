// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes in_bc.dat. See boundary.hpp and FORMATS.md.

#include "solver/demseg/boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <ostream>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"

namespace crackle {
namespace {

constexpr std::int64_t largest_id = std::numeric_limits<int>::max();
constexpr std::int64_t largest_step = 1'000'000'000'000;  // sums of a few values of this size stay far below overflow

DofControl read_dof(DeckReader& reader, int id, const char* flag, const char* value) {
    const bool displacement = reader.integer(fmt::format("body {}: {}", id, flag), 0, 1) == 1;
    return {displacement ? Drive::displacement : Drive::force, reader.number(fmt::format("body {}: {}", id, value))};
}

/// Whether the control holds the body completely, so that no force can move it.
bool holds(const BodyControl& control) {
    return control.x.drive == Drive::displacement && control.y.drive == Drive::displacement &&
           control.rotation.drive == Drive::displacement;
}

std::string dof_text(const DofControl& dof) {
    return fmt::format("{} {}", dof.drive == Drive::displacement ? 1 : 0, dof.value);
}

}  // namespace

BoundaryConditions read_boundary(const std::filesystem::path& path) {
    DeckReader reader = DeckReader::open(path);
    return read_boundary(reader);
}

BoundaryConditions read_boundary(DeckReader& reader) {
    BoundaryConditions boundary;
    const std::int64_t start = reader.integer("jclid", std::numeric_limits<int>::min(), largest_id);
    if (start != 0 && start != 1 && start != 3)
        reader.refuse("jclid", "0 (new), 1 (continued with in_cf.dat) or 3 (bonded)");
    boundary.start = static_cast<DeckStart>(start);
    boundary.steps_before = reader.integer("iloop", 0, largest_step);
    boundary.steps = reader.integer("nstep", 1, largest_step);
    boundary.output_interval = reader.integer("nprn1", 1, largest_step);
    boundary.row_interval = reader.integer("nprn2", 1, largest_step);
    reader.begin_read();
    const std::int64_t watched = reader.integer("npfd", 0, largest_id);
    std::unordered_set<int> ids;
    for (std::int64_t k = 0; k < watched; ++k) {
        const std::string key = fmt::format("id {} of npfd", k + 1);
        // The DEMseg guide does not show whether a single READ statement reads all these ids.
        if (k == 0 || !reader.numbers_follow(1)) reader.begin_read();
        const int id = static_cast<int>(reader.integer(key, 1, largest_id));
        if (!ids.insert(id).second) reader.refuse(key, fmt::format("{} a second time", id), "each body once");
        boundary.watched.push_back(id);
    }
    ids.clear();
    reader.begin_read();
    const std::int64_t controlled = reader.integer("npbd", 0, largest_id);
    for (std::int64_t k = 0; k < controlled; ++k) {
        BodyControl control;
        const std::string key = fmt::format("id {} of npbd", k + 1);
        reader.begin_read();
        control.id = static_cast<int>(reader.integer(key, 1, largest_id));
        if (!ids.insert(control.id).second)
            reader.refuse(key, fmt::format("{} a second time", control.id), "each body once");
        control.x = read_dof(reader, control.id, "fx", "vx");
        control.y = read_dof(reader, control.id, "fy", "vy");
        control.rotation = read_dof(reader, control.id, "fw", "vw");
        boundary.controls.push_back(control);
    }
    reader.end_reads();
    return boundary;
}

void write_boundary(std::ostream& out, const BoundaryConditions& boundary) {
    out << fmt::format("{} {} {} {} {}\n", static_cast<int>(boundary.start), boundary.steps_before, boundary.steps,
                       boundary.output_interval, boundary.row_interval);
    out << boundary.watched.size() << '\n';
    for (const int id : boundary.watched) out << id << '\n';
    out << boundary.controls.size() << '\n';
    for (const BodyControl& c : boundary.controls) {
        out << fmt::format("{} {} {} {}\n", c.id, dof_text(c.x), dof_text(c.y), dof_text(c.rotation));
    }
}

void apply_controls(const BoundaryConditions& boundary, Scene& scene) {
    std::unordered_map<int, int> index_of;
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) index_of[scene.bodies[k].id] = static_cast<int>(k);
    const auto find = [&](int id, const char* list) {
        const auto found = index_of.find(id);
        if (found != index_of.end()) return found->second;
        throw InputError(fmt::format("in_bc.dat: {}: found body {}, expected one of the {} bodies of in_gm.dat", list,
                                     id, scene.bodies.size()));
    };
    for (const int id : boundary.watched) find(id, "npfd");
    for (const BodyControl& control : boundary.controls) {
        scene.controls.push_back({find(control.id, "npbd"), control.x, control.y, control.rotation, boundary.steps});
    }
    if (std::ranges::count_if(boundary.controls, holds) > 1) scene.driven_contacts = DrivenContacts::all;
}

}  // namespace crackle
