// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/making/label_image.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
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
    bool inside = false;  // by the number of edges to the right
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

// Pixels that are taken into the memory at once, 600 MB; an empty image of more has a few kilobytes.
constexpr std::uint64_t most_pixels = 100'000'000;

/// Pixels of a PNG by its head; 0 of any other file.
std::uint64_t pixels_of(const std::filesystem::path& file) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    constexpr std::size_t width_at = 16, height_at = 20;  // four bytes each, highest first
    std::array<char, 24> head{};
    std::ifstream in(file, std::ios::binary);
    if (!in.read(head.data(), head.size()) || !std::string_view(head.data(), head.size()).starts_with(signature))
        return 0;
    const auto number_at = [&](std::size_t at) {
        std::uint64_t number = 0;
        for (std::size_t k = 0; k < 4; ++k) number = number << 8 | static_cast<std::uint8_t>(head[at + k]);
        return number;
    };
    return number_at(width_at) * number_at(height_at);
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
        throw InputError(fmt::format("{}: found {} with {} pixels, expected at most {}; save it smaller", where,
                                     file.string(), pixels, most_pixels));
    }
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_image_surface_create_from_png(file.string().c_str()), cairo_surface_destroy);
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS) {
        throw InputError(fmt::format("{}: found {}, which cannot be read as PNG ({}), expected a PNG image", where,
                                     file.string(), cairo_status_to_string(status)));
    }
    const cairo_format_t format = cairo_image_surface_get_format(surface.get());
    if (format != CAIRO_FORMAT_RGB24 && format != CAIRO_FORMAT_ARGB32) {
        throw InputError(
            fmt::format("{}: found {} with more than 8 bits a colour, expected 8; save it so", where, file.string()));
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
    const double across = (domain.x2 - domain.x1) / width_, down = (domain.y2 - domain.y1) / height_;  // m a pixel
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
