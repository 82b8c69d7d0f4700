// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/pass.hpp"

#include <algorithm>

#include "solver/base/chosen_set.hpp"

namespace crackle {

ContactFeatures features_of(const World& world) {
    ContactFeatures features{false,
                             false,
                             world.bonds.made,
                             !world.points.opening.empty(),
                             world.settings.own_shares(),
                             world.bonds.made && world.settings.bond_law == BondLaw::coulomb,
                             !world.points.shear_root.empty()};
    features.friction = features.coulomb || world.bonds.held > 0;
    const std::size_t pairs = world.settings.pair_count();
    for (std::size_t number = 0; number < world.settings.laws.size(); ++number) {
        const ContactLaw& law = world.settings.laws[number];
        const bool of_held_bonds = number >= pairs && number < 2 * pairs;
        features.friction = features.friction || (law.friction > 0.0 && !of_held_bonds);
        features.damping = features.damping || law.normal_damping > 0.0 || law.shear_damping > 0.0 ||
                           law.normal_damping_ratio_term > 0.0 || law.shear_damping_ratio_term > 0.0;
    }
    return features;
}

PointIndex blocks_of_kind(const World& world, std::size_t kind) {
    return (world.points.kind_begin[kind + 1] - world.points.kind_begin[kind] + block_points - 1) / block_points;
}

std::size_t first_block_of(const World& world, std::size_t kind) {
    std::size_t before = 0;
    for (std::size_t other = 0; other < kind; ++other) before += blocks_of_kind(world, other);
    return before;
}

std::size_t block_count(const World& world) { return first_block_of(world, point_kinds); }

PointBlock block_of(const World& world, std::size_t kind, PointIndex block, PointForce* forces) {
    const PointIndex begin = world.points.kind_begin[kind] + block * block_points;
    return {begin, std::min(begin + block_points, world.points.kind_begin[kind + 1]),
            first_block_of(world, kind) + block, forces};
}

void geometry_pass(World& world) {
    const auto kernel_of = of_chosen_set([]<InstructionSet S>() { return &geometry_kernel_of<S>; });
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        const GeometryKernel kernel = kernel_of(kind);
        const PointIndex blocks = blocks_of_kind(world, kind);
#pragma omp for schedule(static) nowait
        for (PointIndex b = 0; b < blocks; ++b) kernel(world, block_of(world, kind, b, nullptr));
    }
}

}  // namespace crackle
