// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/case/parameter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "solver/scene/scene.hpp"

namespace crackle {

bool Parameter::accepts(double value) const {
    if (!is_a_size(value)) return false;
    if (lowest_allowed ? value < lowest : value <= lowest) return false;
    return highest_allowed ? value <= highest : value < highest;
}

std::string Parameter::expected() const {
    switch (kind) {
        case ValueKind::flag:
            return "true or false";
        case ValueKind::text:
            if (choices.empty()) return is_path ? "a file name in quotes" : "a text in quotes";
            return fmt::format("\"{}\"", fmt::join(choices, "\" or \""));
        case ValueKind::text_pair:
            return "two texts in square brackets";
        case ValueKind::integer:
        case ValueKind::real:
        case ValueKind::reals:
            break;
    }
    std::string text = kind == ValueKind::integer ? "a whole number"
                       : kind == ValueKind::reals ? "numbers in square brackets, each"
                                                  : "a number";
    if (std::isfinite(lowest)) text += fmt::format(" {} {:g}", lowest_allowed ? ">=" : ">", lowest);
    if (std::isfinite(highest))
        text += fmt::format("{} {} {:g}", std::isfinite(lowest) ? " and" : "", highest_allowed ? "<=" : "<", highest);
    if (!unit.empty()) text += " in " + unit;
    return text;
}

}  // namespace crackle
