// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/checkpoint.hpp"

#include <fmt/format.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <istream>

#include "solver/base/archive.hpp"
#include "solver/base/checked_input.hpp"
#include "solver/base/errors.hpp"
#include "solver/base/watching_buffer.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/read_pieces.hpp"
#include "solver/world/checkpoint.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {

// Names the layout; the number is raised whenever a field below changes.
constexpr const char* checkpoint_title = "crackle test checkpoint ";
constexpr const char* checkpoint_version = "20";
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

TestCheckpoint load_test(std::istream& in, const std::string& name) {
    const std::string title = checkpoint_title;
    const std::streamoff length = length_of_stream(in);
    std::string line;
    constexpr std::size_t longest_line = 64;
    for (char letter = 0; line.size() < longest_line && in.get(letter) && letter != '\n';) line += letter;
    refuse_failed(in, name);
    if (!in || !line.starts_with(title) || line.size() == longest_line) {
        throw InputError(fmt::format(
            "{}: found other data, expected a crackle test checkpoint; run the test again with --force", name));
    }
    const std::string version = line.substr(title.size());
    if (version != checkpoint_version) {
        throw InputError(fmt::format(
            "{}: found checkpoint version {}, expected {}; resume with the crackle that wrote it, or run the "
            "test again with --force",
            name, version, checkpoint_version));
    }
    const std::string damaged = fmt::format(
        "{}: found a truncated or damaged checkpoint, expected a complete one; run the test again with --force", name);
    const std::streamoff begin = in.tellg(), end = length - static_cast<std::streamoff>(hash_digits);
    Sha256 hash;
    std::string digits(hash_digits, ' ');
    const bool whole = begin <= end && read_pieces(in, 0, end, [&](std::string_view piece) { hash.add(piece); }) &&
                       in.read(digits.data(), static_cast<std::streamsize>(hash_digits)) && digits == hash.digits();
    refuse_failed(in, name);
    if (!whole) throw InputError(damaged);
    in.seekg(begin);
    TestCheckpoint checkpoint;
    CheckedInput archive(in, end, damaged);
    archive(checkpoint.case_hash, checkpoint.setup, checkpoint.state);
    checkpoint.world = load_world(in, end, name);
    require_whole(checkpoint.world, name);
    return checkpoint;
}

}  // namespace crackle
