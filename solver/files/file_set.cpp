// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a journal: journal_mark, XXH3 (64 bits) of what follows, renames as cereal writes them.
#include "solver/files/file_set.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>

#include "solver/base/checked_input.hpp"
#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view journal_mark = "CRKLSET3";

std::string damage(const fs::path& journal) {
    return fmt::format(
        "{}: found a journal that is damaged or of another version, expected one that is whole; the files beside it "
        "may "
        "belong to two runs: remove them with it and run again",
        journal.string());
}

std::uint64_t hash_of_set(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

bool is_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && fs::path(name).filename() == name;
}

Renames read_journal(const fs::path& journal) {
    const std::string text = read_file(journal);
    std::uint64_t hash = 0;
    if (text.size() < journal_mark.size() + sizeof hash || !text.starts_with(journal_mark))
        throw InputError(damage(journal));
    std::memcpy(&hash, text.data() + journal_mark.size(), sizeof hash);
    const std::string packed = text.substr(journal_mark.size() + sizeof hash);
    if (hash != hash_of_set(packed)) throw InputError(damage(journal));
    std::istringstream in(packed);
    Renames renames;
    CheckedInput(in, static_cast<std::streamoff>(packed.size()), damage(journal))(renames);
    for (const auto& [from, to] : renames)
        if (!is_name(from) || !is_name(to)) throw InputError(damage(journal));
    return renames;
}

/// Removed again unless they were kept.
class StagedFiles {
  public:
    explicit StagedFiles(fs::path folder) : folder_(std::move(folder)) {}
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;
    ~StagedFiles() {
        std::error_code ignored;  // the next who writes the set begins them anew
        for (const auto& [from, to] : renames_) fs::remove(folder_ / from, ignored);
    }

    void write(const std::string& name, const std::string& contents) {
        renames_.emplace_back(name + staged_suffix, name);
        const fs::path path = folder_ / renames_.back().first;
        errno = 0;
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
        file.close();
        if (!file) refuse_output(folder_ / name);
    }
    const Renames& renames() const { return renames_; }
    void keep() { renames_.clear(); }

  private:
    fs::path folder_;
    Renames renames_;
};

}  // namespace

void write_journal(const fs::path& journal, const FileSet& files, const Renames& renames) {
    StagedFiles staged(journal.parent_path());
    for (const auto& [name, contents] : files) staged.write(name, contents);
    bring_all_to_disc(journal.parent_path());
    Renames all = staged.renames();
    all.insert(all.end(), renames.begin(), renames.end());
    std::ostringstream out;
    cereal::BinaryOutputArchive{out}(all);
    const std::string packed = std::move(out).str();
    const std::uint64_t hash = hash_of_set(packed);
    std::string text(journal_mark);
    text.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    try {
        replace_file(journal, text + packed);
    } catch (const OutputError&) {
        if (is_there(journal)) staged.keep();  // its name alone may not be on the disc
        throw;
    }
    staged.keep();
}

bool gives_name(const fs::path& journal, std::span<const char* const> names) {
    if (!is_there(journal)) return false;
    const Renames renames = read_journal(journal);
    return std::any_of(renames.begin(), renames.end(), [&](const auto& rename) {
        return std::find(names.begin(), names.end(), rename.second) != names.end();
    });
}

bool complete_replacement(const fs::path& journal) {
    if (!is_there(journal)) return false;
    for (const auto& [from, to] : read_journal(journal)) {
        const fs::path staged = journal.parent_path() / from, path = journal.parent_path() / to;
        if (!is_there(staged)) continue;  // it has its name already
        std::error_code error;
        fs::rename(staged, path, error);
        if (error) throw OutputError(fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    }
    bring_names_to_disc(journal.parent_path());
    std::error_code error;
    if (!fs::remove(journal, error)) refuse_output(journal);
    bring_names_to_disc(journal.parent_path());  // else a loss of power brings it back, over what is edited since
    return true;
}

}  // namespace crackle
