// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic stress in a box of given shape. A few hundred random circles, compressed in a box that keeps its shape,
// carry about 5 % more stress in one direction than in the other, by chance. Straining the box would cure that at the
// price of its shape (by near a hundredth: such packings are soft in shear). Here circles of nearly equal size trade
// places instead: an exchange of radii that differ by about a mean overlap changes a few forces and leaves the sizes,
// the box and the network as they were.
//
// Which exchanges help is read off the linear response: with z the positions and the box scale, H the Hessian of the
// enthalpy and g its gradient,
//
//   dT/dr_i = ∂T/∂r_i - (H⁻¹ ∂T/∂z)·∂g/∂r_i,      T = virial_x - virial_y
//
// one sparse factorisation (LDLᵀ) for all circles.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <vector>

#include "specimens/packing/relaxation.hpp"

namespace crackle {

/// (σx - σy)/(σx + σy) of an assembly.
double stress_anisotropy(const AssemblySums& sums);

/// Discs that carry no load: fewer than three contacts of more than a ten-thousandth of the mean overlap, once those
/// without load are left out.
std::vector<bool> find_floating(const DiscAssembly& assembly, const AssemblySums& sums);

/// dT/dr_i [m] of an assembly in equilibrium under a pressure that keeps the box's shape; 0 for floating discs. Empty
/// if the stiffness matrix cannot be factorised.
std::vector<double> anisotropy_gradient(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

/// Exchanges radii so that T changes by -(virial_x - virial_y), to first order. The assembly has to be relaxed
/// afterwards.
/// @return exchanges made; 0 where the sizes allow none.
int exchange_radii(DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

}  // namespace crackle
