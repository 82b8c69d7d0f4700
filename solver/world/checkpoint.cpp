// SPDX-License-Identifier: GPL-3.0-or-later
// Complete state of a world as bytes, through cereal's binary archive. What a restart needs is all here, the neighbour
// list and the remembered facing edges included, so that a restarted run does the very same arithmetic.

#include "solver/world/checkpoint.hpp"

#include <fmt/format.h>

#include <xxhash.h>
#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/vector.hpp>

#include <cstdint>
#include <istream>
#include <memory>
#include <sstream>
#include <utility>

#include "solver/base/archive.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/watching_buffer.hpp"
#include "solver/files/read_pieces.hpp"

namespace crackle {

// Raise when a field of a group is added, removed or moved.
constexpr std::uint32_t checkpoint_version = 18;
constexpr std::uint64_t checkpoint_magic = 0x454c4b4341524321ULL;  // "!CRACKLE"

template <class Archive>
void serialize(Archive& archive, World& world) {
    World::groups(world, [&](const char* /*name*/, auto& group) { archive(group); });
}

void save_world(const World& world, std::ostream& out) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    WatchingBuffer buffer(out,
                          [&](std::string_view piece) { XXH3_64bits_update(hash.get(), piece.data(), piece.size()); });
    std::ostream watched(&buffer);
    cereal::BinaryOutputArchive{watched}(checkpoint_magic, checkpoint_version, world);
    watched.flush();
    if (!watched) out.setstate(std::ios::badbit);
    cereal::BinaryOutputArchive{out}(XXH3_64bits_digest(hash.get()));
}

std::string save_world(const World& world) {
    std::ostringstream out(std::ios::binary);
    save_world(world, out);
    return std::move(out).str();
}

World load_world(std::istream& in, std::streamoff end, const std::string& name) {
    constexpr std::streamoff head = sizeof checkpoint_magic + sizeof checkpoint_version, tail = sizeof(XXH64_hash_t);
    const std::streamoff begin = in.tellg();
    if (!in || end - begin < head + tail)
        throw InputError(fmt::format("{}: found {} bytes, expected a crackle checkpoint", name, in ? end - begin : 0));
    std::uint64_t magic = 0;
    std::uint32_t version = 0;
    cereal::BinaryInputArchive archive(in);
    archive(magic, version);
    if (magic != checkpoint_magic)
        throw InputError(fmt::format("{}: found other data, expected a crackle checkpoint", name));
    if (version != checkpoint_version) {
        throw InputError(
            fmt::format("{}: found checkpoint version {}, expected {}; run the test again with this crackle", name,
                        version, checkpoint_version));
    }
    // Checked before a single length in it is used.
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash(XXH3_createState(), &XXH3_freeState);
    XXH3_64bits_reset(hash.get());
    const auto add = [&](std::string_view piece) { XXH3_64bits_update(hash.get(), piece.data(), piece.size()); };
    XXH64_hash_t noted = 0;
    const bool read = read_pieces(in, begin, end - tail, add) && in.read(reinterpret_cast<char*>(&noted), tail);
    if (!read || XXH3_64bits_digest(hash.get()) != noted)
        throw InputError(fmt::format("{}: found a truncated or damaged checkpoint, expected a complete one", name));
    in.seekg(begin + head);
    World world;
    archive(world);
    world.workers.marks.resize(world.bodies.size());
    set_threads(world, 1);
    return world;
}

World load_world(std::string bytes, const std::string& name) {
    std::istringstream in(std::move(bytes), std::ios::binary);
    return load_world(in, length_of_stream(in), name);
}

}  // namespace crackle
