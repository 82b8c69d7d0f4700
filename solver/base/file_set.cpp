// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of a journal: magic, hash of what follows, then name and contents of each file with their lengths before them.
#include "solver/base/file_set.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "solver/base/errors.hpp"
#include "solver/base/replace_file.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "CRKLSET1";

void put(std::string& out, std::uint64_t number) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    out.append(bytes, sizeof number);
}

void put(std::string& out, const std::string& text) {
    put(out, static_cast<std::uint64_t>(text.size()));
    out += text;
}

[[noreturn]] void refuse_damaged(const fs::path& journal) {
    throw InputError(
        fmt::format("{}: found a damaged journal, expected one that is whole; the files beside it may belong to two "
                    "runs: remove them with it and run again",
                    journal.string()));
}

std::string read_whole(const fs::path& path) {
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in.is_open() || in.bad())
        throw InputError(fmt::format("{}: cannot be read ({}), expected a file", path.string(), std::strerror(errno)));
    return text;
}

FileSet read_journal(const fs::path& journal) {
    const std::string text = read_whole(journal);
    std::string_view rest = text;
    const auto take = [&](std::uint64_t count) {
        if (count > rest.size()) refuse_damaged(journal);
        const std::string_view taken = rest.substr(0, count);
        rest.remove_prefix(count);
        return taken;
    };
    const auto number = [&] {
        std::uint64_t value = 0;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    };
    if (take(magic.size()) != magic || number() != XXH3_64bits(rest.data(), rest.size())) refuse_damaged(journal);
    FileSet files;
    while (!rest.empty()) {
        std::string name(take(number()));
        if (name.empty() || fs::path(name).filename() != name) refuse_damaged(journal);
        files.emplace_back(std::move(name), take(number()));
    }
    return files;
}

}  // namespace

void write_journal(const fs::path& journal, const FileSet& files) {
    std::string body;
    for (const auto& [name, contents] : files) {
        put(body, name);
        put(body, contents);
    }
    std::string text(magic);
    put(text, XXH3_64bits(body.data(), body.size()));
    replace_file(journal, text + body, Durable::yes);
}

bool complete_replacement(const fs::path& journal) {
    std::error_code error;
    if (!fs::exists(journal, error)) return false;
    for (const auto& [name, contents] : read_journal(journal))
        replace_file(journal.parent_path() / name, contents, Durable::yes);
    if (!fs::remove(journal, error)) refuse_output(journal);
    return true;
}

void replace_files(const fs::path& journal, const FileSet& files) {
    write_journal(journal, files);
    complete_replacement(journal);
}

}  // namespace crackle
