// SPDX-License-Identifier: GPL-3.0-or-later
// From the bytes of an input to what a reader takes: files in a private folder, values, hashes made right again.
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

/// Stands between the files of an input that is several.
inline constexpr std::string_view next_file = "\n%%%%\n";

/// The files of an input; those that it lacks are empty.
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

/// A folder of this process in the memory (/dev/shm, or $CRACKLE_FUZZ_FOLDER), removed at its end.
const std::filesystem::path& scratch();

/// @return its path
std::filesystem::path write_file(const std::filesystem::path& name, std::string_view bytes);

/// Puts XXH3 of [begin, end - 8) into the last eight bytes.
void mend_xxh3(std::string& bytes, std::size_t begin, std::size_t end);

/// Mends a world's checkpoint that ends at `end`, wherever it begins; its version becomes the present one.
void mend_world(std::string& bytes, std::size_t end);

/// Small values one after the other out of an input's bytes; zeros at its end.
class Values {
  public:
    explicit Values(std::string_view bytes) : bytes_(bytes) {}

    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const auto value = static_cast<std::uint8_t>(bytes_.front());
        bytes_.remove_prefix(1);
        return value;
    }
    /// A small whole number, or one of those that readers stumble over.
    double number();
    /// At most 15.
    std::vector<double> numbers();

  private:
    std::string_view bytes_;
};

}  // namespace crackle::fuzz
