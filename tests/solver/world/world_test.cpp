// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the groups of a world field by field. Each field is hashed separately, survives a checkpoint and, if points
// keep it, is carried to the next neighbour list. Fields are tested without being named here.

#include "solver/world/world.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/base/errors.hpp"
#include "solver/base/field_hash.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/checkpoint.hpp"
#include "solver/world/point_order.hpp"
#include "solver/world/state_hash.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/solver/world/every_field.hpp"

namespace crackle {
namespace {

using testing::Change;
using testing::Fill;

World world_with_something_everywhere() {
    World world;
    World::groups(world, [](const char* /*name*/, auto& group) { Fill{}.add(group); });
    return world;
}

/// Names of fields whose hashes differ between two worlds.
std::vector<std::string> differing(const World& one, const World& other) {
    const std::vector<FieldHash> a = hash_fields(one), b = hash_fields(other);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k] != b[k]) names.push_back(a[k].name);
    return names;
}

/// Returns "bodies.state" for "bodies.state[0].vx".
std::string field_of(const std::string& name) { return name.substr(0, name.find_first_of(".[", name.find('.') + 1)); }

TEST(WorldGroups, EachFieldIsHashedOnItsOwnAndSurvivesACheckpoint) {
    const World start = world_with_something_everywhere();
    std::set<std::string> fields;
    int changes = 0;
    for (;; ++changes) {
        World world = start;
        Change change(changes);
        World::groups(world, [&](const std::string& name, auto& group) { change.walk(group, name); });
        if (change.changed().empty()) break;
        fields.insert(field_of(change.changed()));
        EXPECT_EQ(differing(start, world), std::vector{field_of(change.changed())}) << change.changed();
        EXPECT_NE(hash_state(world), hash_state(start)) << change.changed();
        const World loaded = load_world(save_world(world), "memory");
        EXPECT_EQ(differing(world, loaded), std::vector<std::string>{}) << change.changed();
        EXPECT_EQ(hash_state(loaded), hash_state(world)) << change.changed();
    }
    fmt::print("  {} fields, {} changes\n", fields.size(), changes);
    EXPECT_EQ(fields.size(), hash_fields(start).size());
}

/// A checkpoint with one byte changed and its hash corrected, as if it had been edited deliberately.
std::string tampered(std::string bytes, std::size_t at, char value) {
    bytes[at] = value;
    const std::size_t end = bytes.size() - sizeof(XXH64_hash_t);
    const XXH64_hash_t hash = XXH3_64bits(bytes.data(), end);
    std::memcpy(bytes.data() + end, &hash, sizeof hash);
    return bytes;
}

TEST(Checkpoint, LengthsThatItCannotHoldAndFlagsThatAreNoneAreRefused) {
    const std::string bytes = save_world(world_with_something_everywhere());
    int refused = 0;
    for (std::size_t at = 12; at + 8 < bytes.size(); ++at) {  // after magic number and version
        try {
            load_world(tampered(bytes, at, '\x7f'), "memory");
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(), "memory: found a truncated or damaged checkpoint, expected a complete one");
            ++refused;
        }
    }
    fmt::print("  {} bytes, {} of them in lengths and flags\n", bytes.size(), refused);
    EXPECT_GT(refused, 200);
}

TEST(WorldGroups, NamesOfFieldsAreTheirOwn) {
    std::set<std::string> names;
    for (const FieldHash& field : hash_fields(World{})) EXPECT_TRUE(names.insert(field.name).second) << field.name;
}

/// Bonded touching discs, and a single one far to their left. All arrays of points are in use, except that arrays for
/// faces in area units and those for the guide's law exclude each other.
World bonded_discs_and_a_lone_one(bool area) {
    Scene scene = triangular_lattice(4, 3, 0.02, 1e-4, verification::rock());
    scene.add_circle_body(100, 0, {{-1.0, 0.02}, 0.02});
    if (area)
        scene.units = StiffnessUnits::area;
    else
        scene.segment_law = SegmentLaw::demseg;
    scene.integrator = Integrator::consistent;
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    return world;
}

/// Assigns a different number to each member of each element, except kinds of points and flags, whose values have
/// meanings.
struct Number {
    double next = 1.0;

    template <class T>
    void give(T& value) {
        if constexpr (HasFields<T>) {
            T::fields(value, [&](const char* /*name*/, auto& field, const auto&... /*more*/) { give(field); });
        } else {
            value = static_cast<T>(next++);
        }
    }
    void give(PointState& state) {
        if (static_cast<int>(next++) % 2 == 0) state.flags = static_cast<std::uint16_t>(state.flags | point_slid);
    }
};

void expect_all_carried(World world, int fewest) {
    Number number;
    int arrays = 0;
    visit_remembered(world.points, [&](auto& values, Remembered remembered) {
        if (!keeps(world, remembered)) return;
        ++arrays;
        ASSERT_EQ(values.size(), world.points.size());
        for (auto& value : values) number.give(value);
    });
    EXPECT_GE(arrays, fewest);
    const World before = world;

    // The single disc comes into contact with another: new points are inserted before or among the old ones.
    const auto id_is = [](int id) { return [id](const BodyName& name) { return name.id == id; }; };
    const auto lone = std::ranges::find_if(world.bodies.names, id_is(100)) - world.bodies.names.begin();
    const auto first = std::ranges::find_if(world.bodies.names, id_is(1)) - world.bodies.names.begin();
    BodyState& moved = world.bodies.state[static_cast<std::size_t>(lone)];
    moved.x = world.bodies.state[static_cast<std::size_t>(first)].x - 0.0399;
    moved.y = world.bodies.state[static_cast<std::size_t>(first)].y;
    bodies_moved(world);
    refresh_neighbours(world);

    std::vector<PointIndex> old;
    std::size_t elsewhere = 0;
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        PointIndex found = 0;
        while (found < before.points.size() &&
               !same_point(PointKind::circle_circle, before.points.contact[found], world.points.contact[k]))
            ++found;
        old.push_back(found);
        elsewhere += found < before.points.size() && found != k ? 1 : 0;
    }
    const auto is_new = [&](PointIndex k) { return k == before.points.size(); };
    EXPECT_GT(std::ranges::count_if(old, is_new), 0);
    EXPECT_GT(elsewhere, before.points.size() / 2);

    std::vector<std::vector<std::uint64_t>> hashes;
    Points then = before.points;
    visit_remembered(then, [&](auto& values, Remembered /*remembered*/) {
        // Whether a point counts in the bound on the step is determined again for each list.
        if constexpr (requires { values[0].flags; })
            for (auto& value : values) value.flags = static_cast<std::uint16_t>(value.flags & ~point_counted);
        hashes.emplace_back();
        for (const auto& value : values) hashes.back().push_back(hash_of_field(value));
    });
    std::size_t array = 0;
    Points now = world.points;
    visit_remembered(now, [&]<class T>(Array<T>& values, Remembered remembered) {
        if (!keeps(world, remembered)) {
            EXPECT_TRUE(values.empty());
            ++array;
            return;
        }
        if constexpr (requires { values[0].flags; })
            for (auto& value : values) value.flags = static_cast<std::uint16_t>(value.flags & ~point_counted);
        ASSERT_EQ(values.size(), old.size());
        for (std::size_t k = 0; k < old.size(); ++k) {
            if (is_new(old[k]) && std::is_same_v<T, float> && remembered == Remembered::own_shares) continue;  // set
            EXPECT_EQ(hash_of_field(values[k]), is_new(old[k]) ? hash_of_field(T{}) : hashes[array][old[k]])
                << "array " << array << ", point " << k;
        }
        ++array;
    });
}

TEST(WorldGroups, WhatPointsRememberIsCarriedToTheNextList) {
    expect_all_carried(bonded_discs_and_a_lone_one(false), 9);
    expect_all_carried(bonded_discs_and_a_lone_one(true), 10);
}

}  // namespace
}  // namespace crackle
