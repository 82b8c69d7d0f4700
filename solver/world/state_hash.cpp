// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/world/state_hash.hpp"

#include <xxhash.h>

#include <type_traits>

#include "solver/base/field_hash.hpp"
#include "solver/base/fields.hpp"

namespace crackle {

std::vector<FieldHash> hash_fields(const World& world) {
    std::vector<FieldHash> hashes;
    const auto add = [&](const std::string& group_name, const auto& group) {
        using Group = std::remove_cvref_t<decltype(group)>;
        static_assert(lists_all_fields<Group>(), "a member is missing from the group's fields()");
        Group::fields(group, [&](const char* name, const auto& field, const auto&... /*more*/) {
            hashes.push_back({group_name + "." + name, hash_of_field(field)});
        });
    };
    World::groups(world, add);
    if (world.faces.size() > 0) add("faces", world.faces);
    return hashes;
}

std::uint64_t hash_state(const World& world) {
    std::vector<std::uint64_t> hashes;
    for (const FieldHash& field : hash_fields(world)) hashes.push_back(field.hash);
    return XXH3_64bits(hashes.data(), hashes.size() * sizeof(std::uint64_t));
}

}  // namespace crackle
