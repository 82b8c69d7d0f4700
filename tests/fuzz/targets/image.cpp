// SPDX-License-Identifier: GPL-3.0-or-later
// A PNG image of minerals for four grains. The checksums of its chunks are corrected.

#include <zlib.h>

#include "specimens/making/minerals.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace crackle::fuzz {
namespace {

constexpr std::size_t signature = 8, frame = 12;  // bytes of a chunk's length, name and checksum

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word = word << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    return word;
}

void mend_chunks(std::string& bytes) {
    for (std::size_t at = signature; at + frame <= bytes.size();) {
        const std::size_t length = word_at(bytes, at);
        if (length > bytes.size() - at - frame) return;
        const auto* named = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
        const uLong sum = crc32(0, named, static_cast<uInt>(length + 4));
        for (std::size_t k = 0; k < 4; ++k) bytes[at + 8 + length + k] = static_cast<char>(sum >> (24 - 8 * k) & 0xff);
        at += length + frame;
    }
}

}  // namespace

void image(std::string_view bytes) {
    Scene scene;
    Material material;
    material.density = 1.0;
    scene.materials.assign(2, material);
    scene.domain = {0.0, 4.0, 0.0, 4.0};
    for (int id = 1; id <= 4; ++id) scene.add_circle_body(id, 0, {{id % 2 == 0 ? 1.0 : 3.0, id < 3 ? 1.0 : 3.0}, 1.0});
    parts::Minerals minerals;
    minerals.list = {{"quartz", {}, {}, 0.0}, {"mica", {}, {}, 0.0}};
    minerals.assign = parts::GrainImage{scratch() / "image.png", "image.png", {0x000000, 0xffffff}};
    std::string png(bytes);
    mend_chunks(png);
    write_file("image.png", png);
    std::vector<std::string> notices;
    assign_minerals(scene, minerals, {}, notices);
}

}  // namespace crackle::fuzz
