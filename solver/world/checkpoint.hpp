// SPDX-License-Identifier: GPL-3.0-or-later
// The complete state of a world as bytes.
// Tested by tests/verification/determinism_test.cpp.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "solver/world/world.hpp"

namespace crackle {

/// Complete state, versioned; straight and restarted runs agree byte for byte.
void save_world(const World& world, std::ostream& out);
std::string save_world(const World& world);
/// From where a stream stands up to `end`, which are read twice: first to see that nothing is damaged. Takes no more
/// memory than the world.
/// @throws InputError on a foreign, truncated or newer checkpoint; `name` is used in the message.
/// @param remedy what to do where another version wrote it
World load_world(std::istream& in, std::streamoff end, const std::string& name,
                 const char* remedy = "run the test again with this crackle");
World load_world(std::string bytes, const std::string& name,
                 const char* remedy = "run the test again with this crackle");

/// Whether the parts of a loaded world belong together: arrays as long as there are bodies and points, indices within
/// them. A hash tells damage from whole bytes, not bytes that this program wrote from others.
/// @throws InputError if they do not
void require_whole(const World& world, const std::string& name);

}  // namespace crackle
