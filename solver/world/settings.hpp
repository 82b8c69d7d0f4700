// SPDX-License-Identifier: GPL-3.0-or-later
// What the scene sets for a whole world: domain, laws, switches.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

/// What a pair of materials does at a contact point; its formulas: contact/, measure/, linear/. In
/// StiffnessUnits::area stiffnesses are those of a point whose share is 1 (Points::stiffness_share), strengths
/// stresses. Numbers lie in pairs as the kernels load them.
struct ContactLaw {
    double normal_stiffness, shear_stiffness;  // N/m
    double normal_damping, shear_damping;      // N s/m, plus the ratio terms times Points::root_mass
    double normal_damping_ratio_term;          // 2h sqrt(k_n), sqrt(N/m)
    double shear_damping_ratio_term;           // 2h sqrt(k_s)
    /// μ = tan φ of Coulomb's limit, under BondLaw::coulomb the residual one; infinite when sliding is switched off.
    double friction;
    double break_overlap;  // m; a back-tension bond is lost at or below: 0, or -infinity where it cannot break
    // Of BondLaw::coulomb; infinite where a bond cannot break.
    double tensile_strength, cohesion;  // N
    double bond_friction;               // μ of the bond's envelope
    double dilation = 0.0;              // tan ψ of a joint

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("normal_stiffness", s.normal_stiffness);
        visit("shear_stiffness", s.shear_stiffness);
        visit("normal_damping", s.normal_damping);
        visit("shear_damping", s.shear_damping);
        visit("normal_damping_ratio_term", s.normal_damping_ratio_term);
        visit("shear_damping_ratio_term", s.shear_damping_ratio_term);
        visit("friction", s.friction);
        visit("break_overlap", s.break_overlap);
        visit("tensile_strength", s.tensile_strength);
        visit("cohesion", s.cohesion);
        visit("bond_friction", s.bond_friction);
        visit("dilation", s.dilation);
    }
};

/// Number of a pair of materials, in either order.
constexpr std::size_t pair_number(std::size_t a, std::size_t b) {
    return a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b;
}

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
    std::vector<std::int32_t> trace_joints;  ///< by trace: into joints; -1: as the rock
    /// By pair_number(): of material pairs, then of the same where a bond cannot break, then of materials against
    /// walls, then of material pairs across each joint.
    std::vector<ContactLaw> laws;

    /// Whether points have a share of stiffness and strength of their own.
    bool own_shares() const { return bond_law == BondLaw::coulomb || units == StiffnessUnits::area; }
    std::size_t pair_count() const { return materials.size() * (materials.size() + 1) / 2; }
    std::size_t first_joint_law() const { return 2 * pair_count() + materials.size(); }
    /// Of two materials across a joint, into laws.
    std::size_t joint_law(std::size_t pair, std::int32_t joint) const {
        return first_joint_law() + static_cast<std::size_t>(joint) * pair_count() + pair;
    }
    /// Of a law of a joint.
    const Joint& joint_of_law(std::size_t law) const { return joints[(law - first_joint_law()) / pair_count()]; }
    /// Whether points have a share of shear stiffness of their own.
    bool own_shear() const { return std::ranges::any_of(joints, &Joint::has_stiffness); }
    bool dilates() const {
        return std::ranges::any_of(joints, [](const Joint& joint) { return joint.dilation_angle > 0.0; });
    }

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("domain", s.domain);
        visit("gravity", s.gravity);
        visit("driven_contacts", s.driven_contacts);
        visit("thick", s.thick);
        visit("segment_law", s.segment_law);
        visit("integrator", s.integrator);
        visit("bond_law", s.bond_law);
        visit("units", s.units);
        visit("intact", s.intact);
        visit("materials", s.materials);
        visit("joints", s.joints);
        visit("trace_joints", s.trace_joints);
        visit("laws", s.laws);
    }
};

}  // namespace crackle
