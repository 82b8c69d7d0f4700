// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>

#include "solver/base/archive.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/watching_buffer.hpp"
#include "solver/world/checkpoint.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {

// Names the layout; the number is raised whenever a field below changes.
constexpr const char* checkpoint_title = "crackle test checkpoint ";
constexpr const char* checkpoint_version = "12";
constexpr std::size_t hash_digits = 64;

void save_test(std::ostream& out, const std::string& case_hash, const TestSetup& setup, const TestState& state,
               const World& world) {
    Sha256 hash;
    WatchingBuffer buffer(out, [&](std::string_view piece) { hash.add(piece); });
    std::ostream watched(&buffer);
    watched << checkpoint_title << checkpoint_version << '\n';
    cereal::BinaryOutputArchive{watched}(case_hash, setup, state);
    save_world(world, watched);
    watched.flush();
    if (!watched) out.setstate(std::ios::badbit);
    out << hash.digits();
}

TestCheckpoint load_test(const std::string& bytes, const std::string& name) {
    const std::string title = checkpoint_title;
    const std::size_t line_end = bytes.find('\n');
    if (!bytes.starts_with(title) || line_end == std::string::npos) {
        throw InputError(fmt::format(
            "{}: found other data, expected a crackle test checkpoint; run the test again with --force", name));
    }
    const std::string version = bytes.substr(title.size(), line_end - title.size());
    if (version != checkpoint_version) {
        throw InputError(fmt::format(
            "{}: found checkpoint version {}, expected {}; resume with the crackle that wrote it, or run the "
            "test again with --force",
            name, version, checkpoint_version));
    }
    const std::size_t begin = line_end + 1;
    const std::size_t end = std::max(begin + hash_digits, bytes.size()) - hash_digits;
    if (bytes.compare(end, hash_digits, sha256(std::string_view(bytes).substr(0, end))) != 0) {
        throw InputError(
            fmt::format("{}: found a truncated or damaged checkpoint, expected a complete one; run the test again with "
                        "--force",
                        name));
    }
    TestCheckpoint checkpoint;
    std::istringstream in(bytes, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(begin));
    cereal::BinaryInputArchive archive(in);
    archive(checkpoint.case_hash, checkpoint.setup, checkpoint.state);
    const auto world_begin = static_cast<std::size_t>(in.tellg());
    checkpoint.world = load_world(bytes.substr(world_begin, end - world_begin), name);
    return checkpoint;
}

}  // namespace crackle
