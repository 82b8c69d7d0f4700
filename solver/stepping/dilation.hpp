// SPDX-License-Identifier: GPL-3.0-or-later
// Dilation of joints: a contact that slides along a joint rides up on its asperities, which opens the joint.
//
//     trial = f_t - k_s Δu_t                 |f_t| <= μ k_n (δ - δ0)
//     p  = (|trial| - μ k_n (δ - δ0))/(k_s + μ k_n tan ψ)         slip in this step, > 0 if the contact slides
//     δ0 <- δ0 - p tan ψ                     until the accumulated slip reaches Joint::dilation_slip
//
// so that after the force pass the contact has slid by p and is at the Coulomb limit for its new normal force
// k_n (δ - δ0). Slip is accumulated regardless of its direction: contacts ride up on asperities, but not down again.
// The normal spring gains the energy p tan ψ times the mean of its force before and after the step. This energy is
// taken from the friction loss, which stays >= 0 because ψ is at most the friction angle. ψ dilation angle, δ0 overlap
// at which the force is zero, m. A corner that moves to the face of another body, or two flat faces that begin to share
// a length, start without accumulated slip. Source: solver/MODEL.md 5.3. Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Opens joints in proportion to the slip in the coming force pass, at the current positions. Only for worlds with
/// Settings::dilates(). The computing time is proportional to the number of listed points. Only unbonded points across
/// joints are changed.
void dilate_joints(World& world);

}  // namespace crackle
