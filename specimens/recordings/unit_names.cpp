// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/unit_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

/// Unit systems by name. In mm-g-s, 1 g mm/s2 is 1e-6 N, and 1 g mm2/s2 is 1e-9 J.
const std::vector<std::pair<std::string, UnitNames>>& sets() {
    static const std::vector<std::pair<std::string, UnitNames>> all{
        {"si", {"m", "m/s", "N", "J", "N/m", true}},
        {"cgs", {"cm", "cm/s", "dyn", "erg", "dyn/cm", false}},
        {"mm-g-s", {"mm", "mm/s", "µN", "nJ", "mN/m", false}}};
    return all;
}

}  // namespace

const std::vector<std::string>& unit_sets() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, units] : sets()) all.push_back(name);
        return all;
    }();
    return names;
}

UnitNames units_named(const std::string& where, const std::string& name) {
    const auto found = std::ranges::find(sets(), name, [](const auto& set) { return set.first; });
    if (found == sets().end())
        throw InputError(fmt::format("{}: found '{}', expected one of {}", where, name, fmt::join(unit_sets(), ", ")));
    return found->second;
}

}  // namespace crackle
