// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the bytes of an input to what a reader needs: files in a private folder, values, corrected hashes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crackle::fuzz {

/// Separates the files of an input that consists of several.
inline constexpr std::string_view next_file = "\n%%%%\n";

/// The files of an input; missing files are empty.
template <std::size_t Count>
std::array<std::string_view, Count> files_of(std::string_view bytes) {
    std::array<std::string_view, Count> files{};
    for (std::size_t k = 0; k < Count; ++k) {
        const std::size_t end = k + 1 < Count ? bytes.find(next_file) : std::string_view::npos;
        files[k] = bytes.substr(0, end);
        bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + next_file.size());
    }
    return files;
}

/// A folder of this process in memory (/dev/shm, or $CRACKLE_FUZZ_FOLDER), removed when the process ends.
const std::filesystem::path& scratch();

/// Writes a file to scratch(). @return its path
std::filesystem::path write_file(const std::filesystem::path& name, std::string_view bytes);

/// Stores the XXH3 hash of [begin, end - 8) in the last eight bytes.
void mend_xxh3(std::string& bytes, std::size_t begin, std::size_t end);

/// Corrects the hash of a world's checkpoint that ends at `end`, wherever it begins, and sets the current version.
void mend_world(std::string& bytes, std::size_t end);

/// Reads small values from an input's bytes; returns zeros after the end.
class Values {
  public:
    explicit Values(std::string_view bytes) : bytes_(bytes) {}

    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const auto value = static_cast<std::uint8_t>(bytes_.front());
        bytes_.remove_prefix(1);
        return value;
    }
    /// A small whole number, or a number that is difficult for readers.
    double number();
    /// A list of at most 15 numbers.
    std::vector<double> numbers();

  private:
    std::string_view bytes_;
};

}  // namespace crackle::fuzz
