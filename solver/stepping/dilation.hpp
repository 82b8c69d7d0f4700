// SPDX-License-Identifier: GPL-3.0-or-later
// Dilation of joints: a contact across one that slides rides up its asperities.
//
//     trial = f_t - k_s Δu_t                 |f_t| <= μ k_n (δ - δ0)
//     p  = (|trial| - μ k_n (δ - δ0))/(k_s + μ k_n tan ψ)         slip of this step, > 0 where it slides
//     δ0 <- δ0 - p tan ψ                     until the slips of all steps come to Joint::dilation_slip
//
// so that after the step's force pass it has slid by p and lies on Coulomb's limit of the normal force k_n (δ - δ0)
// that it has then. Slips are added up whatever their direction: asperities are ridden up, not down. What the normal
// spring gains, p tan ψ times the mean of its force before and after the step, comes out of what the slider takes,
// which stays >= 0 as ψ is at most the friction angle. ψ dilation angle, δ0 overlap without force, m.
// A contact that a corner comes to on the face of another body, or two flat faces of circles that come to lap, begins
// anew.
// Source: solver/MODEL.md 5.3. Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Lets joints open by what they slide in the coming force pass, at the places that bodies have. For worlds with
/// Settings::dilates(); linear in listed points, of which those across joints without a bond are looked at.
void dilate_joints(World& world);

}  // namespace crackle
