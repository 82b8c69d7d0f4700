// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes new_state.bin. Layout: magic number, version, four hashes, then three strings, each preceded by its
// length.

#include "solver/demseg/deck_state.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <bit>
#include <cstring>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/demseg/deck_reader.hpp"
#include "solver/files/read_file.hpp"
#include "solver/world/checkpoint.hpp"

namespace crackle {
namespace {

static_assert(std::endian::native == std::endian::little, "state files are little-endian");

constexpr std::string_view magic = "CRKLDECK";
constexpr std::uint64_t version = 1;
constexpr std::size_t head_bytes = magic.size() + (1 + deck_text_names.size()) * sizeof(std::uint64_t);

void put(std::string& out, std::uint64_t value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof value);
}

void put(std::string& out, const std::string& text) {
    put(out, static_cast<std::uint64_t>(text.size()));
    out += text;
}

class Source {
  public:
    Source(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {}

    std::string_view take(std::uint64_t count) {
        if (count > bytes_.size())
            throw InputError(fmt::format(
                "{}: found a truncated state, expected a complete one; remove it to run without it", name_));
        const std::string_view result = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return result;
    }
    std::uint64_t number() {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() { return std::string(take(number())); }
    bool at_end() const { return bytes_.empty(); }

  private:
    const std::string& name_;
    std::string_view bytes_;
};

std::uint64_t hash_of(const std::string& text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace

std::string save_deck_state(const DeckState& state, const DeckTexts& texts) {
    std::string out(magic);
    put(out, version);
    for (const std::string& text : texts) put(out, hash_of(text));
    put(out, state.base_geometry);
    put(out, state.base_boundary);
    put(out, save_world(state.world));
    return out;
}

std::optional<DeckState> load_deck_state(const std::filesystem::path& path, const DeckTexts& texts,
                                         const std::array<bool, 4>& present, std::vector<std::string>& edited) {
    const std::string name = path.string();
    const std::string bytes = read_file(path);
    Source source(name, bytes);
    if (source.take(magic.size()) != magic)
        throw InputError(
            fmt::format("{}: found other data, expected a deck's state; remove it to run without it", name));
    const std::uint64_t found_version = source.number();
    if (found_version != version) {
        throw InputError(fmt::format("{}: found version {} of a deck's state, expected {}; remove it to run without it",
                                     name, found_version, version));
    }
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const std::uint64_t hash = source.number();
        if (present[k] && hash != hash_of(texts[k])) edited.emplace_back(deck_text_names[k]);
    }
    if (!edited.empty()) return std::nullopt;
    DeckState state;
    state.base_geometry = source.text();
    state.base_boundary = source.text();
    state.world = load_world(source.text(), name, "remove it to continue from the text files");
    require_whole(state.world, name);
    if (!source.at_end())
        throw InputError(
            fmt::format("{}: found more bytes after the end of the state, expected the end of the file; remove the "
                        "file to run without it",
                        name));
    return state;
}

std::optional<DeckLaws> laws_of_deck_state(const std::filesystem::path& path, std::size_t which,
                                           const std::string& text) {
    const std::string name = path.string();
    const std::string bytes = read_file(path);
    if (bytes.size() < head_bytes || !bytes.starts_with(magic)) return std::nullopt;
    Source source(name, bytes);
    source.take(magic.size());
    if (source.number() != version) return std::nullopt;
    const std::uint64_t asked = hash_of(text);
    for (std::size_t k = 0; k < deck_text_names.size(); ++k)
        if (source.number() != asked && k == which) return std::nullopt;
    source.text();  // skips the initial geometry and boundary conditions
    source.text();
    const World world = load_world(source.text(), name, "remove the file to run without it");
    return DeckLaws{world.settings.segment_law, world.settings.integrator};
}

}  // namespace crackle
