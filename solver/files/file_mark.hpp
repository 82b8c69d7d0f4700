// SPDX-License-Identifier: GPL-3.0-or-later
// What is recorded of a file's beginning, or of all of it: by what it is known to be the one that was written.
// Tested by tests/solver/files/file_mark_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace crackle {

struct FileMark {
    std::uint64_t bytes = 0;
    std::uint64_t hash = 0;  ///< XXH3 (64 bits) of these

    bool operator==(const FileMark&) const = default;

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("bytes", s.bytes);
        visit("hash", s.hash);
    }
};

FileMark mark_of(std::string_view contents);
/// Of a whole file, read piece by piece. @throws InputError if it cannot be read
FileMark mark_of_file(const std::filesystem::path& file);

/// The hash as 16 hexadecimal digits, as `xxhsum -H3` prints it.
std::string hash_text(const FileMark& mark);

}  // namespace crackle
