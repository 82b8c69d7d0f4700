// SPDX-License-Identifier: GPL-3.0-or-later
// The journal of a set of files that is being replaced; its hash is corrected.

#include <xxhash.h>

#include "solver/files/file_set.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

void crackle::fuzz::journal(std::string_view bytes) {
    constexpr std::size_t magic = 8, hash_bytes = 8;
    std::string text(bytes);
    if (text.size() >= magic + hash_bytes) {
        const XXH64_hash_t hash = XXH3_64bits(text.data() + magic + hash_bytes, text.size() - magic - hash_bytes);
        std::memcpy(text.data() + magic, &hash, sizeof hash);
    }
    const std::filesystem::path folder = scratch() / "journal";
    std::filesystem::remove_all(folder);  // removes files of the last input
    std::filesystem::create_directories(folder);
    complete_replacement(write_file("journal/files.journal", text));
}
