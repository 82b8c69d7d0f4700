// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a figure of `crackle plot` as SVG: lines, axes and the letters of its panels.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "solver/base/vec2.hpp"

namespace crackle::testing {

/// Numbers of a path in order, as pairs of x and y.
inline std::vector<Vec2> corners_of(const std::string& path) {
    std::vector<double> numbers;
    for (const char* at = path.c_str(); *at != '\0';) {
        char* end = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at) {
            ++at;
            continue;
        }
        numbers.push_back(value);
        at = end;
    }
    std::vector<Vec2> corners;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) corners.push_back({numbers[k], numbers[k + 1]});
    return corners;
}

/// Open paths of an SVG in drawing order, without those of glyphs.
inline std::vector<std::vector<Vec2>> lines_of(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<std::vector<Vec2>> lines;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        if (std::string(node.node().attribute("style").value()).starts_with("fill:none"))
            lines.push_back(corners_of(node.node().attribute("d").value()));
    }
    return lines;
}

/// Axes, drawn downwards and then to the right: upper left, lower left and lower right corner of each.
inline std::vector<std::vector<Vec2>> frames_of(const std::string& svg) {
    std::vector<std::vector<Vec2>> frames;
    for (const std::vector<Vec2>& line : lines_of(svg)) {
        if (line.size() == 3 && line[0].x == line[1].x && line[1].y == line[2].y && line[0].y < line[1].y)
            frames.push_back(line);
    }
    return frames;
}

/// Positions of the panels' letters (a), (b), ..., each three glyphs of the bold font; the first and last glyphs are
/// the same for all.
inline std::vector<Vec2> letters_of(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::map<std::string, std::vector<Vec2>> by_brackets;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='g']")) {
        std::vector<pugi::xml_node> glyphs;
        for (const pugi::xml_node& child : node.node().children()) glyphs.push_back(child);
        if (glyphs.size() != 3 || std::string(glyphs[0].name()) != "use") continue;
        const std::string brackets =
            std::string(glyphs[0].attribute("xlink:href").value()) + glyphs[2].attribute("xlink:href").value();
        by_brackets[brackets].push_back({glyphs[0].attribute("x").as_double(), glyphs[0].attribute("y").as_double()});
    }
    std::vector<Vec2> most;
    for (const auto& [brackets, places] : by_brackets) {
        if (places.size() > most.size()) most = places;
    }
    return most;
}

}  // namespace crackle::testing
