// SPDX-License-Identifier: GPL-3.0-or-later
// Saves the complete state of a world as bytes, and loads it again.
// Tested by tests/verification/determinism_test.cpp and tests/specimens/results/checkpoint_test.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Writes the complete state, preceded by a version number. An uninterrupted and a restarted run give identical bytes.
void save_world(const World& world, std::ostream& out);
/// Returns the bytes that save_world(world, out) writes.
std::string save_world(const World& world);
/// Reads a world from the current position of a stream to `end`. The bytes are read twice: first to verify their hash,
/// then to load the state. Loading needs no memory beyond the world itself.
/// @throws InputError if the data are not a checkpoint, are truncated or damaged, or were written by another version;
/// the message contains `name`
/// @param remedy the advice in the message if another version wrote the checkpoint
World load_world(std::istream& in, std::streamoff end, const std::string& name,
                 const char* remedy = "run the test again with this version of crackle");
/// Reads a world from a string that contains nothing else.
World load_world(std::string bytes, const std::string& name,
                 const char* remedy = "run the test again with this version of crackle");

/// Whether the bodies and elements that a contact point refers to exist in the world.
bool is_point_of(const World& world, PointKind kind, const ContactPoint& point);
/// Whether `kind_begin` is a valid partition of `count` points into kinds.
bool are_kinds_of(std::span<const PointIndex> kind_begin, std::size_t count);

/// Checks that a loaded world is consistent: array lengths match the numbers of bodies and points, and indices are in
/// range. The hash detects damaged bytes, but cannot prove that this program wrote them.
/// @throws InputError if the world is inconsistent
void require_whole(const World& world, const std::string& name);

}  // namespace crackle
