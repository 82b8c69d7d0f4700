// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/recordings/distinct_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace crackle {
namespace {

using Names = std::vector<std::string>;

/// Whether all names are distinct and none is empty.
bool distinct(Names names) {
    std::sort(names.begin(), names.end());
    return (names.empty() || !names.front().empty()) && std::adjacent_find(names.begin(), names.end()) == names.end();
}

std::string title_of(const Recording& recording) { return recording.results.summary.about.title.value_or(""); }

std::string with_seed(const std::string& name, const Recording& recording) {
    const auto& seed = recording.results.summary.numerics.seed;
    return name.empty() || !seed ? "" : fmt::format("{}, seed {}", name, *seed);
}

std::string end_of_path(const std::filesystem::path& path, std::ptrdiff_t parts) {
    const auto all = std::distance(path.begin(), path.end());
    std::filesystem::path end;
    for (auto part = std::next(path.begin(), std::max<std::ptrdiff_t>(0, all - parts)); part != path.end(); ++part)
        end /= *part;
    return end.string();
}

}  // namespace

std::vector<std::string> distinct_names(const std::vector<Recording>& recordings) {
    const auto named = [&](const auto& name_of) {
        Names names;
        for (const Recording& recording : recordings) names.push_back(name_of(recording));
        return names;
    };
    const Names folders = named([](const Recording& one) { return one.name; });
    for (const Names& names :
         {folders, named(title_of), named([](const Recording& one) { return with_seed(title_of(one), one); }),
          named([](const Recording& one) { return with_seed(one.name, one); })}) {
        if (distinct(names)) return names;
    }
    for (std::ptrdiff_t parts = 2; parts < 64; ++parts) {
        Names names = named([parts](const Recording& one) { return end_of_path(one.path, parts); });
        if (distinct(names)) return names;
    }
    Names numbered = folders;
    for (std::size_t k = 0; k < numbered.size(); ++k) numbered[k] += fmt::format(" ({})", k + 1);
    return numbered;
}

}  // namespace crackle
