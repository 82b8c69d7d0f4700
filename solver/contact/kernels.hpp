// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the forces of a block of contact points of one kind. The kernels are compiled for sets of scene features and
// for each instruction set (solver/base/instruction_set.hpp).
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstddef>

#include "solver/base/instruction_set.hpp"
#include "solver/contact/features.hpp"
#include "solver/contact/pass_view.hpp"

namespace crackle {

/// A range of 1 to block_points contact points of one kind.
struct PointBlock {
    PointIndex begin, end;
    std::size_t number;  // index into EnergyAccount::blocks
    PointForce* forces;  // output: forces of the points
};

/// Computes the forces of a block at the current positions, and updates shear springs, broken bonds and losses.
/// @param view the pass view, whose features must be those for which the kernel was requested
using ForceKernel = void (*)(const PassView& view, const PointBlock& block);
template <InstructionSet>
ForceKernel force_kernel_of(const ContactFeatures& features, std::size_t kind);

/// Computes only the geometry of the points, in the same way as the force kernels.
using GeometryKernel = void (*)(const PassView& view, const PointBlock& block);
template <InstructionSet>
GeometryKernel geometry_kernel_of(std::size_t kind);

}  // namespace crackle
