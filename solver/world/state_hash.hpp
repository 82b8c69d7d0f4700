// SPDX-License-Identifier: GPL-3.0-or-later
// Hashes of a world's state, field by field. If two runs that should be identical differ, the hashes show which field
// differs first.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Hash of one field of a world.
struct FieldHash {
    std::string name;  ///< "bodies.state", "points.shear_force", ...
    std::uint64_t hash;

    friend bool operator==(const FieldHash&, const FieldHash&) = default;
};

/// XXH3 hash of every field that a checkpoint saves, in the order in which they are saved; padding is excluded.
std::vector<FieldHash> hash_fields(const World& world);

/// A single hash of the complete state.
std::uint64_t hash_state(const World& world);

}  // namespace crackle
