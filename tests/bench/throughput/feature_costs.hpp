// SPDX-License-Identifier: GPL-3.0-or-later
// What each feature costs a contact and step, and what is left of those that a scene lacks.
//
// Discs and hexagons are settled between walls, then stirred by about a hundredth of an overlap; rows share places and
// neighbour list, except for what their feature changes. Two scenes that differ by one feature take turns on one
// thread, each from a copy of its start. The result is the ratio of the two times of a pair, its median over the pairs,
// and the interval that holds that median. All times are the processor's. Walls are moved away by an overlap where the
// specimen is bonded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "solver/base/names.hpp"
#include "tests/bench/throughput/median_interval.hpp"

namespace crackle::throughput {

struct FeatureStudy {
    std::int64_t count = 5000;      ///< discs, and hexagons; met within a few
    int pairs = 15;                 ///< at least fewest_for_interval
    double seconds = 0.08;          ///< of one run, about; a pair is two
    std::filesystem::path scratch;  ///< folder for the files of a virtual test
};

enum class FeatureRowKind : std::uint8_t {
    added,       ///< a scene with a feature beside the one without it
    dispatched,  ///< a scene without a feature: what the engine picks beside the kernels compiled without it
    forced,      ///< the same scene under kernels compiled with the feature: what dispatch saves
};
constexpr auto list_names(FeatureRowKind) { return in_order("added", "dispatched", "forced"); }

struct FeatureRow {
    FeatureRowKind kind;
    std::string bodies;                        // discs, hexagons, voronoi
    std::string feature;                       // added, or absent
    std::string beside;                        // what it is compared with
    std::int64_t particles, contacts;          // contacts: points that carry load
    double contact_seconds, particle_seconds;  // of a step (`forced` and some `dispatched`: of its force pass), median
    MedianInterval difference;  // s a contact and step beyond the other; not a number where none is compared
    MedianInterval ratio;       // of the two times a contact and step
};

/// All rows, each handed over as it is done.
void measure_feature_costs(const FeatureStudy& study, const std::function<void(const FeatureRow&)>& add);

}  // namespace crackle::throughput
