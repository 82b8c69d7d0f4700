// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/parts/rock.hpp"

namespace crackle::parts {

void MaterialValues::apply_to(crackle::Material& material) const {
    if (density) material.density = *density;
    if (normal_stiffness) material.normal_stiffness = *normal_stiffness;
    if (shear_stiffness) material.shear_stiffness = *shear_stiffness;
    if (friction_angle) material.friction_angle = *friction_angle;
    material.tensile_strength = tensile_strength.value_or(0.0);
    material.cohesion = cohesion.value_or(0.0);
    material.residual_friction_angle = residual_friction_angle.value_or(material.friction_angle);
    if (damping_ratio) material.damping_ratio = *damping_ratio;
    if (normal_damping || shear_damping) material.damping_ratio.reset();
    if (normal_damping) material.normal_damping = *normal_damping;
    if (shear_damping) material.shear_damping = *shear_damping;
}

FaceModuli MaterialValues::face_moduli() const {
    if (!stiffness_ratio) return face_moduli_without_pressure(*youngs_modulus, *poissons_ratio, mesh_correction);
    return crackle::face_moduli(*youngs_modulus, *poissons_ratio, 1.0 / *stiffness_ratio, mesh_correction);
}

FaceLaw MaterialValues::face_law() const {
    FaceLaw law;
    law.tensile_strength = *tensile_strength;
    law.cohesion = *cohesion;
    law.friction = friction_coefficient(*friction_angle);
    law.residual_friction = friction_coefficient(residual_friction_angle.value_or(*friction_angle));
    if (friction_knee) {
        law.knee = *friction_knee;
        law.friction_beyond = friction_coefficient(*friction_angle_beyond);
        if (!residual_friction_angle) law.residual_friction = law.friction_beyond;
    }
    law.moment_share = moment_share.value_or(0.0);
    law.residual_cohesion = residual_cohesion.value_or(0.0);
    law.softening_slip = softening_slip.value_or(0.0);
    law.residual_tensile_strength = residual_tensile_strength.value_or(0.0);
    law.softening_opening = softening_opening.value_or(0.0);
    law.damping_ratio = damping_ratio.value_or(0.0);
    return law;
}

}  // namespace crackle::parts
