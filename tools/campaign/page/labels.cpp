// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/campaign/page/labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "specimens/case/parameters.hpp"
#include "tools/plot/axes.hpp"

namespace crackle::tools {
namespace {

/// Keys that have a customary name, most of them with a symbol.
constexpr std::array<std::pair<const char*, const char*>, 11> symbols{{
    {"confinement.pressure", "confining pressure σ₃"},
    {"loading.normal_stress", "normal stress σₙ"},
    {"loading.axial_strain_rate", "strain rate"},
    {"material.friction_angle", "friction angle φ"},
    {"material.cohesion", "cohesion of bonds c"},
    {"material.tensile_strength", "tensile strength of bonds"},
    {"material.contact_modulus", "contact modulus"},
    {"material.stiffness_ratio", "stiffness ratio kₙ/kₛ"},
    {"material.density", "density ρ"},
    {"shape.diameter", "diameter D"},
    {"shape.notch", "notch a"},
}};

/// Name of a key, for example "bond strength cv" for bond.strength_cv, or "mineral 1 friction angle" for
/// mineral[1].friction_angle.
std::string spoken_key(const std::string& key) {
    for (const auto& [known, spoken] : symbols)
        if (key == known) return spoken;
    std::string text = key;
    std::ranges::replace_if(
        text, [](char c) { return c == '_' || c == '.' || c == '['; }, ' ');
    std::erase(text, ']');
    return text;
}

/// The unit that applies to the plan, selected from a text such as "N/m or Pa".
std::string one_unit(const std::string& unit, bool area_units) {
    if (unit == "deg") return "°";
    const std::string between = " or ";
    const std::size_t at = unit.find(between);
    if (at == std::string::npos) return unit;
    return area_units ? unit.substr(at + between.size()) : unit.substr(0, at);
}

std::string spoken_number(double value, const std::string& unit) {
    if (unit == "°") return fmt::format("{:g}°", value);
    if (unit.empty()) return fmt::format("{:g}", value);
    if (unit != "Pa" && unit != "N/m" && unit != "m") return fmt::format("{:g} {}", value, unit);
    const plot::Unit scaled = plot::unit_for(value, unit);
    return fmt::format("{:.4g} {}", value / scaled.factor, scaled.name);
}

}  // namespace

AxisLabel axis_label(const std::string& key, bool area_units) {
    const std::size_t dot = key.find('.');
    const Parameter* p = find_parameter(key.substr(0, std::min(dot, key.find('['))),
                                        dot == std::string::npos ? key : key.substr(dot + 1));
    return {spoken_key(key), p == nullptr ? "" : one_unit(p->unit, area_units)};
}

std::string spoken_setting(const std::string& key, const LedgerCell& value, bool area_units) {
    const AxisLabel label = axis_label(key, area_units);
    if (const auto* number = std::get_if<double>(&value)) return label.name + ' ' + spoken_number(*number, label.unit);
    if (const auto* text = std::get_if<std::string>(&value)) return label.name + ' ' + *text;
    return "";
}

std::string spoken_point(const PointSummary& point, const std::string& without) {
    std::string text;
    for (const auto& [key, value] : point.axes) {
        const std::string setting = key == without ? "" : spoken_setting(key, value, point.area_units);
        if (!setting.empty()) text += (text.empty() ? "" : ", ") + setting;
    }
    return text;
}

}  // namespace crackle::tools
