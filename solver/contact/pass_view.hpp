// SPDX-License-Identifier: GPL-3.0-or-later
// Inputs and outputs of a force pass, as plain pointers to the arrays of bodies and contact points. A view is made once
// per pass, from a world or from the caller's own arrays, and is all that kernels can access. Members have the same
// meaning as in Bodies, Points, Settings and StepControl.
// Tested by tests/solver/contact/force_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/contact/features.hpp"
#include "solver/laws/contact_law.hpp"
#include "solver/world/bodies.hpp"
#include "solver/world/energy_account.hpp"
#include "solver/world/points.hpp"

namespace crackle {

/// Inputs and outputs of a force pass. Valid until the neighbour list is rebuilt.
struct PassView {
    PassView() = default;
    /// With no features.
    explicit PassView(World& world);
    /// @param used features that the kernels must support
    PassView(World& world, const ContactFeatures& used) : PassView(world) { features = used; }

    ContactFeatures features;

    BodyView bodies;
    const BodyForce* force = nullptr;  // only prefetched, since forces are added to it after the kernel
    // The next three members are used only by the consistent integrator.
    const BodyInertia* inertia = nullptr;
    const BodyForce* last_force = nullptr;
    const PushBound* push_bound = nullptr;
    Vec2 gravity;

    PointIndex points = 0;         // number of points
    PointIndex circle_points = 0;  // number of circle_circle points, which have no PointParts
    PointIndex fours_end = 0;
    const BodyPair* pairs = nullptr;
    PointParts* parts = nullptr;  // elements that meet at the points from index circle_points on
    const double* root_mass = nullptr;
    PointState* state = nullptr;
    double* shear_force = nullptr;
    double* bond_overlap = nullptr;
    const float *stiffness_share = nullptr, *strength_share = nullptr, *shear_root = nullptr;  // null if all are 1
    double* lap = nullptr;
    float *normal_dashpot = nullptr, *shear_dashpot = nullptr;
    SpringWork* spring_work = nullptr;
    OpeningMemory* opening = nullptr;
    LastOverlap* last_overlap = nullptr;
    double* last_normal = nullptr;
    float *strong_normal = nullptr, *strong_shear = nullptr;

    const ContactLaw* laws = nullptr;
    std::size_t law_count = 0;
    std::size_t first_joint_law = 0, laws_of_joint = 1;  // see Settings::joint_of_law()
    const Joint* joints = nullptr;

    double drift = 0.0;      // s, length of the drift that led to the current positions
    double time_step = 0.0;  // s, length of the next drift
    double kick = 0.0;       // s, length of the next kick
    bool account_begun = false;
    bool one_by_one = false;  // Workers::one_by_one
    LossBlock* losses = nullptr;

    /// The joint to which a law across a joint belongs.
    const Joint& joint_of_law(std::size_t law) const { return joints[(law - first_joint_law) / laws_of_joint]; }
};

}  // namespace crackle
