// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/contact/joint_law.hpp"

#include <algorithm>
#include <limits>

namespace crackle {
namespace {

/// N, strength of a bond that holds while unloaded and breaks under the slightest tension.
constexpr double least_strength = std::numeric_limits<double>::min();

/// Factor by which another spring in series reduces a spring's stiffness: k/own, with k = own·other/(own + other).
double left_of(double own, double other) { return 1.0 / (1.0 + own / other); }

}  // namespace

ContactLaw law_across(const ContactLaw& rock, const Joint& joint, const IntactOptions& intact) {
    ContactLaw law = rock;
    if (!intact.no_sliding) {
        if (joint.friction_angle) law.bond_friction = law.friction = friction_coefficient(*joint.friction_angle);
        if (joint.residual_friction_angle)
            law.friction = std::min(friction_coefficient(*joint.residual_friction_angle), law.bond_friction);
    }
    law.dilation = friction_coefficient(joint.dilation_angle);
    if (!intact.no_breaking) {
        law.tensile_strength = joint.tensile_strength.value_or(joint.strength_factor * rock.tensile_strength);
        law.tensile_strength = std::max(law.tensile_strength, least_strength);
        law.cohesion = joint.cohesion.value_or(joint.strength_factor * rock.cohesion);
    }
    return law;
}

void derive_joint_laws(Settings& settings) {
    settings.laws.resize(settings.first_joint_law() + settings.joints.size() * settings.pair_count());
    for (std::size_t joint = 0; joint < settings.joints.size(); ++joint) {
        for (std::size_t pair = 0; pair < settings.pair_count(); ++pair) {
            settings.laws[settings.joint_law(pair, static_cast<std::int32_t>(joint))] =
                law_across(settings.laws[pair], settings.joints[joint], settings.intact);
        }
    }
}

SeriesShares in_series_with(const Joint& joint, const ContactLaw& law, double distance) {
    SeriesShares shares;
    if (joint.normal_stiffness) shares.normal = left_of(law.normal_stiffness, *joint.normal_stiffness * distance);
    if (joint.shear_stiffness) shares.shear = left_of(law.shear_stiffness, *joint.shear_stiffness * distance);
    return shares;
}

SeriesShares series_shares(const World& world, PointIndex k, double distance) {
    const Settings& settings = world.settings;
    const std::size_t law = world.points.state[k].law;
    if (law < settings.first_joint_law()) return {};
    return in_series_with(settings.joint_of_law(law), settings.laws[law], distance);
}

}  // namespace crackle
