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

}  // namespace crackle::parts
