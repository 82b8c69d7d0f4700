// SPDX-License-Identifier: GPL-3.0-or-later
// Settings that apply to a whole world, taken from the scene: domain, contact laws and options.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/laws/contact_law.hpp"
#include "solver/scene/scene.hpp"

namespace crackle {

/// Index of a pair of materials, which does not depend on their order.
constexpr std::size_t pair_number(std::size_t a, std::size_t b) {
    return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b;
}

/// Settings that stay constant during a step: domain, materials, laws.
struct Settings {
    Domain domain;
    Vec2 gravity;
    DrivenContacts driven_contacts = DrivenContacts::unless_held;
    double thick = 0.0;  // m
    SegmentLaw segment_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    BondLaw bond_law = BondLaw::back_tension;
    StiffnessUnits units = StiffnessUnits::point;
    IntactOptions intact;
    std::vector<Material> materials;
    std::vector<Joint> joints;
    std::vector<std::int32_t> trace_joints;  ///< for each trace: index into `joints`; -1 if the trace has no joint
    /// Contact laws in this order: material pairs, by pair_number(); the same pairs with unbreakable bonds; each
    /// material against walls; material pairs across each joint.
    std::vector<ContactLaw> laws;

    /// Whether each point has its own stiffness and strength factors (Points::stiffness_share, strength_share).
    bool own_shares() const { return facts_of(bond_law).own_shares || units == StiffnessUnits::area; }
    /// Number of pairs of materials, including pairs of one material with itself.
    std::size_t pair_count() const { return materials.size() * (materials.size() + 1) / 2; }
    /// Index in `laws` of the first law across a joint.
    std::size_t first_joint_law() const { return 2 * pair_count() + materials.size(); }
    /// Index in `laws` of the law for a pair of materials across a joint.
    std::size_t joint_law(std::size_t pair, std::int32_t joint) const {
        return first_joint_law() + static_cast<std::size_t>(joint) * pair_count() + pair;
    }
    /// The joint to which a law across a joint belongs. @param law an index into `laws`
    const Joint& joint_of_law(std::size_t law) const { return joints[(law - first_joint_law()) / pair_count()]; }
    /// Whether each point has its own factor on the shear stiffness (Points::shear_root).
    bool own_shear() const { return std::ranges::any_of(joints, &Joint::has_stiffness); }
    /// Whether any joint dilates as it slips.
    bool dilates() const {
        return std::ranges::any_of(joints, [](const Joint& joint) { return joint.dilation_angle > 0.0; });
    }

    CRACKLE_FIELDS(domain, gravity, driven_contacts, thick, segment_law, integrator, bond_law, units, intact, materials,
                   joints, trace_joints, laws);
};

}  // namespace crackle
