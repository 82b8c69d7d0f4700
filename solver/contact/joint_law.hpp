// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws across joints: the rock's with what a Joint has in its place. Stiffnesses a length are no part of them:
// in series with a face they depend on its length and its bodies, and are in its points' shares.
// Tested by tests/solver/contact/joint_law_test.cpp.
#pragma once

#include <cmath>

#include "solver/world/world.hpp"

namespace crackle {

/// @param rock of the same two materials
ContactLaw law_across(const ContactLaw& rock, const Joint& joint, const IntactOptions& intact);

/// Finds the laws across joints, behind the others in `settings.laws`, from those of the material pairs again.
void derive_joint_laws(Settings& settings);

/// Shares of the face's own stiffnesses that are left in series with a joint's.
struct SeriesShares {
    double normal = 1.0, shear = 1.0;
    double root_of_shear() const { return std::sqrt(shear / normal); }  ///< Points::shear_root
};
/// @param law of the point, its stiffnesses those of a face as long as its bodies are apart, Pa
/// @param distance m, over which the face's own stiffness acts
SeriesShares in_series_with(const Joint& joint, const ContactLaw& law, double distance);

/// Of a point by its law; all where that is not of a joint.
SeriesShares series_shares(const World& world, PointIndex k, double distance);

}  // namespace crackle
