// SPDX-License-Identifier: GPL-3.0-or-later
// Hashes of a world's state, field by field: where two runs that should agree do not, the first field that differs is
// named.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

struct FieldHash {
    std::string name;  ///< "bodies.state", "points.shear_force", ...
    std::uint64_t hash;

    friend bool operator==(const FieldHash&, const FieldHash&) = default;
};

/// XXH3 of every field that a checkpoint saves, in its order; of members, not of padding.
std::vector<FieldHash> hash_fields(const World& world);

/// One number of them all.
std::uint64_t hash_state(const World& world);

}  // namespace crackle
