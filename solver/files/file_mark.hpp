// SPDX-License-Identifier: GPL-3.0-or-later
// Length and hash of a file, or of its beginning, to recognise it later.
// Tested by tests/solver/files/file_mark_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "solver/base/fields.hpp"

namespace crackle {

/// Length and hash of a file's beginning.
struct FileMark {
    std::uint64_t bytes = 0;
    std::uint64_t hash = 0;  ///< XXH3 hash (64 bits) of these bytes

    /// Whether length and hash are the same.
    bool operator==(const FileMark&) const = default;

    CRACKLE_FIELDS(bytes, hash);
};

/// Mark of the complete contents of a file, given in memory.
FileMark mark_of(std::string_view contents);
/// Mark of a whole file. The file is read in pieces. @throws InputError if it cannot be read
FileMark mark_of_file(const std::filesystem::path& file);

/// The hash as 16 hexadecimal digits, as `xxhsum -H3` prints it.
std::string hash_text(const FileMark& mark);

}  // namespace crackle
