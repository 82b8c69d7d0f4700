// SPDX-License-Identifier: GPL-3.0-or-later
// Text form of a packing: one line with the XXH3 hash (64 bits) of the rest, then a JSON object.
#include "specimens/packing/packing_text.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

constexpr double smallest_length = 1e-30, largest_length = 1e30;  // m

std::string first_line(std::string_view rest) {
    return fmt::format("crackle packing {:016x}\n", XXH3_64bits(rest.data(), rest.size()));
}

bool is_length(const Json& value) { return value.is_number() && value >= smallest_length && value <= largest_length; }

/// Whether the object has all entries that packing_text() writes, with values that fit a box. A text with a correct
/// hash may still fail this check.
bool is_packing(const Json& json) {
    if (!json.is_object()) return false;
    for (const char* key : {"width", "height", "radius_scale"})
        if (!json.contains(key) || !is_length(json[key])) return false;
    for (const char* key : {"size_distance", "aspect_error"})
        if (!json.contains(key) || !json[key].is_number()) return false;
    if (!json.contains("attempts") || !json["attempts"].is_number_integer()) return false;
    if (!json.contains("box_met") || !json["box_met"].is_boolean()) return false;
    if (!json.contains("circles") || !json["circles"].is_array() || json["circles"].empty()) return false;
    const double width = json["width"], height = json["height"];
    return std::ranges::all_of(json["circles"], [&](const Json& circle) {
        if (!circle.is_array() || circle.size() != 3) return false;
        if (!circle[0].is_number() || !circle[1].is_number() || !is_length(circle[2])) return false;
        return circle[0] >= 0.0 && circle[0] <= width && circle[1] >= 0.0 && circle[1] <= height;
    });
}

}  // namespace

std::string packing_text(const Packing& packing) {
    const PackingReport& report = packing.report;
    Json circles = Json::array();
    for (const CircleElement& circle : packing.scene.circles)
        circles.push_back({circle.centre.x, circle.centre.y, circle.radius});
    const Json json{{"width", report.width},
                    {"height", report.height},
                    {"radius_scale", report.radius_scale},
                    {"size_distance", report.size_distance},
                    {"aspect_error", report.aspect_error},
                    {"attempts", report.attempts},
                    {"box_met", report.box_met},
                    {"circles", circles}};
    const std::string text = json.dump() + '\n';
    return first_line(text) + text;
}

std::optional<Packing> packing_of_text(const std::string& text, const Material& material, int threads) {
    const std::size_t line = text.find('\n');
    if (line == std::string::npos) return std::nullopt;
    const std::string_view rest = std::string_view(text).substr(line + 1);
    if (std::string_view(text).substr(0, line + 1) != first_line(rest)) return std::nullopt;
    const Json json = Json::parse(rest, nullptr, false);
    if (!is_packing(json)) return std::nullopt;
    std::vector<CircleElement> circles;
    for (const Json& circle : json.at("circles"))
        circles.push_back({.centre = {circle.at(0), circle.at(1)}, .radius = circle.at(2), .angle = 0.0});
    Packing packing;
    packing.scene = scene_of_circles(circles, json.at("width"), json.at("height"), material, threads);
    const double scale = json.at("radius_scale");
    packing.report = measure_packing(packing.scene, UniformRadii{1.0, 1.0});
    packing.report.radius_scale = scale;
    packing.report.size_distance = json.at("size_distance");
    packing.report.aspect_error = json.at("aspect_error");
    packing.report.attempts = json.at("attempts");
    packing.report.box_met = json.at("box_met");
    return packing;
}

}  // namespace crackle
