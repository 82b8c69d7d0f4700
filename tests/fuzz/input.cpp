// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/input.hpp"

#include <unistd.h>
#include <xxhash.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "solver/world/checkpoint.hpp"

namespace crackle::fuzz {
namespace {

namespace fs = std::filesystem;

class Scratch {
  public:
    Scratch() {
        const char* asked = std::getenv("CRACKLE_FUZZ_FOLDER");
        std::error_code error;
        const fs::path parent = asked != nullptr                      ? fs::path(asked)
                                : fs::is_directory("/dev/shm", error) ? fs::path("/dev/shm")
                                                                      : fs::temp_directory_path();
        std::string name = (parent / "crackle_fuzz_").string() + std::string(6, 'X');  // replaced by mkdtemp()
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
        path = name;
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }

    fs::path path;
};

}  // namespace

const fs::path& scratch() {
    static const Scratch folder;
    return folder.path;
}

fs::path write_file(const fs::path& name, std::string_view bytes) {
    fs::path path = scratch() / name;
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw std::runtime_error(path.string() + ": cannot be written");
    return path;
}

void mend_xxh3(std::string& bytes, std::size_t begin, std::size_t end) {
    if (end > bytes.size() || begin + sizeof(XXH64_hash_t) > end) return;
    const std::size_t at = end - sizeof(XXH64_hash_t);
    const XXH64_hash_t hash = XXH3_64bits(bytes.data() + begin, at - begin);
    std::memcpy(bytes.data() + at, &hash, sizeof hash);
}

void mend_world(std::string& bytes, std::size_t end) {
    constexpr std::size_t magic = 8, version = 4;  // bytes
    static const std::string present = save_world(World{});
    const std::size_t begin = bytes.rfind("!CRACKLE", end);
    if (begin == std::string::npos || end - begin < magic + version) return;
    bytes.replace(begin + magic, version, present, magic, version);
    mend_xxh3(bytes, begin, end);
}

double Values::number() {
    constexpr std::array<double, 8> awkward{-1.0,  0.5,    2147483648.0, 4294967295.0,
                                            1e300, 1e-300, -0.0,         std::numeric_limits<double>::infinity()};
    const std::uint8_t value = byte();
    if (value < 240) return value;
    if (value < 248) return awkward[value - 240U];
    if (value == 248) return std::numeric_limits<double>::quiet_NaN();
    return -value;
}

std::vector<double> Values::numbers() {
    std::vector<double> values(byte() % 16U);
    for (double& value : values) value = number();
    return values;
}

}  // namespace crackle::fuzz
