// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the cost of each feature per contact and step, and the remaining cost of features that a scene lacks.
//
// Discs and hexagons come to rest between walls and then get small random velocities, which move them by about a
// hundredth of an overlap. Rows use the same positions and neighbour list, except for changes due to their feature. Two
// scenes that differ by one feature run in turn on one thread, each from a copy of its initial state. The result is the
// median ratio of the two times over all pairs, with its confidence interval. All times are processor times. In bonded
// specimens the walls are moved away by one overlap.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "solver/base/names.hpp"
#include "tests/bench/throughput/median_interval.hpp"

namespace crackle::throughput {

struct FeatureStudy {
    std::int64_t count = 5000;      ///< number of discs, and of hexagons; actual numbers differ by a few
    int pairs = 15;                 ///< number of pairs of runs, at least fewest_for_interval
    double seconds = 0.08;          ///< approximate time of one run; a pair has two runs
    std::filesystem::path scratch;  ///< folder for the files of a virtual test
};

enum class FeatureRowKind : std::uint8_t {
    added,       ///< a scene with a feature, compared with the same scene without it
    dispatched,  ///< a scene without a feature: the kernels that the engine chooses, compared with kernels compiled
                 ///< without the feature
    forced,      ///< the same scene with kernels compiled with the feature; shows what the choice of kernels saves
};
constexpr auto list_names(FeatureRowKind) { return in_order("added", "dispatched", "forced"); }

struct FeatureRow {
    FeatureRowKind kind;
    std::string bodies;                        // discs, hexagons, voronoi
    std::string feature;                       // the feature that is added or absent
    std::string beside;                        // scene or kernel with which it is compared
    std::int64_t particles, contacts;          // contacts: points that carry load, or faces
    double contact_seconds, particle_seconds;  // median time of a step or a force pass, s
    MedianInterval difference;                 // extra time per contact and step, s; NaN if nothing is compared
    MedianInterval ratio;                      // ratio of the two times per contact and step
};

/// Measures all rows; calls `add` with each completed row.
void measure_feature_costs(const FeatureStudy& study, const std::function<void(const FeatureRow&)>& add);

}  // namespace crackle::throughput
