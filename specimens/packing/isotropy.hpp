// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the stress isotropic in a box of given shape. A few hundred random circles compressed in a box of fixed shape
// carry, by chance, about 5 % more stress in one direction than in the other. Straining the box would remove the
// difference but change its shape by almost one percent, since such packings are soft in shear. Instead, circles of
// nearly equal size swap places. Swapping radii that differ by about a mean overlap changes a few forces but keeps the
// size distribution, the box and the contact network.
//
// The linear response shows which swaps help. Let z be the positions and the box scale, H the Hessian of the enthalpy
// and g its gradient:
//
//   dT/dr_i = ∂T/∂r_i - (H⁻¹ ∂T/∂z)·∂g/∂r_i,      T = virial_x - virial_y
//
// This requires one sparse factorisation (LDLᵀ) for all circles.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <vector>

#include "specimens/packing/relaxation.hpp"

namespace crackle {

/// Relative difference of the stresses, (σx - σy)/(σx + σy).
double stress_anisotropy(const AssemblySums& sums);

/// For each disc, whether it is floating, that is, carries no load. Discs with fewer than three carrying contacts are
/// removed repeatedly; a contact carries load if its overlap exceeds a ten-thousandth of the mean overlap.
std::vector<bool> find_floating(const DiscAssembly& assembly, const AssemblySums& sums);

/// dT/dr_i [m], where T = virial_x - virial_y, for each disc of an assembly in equilibrium under a pressure at constant
/// box shape; 0 for floating discs. Empty if the stiffness matrix cannot be factorised.
std::vector<double> anisotropy_gradient(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

/// Swaps radii so that, to first order, T = virial_x - virial_y becomes zero. The assembly must be relaxed afterwards.
/// @return number of swaps; 0 if the sizes allow no swap
int exchange_radii(DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

}  // namespace crackle
