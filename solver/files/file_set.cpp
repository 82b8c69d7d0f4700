// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a journal: journal_mark, XXH3 hash (64 bits) of the rest, and the renames as written by cereal.
#include "solver/files/file_set.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
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
#include "solver/base/system_failure.hpp"
#include "solver/files/file_stream.hpp"
#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view journal_mark = "CRKLSET3";

std::string damage(const fs::path& journal) {
    return fmt::format(
        "{}: found a journal that is damaged or of another version, expected a complete one; the files in its folder "
        "may "
        "belong to two runs: remove these files and the journal, and run again",
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

/// New files of a set; they are removed on destruction unless keep() is called.
class StagedFiles {
  public:
    explicit StagedFiles(fs::path folder) : folder_(std::move(folder)) {}
    StagedFiles(const StagedFiles&) = delete;
    StagedFiles& operator=(const StagedFiles&) = delete;
    ~StagedFiles() {
        std::error_code ignored;  // errors are ignored, because the next writer of the set overwrites the files
        for (const auto& [from, to] : renames_) fs::remove(folder_ / from, ignored);
    }

    void write(const std::string& name, const std::string& contents) {
        renames_.emplace_back(name + staged_suffix, name);
        const fs::path path = folder_ / renames_.back().first;
        FileStream file;
        file.open(path, FileStream::Opening::fresh);
        file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
        file.close();
        file.require_written(folder_ / name);
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
    } catch (const std::exception&) {
        if (is_there(journal))
            staged.keep();  // the journal exists, although its name may not have been flushed to the disc
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
        if (!is_there(staged)) continue;  // the file already has its final name
        std::error_code error;
        fs::rename(staged, path, error);
        if (error)
            fail_writing(error.value(), fmt::format("{}: cannot be replaced ({})", path.string(), error.message()));
    }
    bring_names_to_disc(journal.parent_path());
    std::error_code error;
    if (!fs::remove(journal, error)) refuse_output(journal);
    // Without this flush, the journal could reappear after a loss of power, and completing it would overwrite later
    // changes.
    bring_names_to_disc(journal.parent_path());
    return true;
}

}  // namespace crackle
