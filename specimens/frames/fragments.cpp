// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/frames/fragments.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <limits>
#include <numeric>

#include "specimens/frames/frame_forces.hpp"

namespace crackle {

std::vector<std::int32_t> find_fragments(const World& world, const TestSetup& setup, const Frame& frame) {
    const std::size_t bodies = frame.bodies.size();
    std::vector<BodyIndex> rank(bodies), parent(bodies);
    boost::disjoint_sets sets(rank.data(), parent.data());
    for (BodyIndex b = 0; b < bodies; ++b) sets.make_set(b);
    for (std::size_t k = 0; k < setup.bonds.points.size(); ++k) {
        const auto [i, j] = setup.bonds.points.pairs[k];
        if (holds(frame.states[k]) && !setup.apparatus.is_platen(i) && !setup.apparatus.is_platen(j))
            sets.union_set(i, j);
    }
    struct Fragment {
        double area = 0.0;  // m²
        int lowest_id = std::numeric_limits<int>::max();
        BodyIndex set = no_body;
    };
    std::vector<Fragment> fragments;
    // For the root body of each disjoint set, index of its fragment in order of discovery; -1 for other bodies.
    std::vector<std::int32_t> number(bodies, -1);
    for (BodyIndex b = 0; b < bodies; ++b) {
        if (setup.apparatus.is_platen(b)) continue;
        const BodyIndex set = sets.find_set(b);
        if (number[set] < 0) {
            number[set] = static_cast<std::int32_t>(fragments.size());
            fragments.push_back({});
        }
        Fragment& fragment = fragments[static_cast<std::size_t>(number[set])];
        fragment.area += area_of(world, b);
        fragment.lowest_id = std::min(fragment.lowest_id, world.bodies.info(b).id);
        fragment.set = set;
    }
    std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) {
        return a.area != b.area ? a.area > b.area : a.lowest_id < b.lowest_id;
    });
    for (std::size_t f = 0; f < fragments.size(); ++f) rank[fragments[f].set] = static_cast<BodyIndex>(f);
    for (BodyIndex b = 0; b < bodies; ++b) {
        if (!setup.apparatus.is_platen(b)) number[b] = static_cast<std::int32_t>(rank[sets.find_set(b)]);
    }
    return number;
}

}  // namespace crackle
