// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of the contact law of a pair of materials. The formulas are in law.hpp, friction.hpp, dashpot.hpp and the
// bond laws.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include "solver/base/fields.hpp"

namespace crackle {

/// Constants of the contact law of a pair of materials. With StiffnessUnits::area, stiffnesses apply to a point whose
/// Points::stiffness_share is 1, and strengths are stresses. Numbers are stored in pairs, as the kernels load them.
struct ContactLaw {
    double normal_stiffness, shear_stiffness;  // N/m
    double normal_damping, shear_damping;  // N s/m; the damping-ratio terms times Points::root_mass are added to these
    double normal_damping_ratio_term;      // 2h sqrt(k_n), sqrt(N/m)
    double shear_damping_ratio_term;       // 2h sqrt(k_s)
    /// Coulomb friction coefficient μ = tan φ; the residual coefficient if bonds have a coefficient of their own. It is
    /// infinite if sliding is switched off.
    double friction;
    // Overlap at or below which a back-tension bond breaks, m: 0, or -infinity if the bond is unbreakable.
    double break_overlap;
    // Tensile strength and cohesion, for bond laws that use them; infinite if the bond is unbreakable.
    double tensile_strength, cohesion;  // N
    double bond_friction;               // friction coefficient μ of the bond's failure envelope
    double dilation = 0.0;              // tan ψ of a joint, with ψ its dilation angle

    CRACKLE_FIELDS(normal_stiffness, shear_stiffness, normal_damping, shear_damping, normal_damping_ratio_term,
                   shear_damping_ratio_term, friction, break_overlap, tensile_strength, cohesion, bond_friction,
                   dilation);
};

}  // namespace crackle
