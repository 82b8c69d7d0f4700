// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/pass.hpp"

#include <algorithm>

#include "solver/base/chosen_set.hpp"

namespace crackle {
namespace {

/// Pointer to the first element of an array; null if the array is empty because the world does not use it.
template <class T>
T* start_of(Array<T>& values) {
    return values.empty() ? nullptr : values.data();
}

}  // namespace

ContactFeatures features_of(const World& world) {
    ContactFeatures features{.bonds = world.bonds.made,
                             .consistent = !world.points.opening.empty(),
                             .own_shares = world.settings.own_shares(),
                             .own_shear = !world.points.shear_root.empty()};
    if (features.bonds) features.bond_law = law_of_points(world.settings.bond_law);
    features.friction = (features.bonds && facts_of(features.bond_law).sticks) || world.bonds.held > 0;
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

PassView::PassView(World& world)
    : bodies(world),
      force(world.bodies.force.data()),
      inertia(world.bodies.inertia.data()),
      last_force(world.bodies.last_force.data()),
      push_bound(world.bodies.push_bound.data()),
      gravity(world.settings.gravity),
      points(static_cast<PointIndex>(world.points.size())),
      circle_points(world.points.kind_begin[1]),
      fours_end(world.points.fours_end),
      pairs(world.points.contact.pairs.data()),
      parts(world.points.contact.parts.data()),
      root_mass(world.points.root_mass.data()),
      state(world.points.state.data()),
      shear_force(world.points.shear_force.data()),
      bond_overlap(world.points.bond_overlap.data()),
      stiffness_share(start_of(world.points.stiffness_share)),
      strength_share(start_of(world.points.strength_share)),
      shear_root(start_of(world.points.shear_root)),
      lap(start_of(world.points.lap)),
      normal_dashpot(world.points.normal_dashpot.data()),
      shear_dashpot(world.points.shear_dashpot.data()),
      spring_work(world.points.spring_work.data()),
      opening(world.points.opening.data()),
      last_overlap(world.points.last_overlap.data()),
      last_normal(world.points.last_normal.data()),
      strong_normal(world.points.strong_normal.data()),
      strong_shear(world.points.strong_shear.data()),
      laws(world.settings.laws.data()),
      law_count(world.settings.laws.size()),
      first_joint_law(world.settings.first_joint_law()),
      laws_of_joint(world.settings.pair_count()),
      joints(world.settings.joints.data()),
      drift(world.stepping.drift),
      time_step(world.stepping.time_step),
      kick(kick_before(world.stepping) + 0.5 * world.stepping.time_step),
      account_begun(world.account.begun),
      one_by_one(world.workers.one_by_one),
      losses(world.account.blocks.data()) {}

void geometry_pass(World& world) {
    const PassView view(world);
    const auto kernel_of = of_chosen_set([]<InstructionSet S>() { return &geometry_kernel_of<S>; });
    for (std::size_t kind = 0; kind < point_kinds; ++kind) {
        const GeometryKernel kernel = kernel_of(kind);
        const PointIndex blocks = blocks_of_kind(world, kind);
#pragma omp for schedule(static) nowait
        for (PointIndex b = 0; b < blocks; ++b) kernel(view, block_of(world, kind, b, nullptr));
    }
}

}  // namespace crackle
