// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/statistics/spoken.hpp"

#include <fmt/format.h>

#include <cmath>

namespace crackle {

std::string counted(std::int64_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string counted(std::size_t count, const char* noun) { return counted(static_cast<std::int64_t>(count), noun); }

std::string spoken_below(double value, double bound) {
    for (int digits = 3; digits < 17; ++digits) {
        std::string text = fmt::format("{:.{}g}", value, digits);
        if (std::stod(text) < bound) return text;
    }
    return fmt::format("{}", value);
}

SpokenUnit spoken_unit(double value, const std::string& unit, int digits) {
    // Smallest multiple of a prefix that rounds to 1 and is therefore printed with this prefix.
    const double rounded_up = 1.0 - 0.5 * std::pow(10.0, -digits);
    for (const SpokenUnit& prefixed : {SpokenUnit{1e9, "GPa"}, SpokenUnit{1e6, "MPa"}, SpokenUnit{1e3, "kPa"}}) {
        if (unit == "Pa" && std::isfinite(value) && std::abs(value) >= rounded_up * prefixed.factor) return prefixed;
    }
    return {1.0, unit};
}

std::string spoken_stress(double value, const std::string& unit, int digits) {
    const SpokenUnit spoken = spoken_unit(value, unit, digits);
    return fmt::format("{:.{}g} {}", value / spoken.factor, digits, spoken.name);
}

}  // namespace crackle
