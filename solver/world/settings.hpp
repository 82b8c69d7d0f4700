// SPDX-License-Identifier: GPL-3.0-or-later
// What the scene sets for a whole world: domain, laws, switches.
// Tested by tests/solver/world/world_test.cpp.
#pragma once

#include <vector>

#include "solver/scene/scene.hpp"

namespace crackle {

/// What a pair of materials does at a contact point; its formulas: contact/, measure/, linear/.
struct ContactLaw {
    double normal_stiffness, shear_stiffness;  // N/m
    double normal_damping, shear_damping;      // N s/m, plus the ratio terms times sqrt(m_eff)
    double normal_damping_ratio_term;          // 2h sqrt(k_n), sqrt(N/m)
    double shear_damping_ratio_term;           // 2h sqrt(k_s)
    double friction;                           // μ = tan φ; infinite when sliding is switched off
    double break_overlap;  // m; a bond is lost at or below: 0, or -infinity when breaking is switched off

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
    }
};

struct Settings {
    Domain domain;
    Vec2 gravity;
    double thick = 0.0;  // m
    SegmentLaw segment_law = SegmentLaw::rounded;
    Integrator integrator = Integrator::leapfrog;
    IntactOptions intact;
    std::vector<Material> materials;
    std::vector<ContactLaw> laws;  // material pairs, row-major: law = a * materials + b; then materials against walls

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("domain", s.domain);
        visit("gravity", s.gravity);
        visit("thick", s.thick);
        visit("segment_law", s.segment_law);
        visit("integrator", s.integrator);
        visit("intact", s.intact);
        visit("materials", s.materials);
        visit("laws", s.laws);
    }
};

}  // namespace crackle
