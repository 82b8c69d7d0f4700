// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/search_space.hpp"

#include <algorithm>
#include <cmath>

#include "specimens/calibration/linear_figures.hpp"
#include "specimens/calibration/starting_guess.hpp"

namespace crackle {
namespace {

using Eigen::Index;

bool is_linear(const Target& target) {
    return target.over.empty() && !target.of_law() && linear_figure_of(target.figure).has_value();
}

/// The key that scales all strengths; -1 if there is no such key.
Index level_key_of(const SearchSpace& space) {
    Index tensile = -1;
    bool cohesion = false;
    for (const Index k : space.other_keys) {
        const FreeKey& free = space.key(k);
        if (free.key == "material.tensile_strength" && free.of.empty() && free.logarithmic()) tensile = k;
        if (free.key == "material.cohesion" && free.of == "material.tensile_strength") cohesion = true;
    }
    if (tensile < 0 || !cohesion) return -1;
    for (std::size_t test = 0; test < space.rock.tests.size(); ++test) {
        const ResolvedCase at = space.rock.case_of(test, space.values_at(space.start));
        if (!at.bond.facts().strengths_are_given || !at.area_units() || !at.minerals.list.empty()) return -1;
    }
    return tensile;
}

}  // namespace

SearchSpace::SearchSpace(const Rock& of)
    : rock(of), keys(static_cast<Index>(of.free.size())), targets(static_cast<Index>(of.targets.size())) {
    low.resize(keys);
    high.resize(keys);
    start.resize(keys);
    logs.resize(targets);
    widths.resize(targets);
    bool elastic = false, moduli = false;
    const std::vector<double> starts = starting_values(rock);
    for (Index k = 0; k < keys; ++k) {
        low[k] = key(k).to_variable(key(k).from);
        high[k] = key(k).to_variable(key(k).to);
        start[k] = key(k).to_variable(starts[static_cast<std::size_t>(k)]);
        elastic = elastic || is_elastic_key(key(k).key);
    }
    for (Index t = 0; t < targets; ++t) {
        logs[t] = std::log(target(t).value);
        widths[t] = std::log1p(target(t).tolerance);
        moduli = moduli || is_linear(target(t));
    }
    for (Index t = 0; t < targets; ++t) (elastic && is_linear(target(t)) ? linear_targets : other_targets).push_back(t);
    for (Index k = 0; k < keys; ++k) {
        if (moduli && is_elastic_key(key(k).key))
            linear_keys.push_back(k);
        else if (!other_targets.empty())
            other_keys.push_back(k);
    }
    level_key = level_key_of(*this);
}

std::vector<double> SearchSpace::values_at(const Eigen::VectorXd& x) const {
    std::vector<double> values;
    for (Index k = 0; k < keys; ++k) values.push_back(key(k).to_value(x[k]));
    return values;
}

bool SearchSpace::goes_with_level(Index t) const {
    const std::string& figure = target(t).figure;
    const bool strength = figure.starts_with("peak_stress") || figure.starts_with("largest_stress");
    return level_key >= 0 && strength && target(t).over.empty() &&
           !rock.case_of(target(t).test, values_at(start)).confined();
}

}  // namespace crackle
