// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a journal: journal_mark, XXH3 (64 bits) of what follows, files and renames as cereal writes them. Journals
// of the first layout have no renames.
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

constexpr std::string_view journal_mark = "CRKLSET2", journal_mark_without_renames = "CRKLSET1";
static_assert(journal_mark.size() == journal_mark_without_renames.size());

struct Replacement {
    FileSet files;
    Renames renames;
};

std::string damage(const fs::path& journal) {
    return fmt::format(
        "{}: found a damaged journal, expected one that is whole; the files beside it may belong to two runs: remove "
        "them with it and run again",
        journal.string());
}

std::uint64_t hash_of_set(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

bool is_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && fs::path(name).filename() == name;
}

Replacement read_journal(const fs::path& journal) {
    const std::string text = read_file(journal);
    std::uint64_t hash = 0;
    const bool with_renames = text.starts_with(journal_mark);
    if (text.size() < journal_mark.size() + sizeof hash ||
        !(with_renames || text.starts_with(journal_mark_without_renames)))
        throw InputError(damage(journal));
    std::memcpy(&hash, text.data() + journal_mark.size(), sizeof hash);
    const std::string packed = text.substr(journal_mark.size() + sizeof hash);
    if (hash != hash_of_set(packed)) throw InputError(damage(journal));
    std::istringstream in(packed);
    Replacement all;
    CheckedInput input(in, static_cast<std::streamoff>(packed.size()), damage(journal));
    input(all.files);
    if (with_renames) input(all.renames);
    for (const auto& [name, contents] : all.files)
        if (!is_name(name)) throw InputError(damage(journal));
    for (const auto& [from, to] : all.renames)
        if (!is_name(from) || !is_name(to)) throw InputError(damage(journal));
    return all;
}

void rename_files(const fs::path& folder, const Renames& renames) {
    for (const auto& [from, to] : renames) {
        if (!is_there(folder / from)) continue;  // it has its name already
        std::error_code error;
        fs::rename(folder / from, folder / to, error);
        if (error)
            throw OutputError(fmt::format("{}: cannot be replaced ({})", (folder / to).string(), error.message()));
    }
    if (!renames.empty()) bring_names_to_disc(folder);
}

}  // namespace

void write_journal(const fs::path& journal, const FileSet& files, const Renames& renames) {
    std::ostringstream out;
    cereal::BinaryOutputArchive{out}(files, renames);
    const std::string packed = std::move(out).str();
    const std::uint64_t hash = hash_of_set(packed);
    std::string text(journal_mark);
    text.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    replace_file(journal, text + packed);
}

bool renames_files(const fs::path& journal) { return is_there(journal) && !read_journal(journal).renames.empty(); }

bool complete_replacement(const fs::path& journal) {
    if (!is_there(journal)) return false;
    const Replacement all = read_journal(journal);
    for (const auto& [name, contents] : all.files) replace_file(journal.parent_path() / name, contents);
    rename_files(journal.parent_path(), all.renames);
    std::error_code error;
    if (!fs::remove(journal, error)) refuse_output(journal);
    bring_names_to_disc(journal.parent_path());  // else a loss of power brings it back, over what is edited since
    return true;
}

}  // namespace crackle
