// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a journal: magic, XXH3 (64 bits) of what follows, the set as cereal writes it.
#include "solver/files/file_set.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string_view>

#include "solver/base/checked_input.hpp"
#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "CRKLSET1";

std::string damage(const fs::path& journal) {
    return fmt::format(
        "{}: found a damaged journal, expected one that is whole; the files beside it may belong to two runs: remove "
        "them with it and run again",
        journal.string());
}

std::uint64_t hash_of(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

FileSet read_journal(const fs::path& journal) {
    const std::string text = read_file(journal);
    std::uint64_t hash = 0;
    if (text.size() < magic.size() + sizeof hash || !text.starts_with(magic)) throw InputError(damage(journal));
    std::memcpy(&hash, text.data() + magic.size(), sizeof hash);
    const std::string packed = text.substr(magic.size() + sizeof hash);
    if (hash != hash_of(packed)) throw InputError(damage(journal));
    std::istringstream in(packed);
    FileSet files;
    CheckedInput(in, static_cast<std::streamoff>(packed.size()), damage(journal))(files);
    for (const auto& [name, contents] : files)
        if (name.empty() || name == "." || name == ".." || fs::path(name).filename() != name)
            throw InputError(damage(journal));
    return files;
}

}  // namespace

void write_journal(const fs::path& journal, const FileSet& files) {
    std::ostringstream out;
    cereal::BinaryOutputArchive{out}(files);
    const std::string packed = std::move(out).str();
    const std::uint64_t hash = hash_of(packed);
    std::string text(magic);
    text.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    replace_file(journal, text + packed);
}

bool complete_replacement(const fs::path& journal) {
    if (!is_there(journal)) return false;
    for (const auto& [name, contents] : read_journal(journal)) replace_file(journal.parent_path() / name, contents);
    std::error_code error;
    if (!fs::remove(journal, error)) refuse_output(journal);
    bring_names_to_disc(journal.parent_path());  // else a loss of power brings it back, over what is edited since
    return true;
}

void replace_files(const fs::path& journal, const FileSet& files) {
    write_journal(journal, files);
    complete_replacement(journal);
}

}  // namespace crackle
