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

std::string spoken_stress(double value, const std::string& unit, int digits) {
    struct Prefix {
        double factor;
        char letter;
    };
    // Smallest multiple of a prefix that rounds to 1 and is therefore printed with this prefix.
    const double rounded_up = 1.0 - 0.5 * std::pow(10.0, -digits);
    for (const Prefix& prefix : {Prefix{1e9, 'G'}, Prefix{1e6, 'M'}, Prefix{1e3, 'k'}}) {
        if (unit == "Pa" && std::isfinite(value) && std::abs(value) >= rounded_up * prefix.factor)
            return fmt::format("{:.{}g} {}Pa", value / prefix.factor, digits, prefix.letter);
    }
    return fmt::format("{:.{}g} {}", value, digits, unit);
}

}  // namespace crackle
