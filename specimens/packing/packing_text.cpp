// SPDX-License-Identifier: GPL-3.0-or-later
// Layout: a line with the XXH3 (64 bits) of what follows, a JSON object.
#include "specimens/packing/packing_text.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace crackle {
namespace {

using Json = nlohmann::ordered_json;

std::string first_line(std::string_view rest) {
    return fmt::format("crackle packing {:016x}\n", XXH3_64bits(rest.data(), rest.size()));
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
    const Json json = Json::parse(rest, nullptr, false);  // whole by its hash: as it was written
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
