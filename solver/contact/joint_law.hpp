// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws across joints: the laws of the rock with the joint's own values substituted. The joint's stiffnesses per
// length are not part of these laws. They act in series with the stiffness of a face, which depends on its length and
// its two bodies, so they are included in the points' stiffness factors.
// Tested by tests/solver/contact/joint_law_test.cpp.
#pragma once

#include <cmath>

#include "solver/world/world.hpp"

namespace crackle {

/// Law of the contacts across a joint. @param rock the law of the same two materials without a joint
ContactLaw law_across(const ContactLaw& rock, const Joint& joint, const IntactOptions& intact);

/// Derives the laws across joints from those of the material pairs and appends them to `settings.laws`.
void derive_joint_laws(Settings& settings);

/// Factors by which the springs of a joint, in series with the springs of a face, reduce the face's stiffnesses.
struct SeriesShares {
    double normal = 1.0, shear = 1.0;
    double root_of_shear() const { return std::sqrt(shear / normal); }  ///< Points::shear_root
};
/// Computes the factors for one face. @param law the point's law, with stiffnesses in Pa for a face as long as the
/// distance between its bodies
/// @param distance the length over which the face's own springs deform, m
SeriesShares in_series_with(const Joint& joint, const ContactLaw& law, double distance);

/// Factors for point k; both are 1 if the point does not lie across a joint.
SeriesShares series_shares(const World& world, PointIndex k, double distance);

}  // namespace crackle
