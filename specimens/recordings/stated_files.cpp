// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/stated_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

std::optional<FileMark> mark_from(const Json& entry) {
    if (!entry.is_object() || !entry.contains("bytes") || !entry.contains("xxh3")) return std::nullopt;
    if (!entry["bytes"].is_number_unsigned() || !entry["xxh3"].is_string()) return std::nullopt;
    FileMark mark{entry["bytes"].get<std::uint64_t>(), 0};
    const auto& digits = entry["xxh3"].get_ref<const std::string&>();
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, mark.hash, 16);
    if (error != std::errc() || stop != end) return std::nullopt;
    return mark;
}

bool is_plain_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && std::filesystem::path(name).filename() == name;
}

}  // namespace

void state_files(TestSummary& summary, const FileMarks& files) {
    Json stated = Json::object();
    for (const auto& [name, mark] : files) stated[name] = {{"bytes", mark.bytes}, {"xxh3", hash_text(mark)}};
    summary.json()["files"] = std::move(stated);
}

FileMarks stated_files(const TestSummary& summary, const std::string& name) {
    FileMarks files;
    if (!summary.contains("files")) return files;
    const auto refuse = [&](const std::string& key) {
        throw InputError(
            fmt::format("{}: {:.60}: found no bytes and xxh3 of files, expected those that the test wrote; restore the "
                        "file, or run the test again with --force",
                        name, key));
    };
    const Json& stated = summary.json()["files"];
    if (!stated.is_object() || stated.empty()) refuse("files");
    for (const auto& [file, entry] : stated.items()) {
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
