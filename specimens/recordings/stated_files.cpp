// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/stated_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

std::optional<FileMark> mark_from(const FileFigures& entry) {
    if (entry.bytes.value_or(-1) < 0 || !entry.xxh3) return std::nullopt;
    FileMark mark{static_cast<std::uint64_t>(*entry.bytes), 0};
    const std::string& digits = *entry.xxh3;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, mark.hash, 16);
    if (error != std::errc() || stop != end) return std::nullopt;
    return mark;
}

bool is_plain_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && std::filesystem::path(name).filename() == name;
}

}  // namespace

void state_files(Summary& summary, const FileMarks& files) {
    auto& stated = summary.files.begin_table();
    for (const auto& [name, mark] : files) stated.emplace_back(name, FileFigures{mark.bytes, hash_text(mark)});
}

FileMarks stated_files(const Summary& summary, const std::string& name) {
    FileMarks files;
    if (!summary.files.stated()) return files;
    const auto refuse = [&](const std::string& key) {
        throw InputError(
            fmt::format("{}: {:.60}: found no bytes and xxh3 of files, expected those that the test wrote; restore the "
                        "file, or run the test again with --force",
                        name, key));
    };
    if (!summary.files || summary.files->empty()) refuse("files");
    for (const auto& [file, entry] : *summary.files) {
        const auto mark = mark_from(entry);
        if (!mark || !is_plain_name(file)) refuse("files." + file);
        files.emplace_back(file, mark.value_or(FileMark{}));
    }
    return files;
}

bool states(const FileMarks& stated, const std::string& name) {
    return std::ranges::find(stated, name, &FileMarks::value_type::first) != stated.end();
}

void require_as_stated(const FileMarks& stated, const std::filesystem::path& file, const FileMark& found) {
    if (stated.empty()) return;
    const std::string name = file.filename().string();
    const auto written = std::ranges::find(stated, name, &FileMarks::value_type::first);
    if (written == stated.end()) {
        throw InputError(
            fmt::format("{}: found a file that the test did not write (summary.json has no files.{}), expected none; "
                        "remove it",
                        file.string(), name));
    }
    if (written->second == found) return;
    const bool same_length = written->second.bytes == found.bytes;
    throw InputError(fmt::format(
        "{}: found {}, expected the {} that the test wrote (summary.json, files.{}); restore the file, or run the test "
        "again with --force",
        file.string(), same_length ? fmt::format("{} other bytes", found.bytes) : fmt::format("{} bytes", found.bytes),
        written->second.bytes, name));
}

}  // namespace crackle
