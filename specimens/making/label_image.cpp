// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/label_image.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"

namespace crackle {
namespace {

bool contains(const Scene& scene, const Body& body, Vec2 place) {
    for (std::uint32_t k = 0; k < body.circle_count; ++k) {
        const CircleElement& circle = scene.circles[body.first_circle + k];
        if (norm(place - circle.centre) < circle.radius) return true;
    }
    bool inside = false;  // parity of the number of edges to the right of the point
    for (std::uint32_t k = 0; k < body.vertex_count; ++k) {
        const Vec2 a = scene.vertices[body.first_vertex + k];
        const Vec2 b = scene.vertices[body.first_vertex + (k + 1) % body.vertex_count];
        if ((a.y > place.y) == (b.y > place.y)) continue;
        if (place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

struct Box {
    double x1 = std::numeric_limits<double>::infinity(), x2 = -x1, y1 = x1, y2 = -x1;
    void include(Vec2 place, double reach) {
        x1 = std::min(x1, place.x - reach);
        x2 = std::max(x2, place.x + reach);
        y1 = std::min(y1, place.y - reach);
        y2 = std::max(y2, place.y + reach);
    }
};

Box box_of(const Scene& scene, const Body& body) {
    Box box;
    for (std::uint32_t k = 0; k < body.circle_count; ++k) {
        const CircleElement& circle = scene.circles[body.first_circle + k];
        box.include(circle.centre, circle.radius);
    }
    for (std::uint32_t k = 0; k < body.vertex_count; ++k) box.include(scene.vertices[body.first_vertex + k], 0.0);
    return box;
}

// Largest number of pixels read into memory; they take 600 MB. A blank image of a few kilobytes can have more.
constexpr std::uint64_t most_pixels = 100'000'000;

// Cairo's limit for width and height.
constexpr std::uint64_t most_pixels_across = 32767;

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t width_at = 16, height_at = 20;

/// Big-endian number in the four bytes at a position.
std::uint64_t number_at(std::string_view bytes, std::size_t at) {
    std::uint64_t number = 0;
    for (std::size_t k = 0; k < 4; ++k) number = number << 8 | static_cast<std::uint8_t>(bytes[at + k]);
    return number;
}

/// Number of pixels according to the header of a PNG file; 0 for any other file.
std::uint64_t pixels_of(const std::filesystem::path& file) {
    std::array<char, height_at + 4> head{};
    std::ifstream in(file, std::ios::binary);
    const std::string_view read(head.data(), head.size());
    if (!in.read(head.data(), head.size()) || !read.starts_with(signature)) return 0;
    return number_at(read, width_at) * number_at(read, height_at);
}

/// Decompresses zlib data and discards the result. @return number of bytes; empty if the data are damaged
std::optional<std::uint64_t> unpacked_bytes(const std::string& packed) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> ended(&stream, inflateEnd);
    std::array<Bytef, 1 << 14> room;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // NOLINT: zlib's own type
    stream.avail_in = static_cast<uInt>(packed.size());
    for (int outcome = Z_OK; outcome == Z_OK;) {
        stream.next_out = room.data();
        stream.avail_out = room.size();
        outcome = inflate(&stream, Z_NO_FLUSH);
        if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
        if (outcome != Z_OK && outcome != Z_STREAM_END) return std::nullopt;
    }
    return stream.total_out;
}

/// Whether memory is insufficient for the pixels of a PNG with a valid header.
bool lacks_room(std::string_view bytes) {
    const auto size = [&](std::size_t at) { return static_cast<int>(number_at(bytes, at)); };
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, size(width_at), size(height_at)), cairo_surface_destroy);
    return cairo_surface_status(surface.get()) == CAIRO_STATUS_NO_MEMORY;
}

/// Describes the defect of a PNG file that Cairo could not read. Cairo itself reports every defect as insufficient
/// memory. Empty if memory really is insufficient.
std::string flaw_of_png(std::string_view bytes) {
    if (!bytes.starts_with(signature)) return "other data";
    constexpr std::size_t frame = 12;  // bytes of a chunk besides its data: length, name, checksum
    constexpr std::array<unsigned, 7> colours{1, 0, 3, 1,
                                              2, 0, 4};  // channels per pixel, by colour type; 0 for invalid types
    std::uint64_t row_bytes = 0, rows = 0;
    bool interlaced = false, needs_palette = false, has_palette = false;
    std::string packed;
    for (std::size_t at = signature.size();;) {
        if (bytes.size() - at < frame) return fmt::format("an end at byte {}, before the IEND chunk", bytes.size());
        const std::uint64_t length = number_at(bytes, at);
        const std::string_view name = bytes.substr(at + 4, 4);
        if (length > bytes.size() - at - frame)
            return fmt::format("a chunk of {} bytes at byte {} that extends beyond the end of the file", length, at);
        const std::string_view data = bytes.substr(at + 8, length);
        const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(name.data()), static_cast<uInt>(4 + length));
        if (sum != number_at(bytes, at + 8 + length))
            return fmt::format("a wrong checksum in the {} chunk at byte {}", name, at);
        const bool first = at == signature.size();
        if (first != (name == "IHDR")) return first ? "no IHDR chunk at the start" : "a second IHDR chunk";
        if (first) {
            if (length != 13) return fmt::format("an IHDR chunk of {} bytes instead of 13", length);
            const std::uint64_t width = number_at(data, 0);
            rows = number_at(data, 4);
            if (width == 0 || rows == 0 || width > most_pixels_across || rows > most_pixels_across)
                return fmt::format("{} x {} pixels, outside of 1 to {} each", width, rows, most_pixels_across);
            const auto depth = static_cast<unsigned char>(data[8]), type = static_cast<unsigned char>(data[9]);
            if (type >= colours.size() || colours[type] == 0 || depth == 0 || depth > 16 ||
                (depth & (depth - 1U)) != 0 || (type == 3 ? depth == 16 : type != 0 && depth < 8))
                return fmt::format("{} bits per channel and colour type {}, which PNG does not allow", depth, type);
            if (data[10] != 0 || data[11] != 0 || (data[12] & ~1) != 0)
                return "a method of compression, filtering or interlacing that PNG does not define";
            row_bytes = (width * colours[type] * depth + 7) / 8 + 1;
            interlaced = data[12] != 0;
            needs_palette = type == 3;
        }
        has_palette = has_palette || name == "PLTE";
        if (name == "IDAT") packed += data;
        if (name == "IEND") break;
        at += frame + length;
    }
    if (packed.empty()) return "no IDAT chunk and therefore no pixels";
    if (needs_palette && !has_palette) return "palette colours without a PLTE chunk";
    const std::optional<std::uint64_t> unpacked = unpacked_bytes(packed);
    if (!unpacked) return "IDAT chunks that cannot be decompressed";
    if (!interlaced && *unpacked < rows * row_bytes)
        return fmt::format("pixels for only {} of {} rows", *unpacked / row_bytes, rows);
    return lacks_room(bytes) ? "" : "a defect in one of its chunks";
}

std::string expected_colours(std::span<const std::uint32_t> colours, std::span<const std::string> names) {
    std::string text;
    for (std::size_t k = 0; k < colours.size(); ++k)
        text += fmt::format("{}#{:06x} ({})", k == 0 ? "" : ", ", colours[k], names[k]);
    return text;
}

}  // namespace

LabelImage::LabelImage(const std::filesystem::path& file, std::span<const std::uint32_t> colours,
                       std::span<const std::string> names, const std::string& where)
    : labels_(colours.size()) {
    if (!is_file(file)) {
        throw InputError(
            fmt::format("{}: found no file {}, expected a PNG image; check the path", where, file.string()));
    }
    if (const std::uint64_t pixels = pixels_of(file); pixels > most_pixels) {
        throw InputError(fmt::format("{}: found {} with {} pixels, expected at most {}; reduce the image's resolution",
                                     where, file.string(), pixels, most_pixels));
    }
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_image_surface_create_from_png(file.string().c_str()), cairo_surface_destroy);
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS) {
        const std::string flaw = flaw_of_png(read_file(file));
        if (flaw.empty() && status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
        throw InputError(
            fmt::format("{}: found {}, which cannot be read as PNG because it has {}, expected a PNG image; "
                        "save the image again",
                        where, file.string(), flaw.empty() ? cairo_status_to_string(status) : flaw));
    }
    const cairo_format_t format = cairo_image_surface_get_format(surface.get());
    if (format != CAIRO_FORMAT_RGB24 && format != CAIRO_FORMAT_ARGB32) {
        throw InputError(
            fmt::format("{}: found {} with more than 8 bits per colour channel, expected 8; save the image with 8",
                        where, file.string()));
    }
    width_ = cairo_image_surface_get_width(surface.get());
    height_ = cairo_image_surface_get_height(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get())) / sizeof(std::uint32_t);
    const auto* rows = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface.get()));
    pixels_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row) {
        for (int column = 0; column < width_; ++column) {
            const std::uint32_t pixel = rows[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)];
            const bool opaque = format == CAIRO_FORMAT_RGB24 || pixel >> 24 == 0xff;
            const auto found = std::find(colours.begin(), colours.end(), pixel & 0xffffff);
            if (!opaque || found == colours.end()) {
                throw InputError(fmt::format(
                    "{}: {}: pixel {} of row {}: found {}, expected a colour of a mineral: {}; save the image without "
                    "smoothed edges, or give a mineral this colour",
                    where, file.string(), column + 1, row + 1,
                    opaque ? fmt::format("#{:06x}", pixel & 0xffffff) : std::string("a transparent pixel"),
                    expected_colours(colours, names)));
            }
            pixels_.push_back(static_cast<std::uint16_t>(found - colours.begin()));
        }
    }
}

std::uint16_t LabelImage::at(int column, int row) const {
    return pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)];
}

std::size_t LabelImage::label_of(const Scene& scene, const Body& body) const {
    const Domain& domain = scene.domain;
    const double across = (domain.x2 - domain.x1) / width_, down = (domain.y2 - domain.y1) / height_;  // m per pixel
    const auto column_at = [&](double x) {
        return static_cast<int>(std::clamp(std::floor((x - domain.x1) / across), 0.0, width_ - 1.0));
    };
    const auto row_at = [&](double y) {
        return static_cast<int>(std::clamp(std::floor((domain.y2 - y) / down), 0.0, height_ - 1.0));
    };
    const Box box = box_of(scene, body);
    std::vector<std::int64_t> votes(labels_, 0);
    for (int row = row_at(box.y2); row <= row_at(box.y1); ++row) {
        for (int column = column_at(box.x1); column <= column_at(box.x2); ++column) {
            const Vec2 centre{domain.x1 + (column + 0.5) * across, domain.y2 - (row + 0.5) * down};
            if (contains(scene, body, centre)) ++votes[at(column, row)];
        }
    }
    const auto most = std::max_element(votes.begin(), votes.end());
    if (*most > 0) return static_cast<std::size_t>(most - votes.begin());
    const Vec2 middle = mass_properties(scene, body).centroid;
    return at(column_at(middle.x), row_at(middle.y));
}

}  // namespace crackle
