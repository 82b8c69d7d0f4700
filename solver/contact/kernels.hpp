// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of a block of contact points of one kind, by kernels compiled for what the scene has and for an instruction
// set (solver/base/instruction_set.hpp).
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include <cstddef>

#include "solver/base/instruction_set.hpp"
#include "solver/contact/features.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Neighbouring points of one kind: one at least, at most block_points.
struct PointBlock {
    PointIndex begin, end;
    std::size_t number;  // into EnergyAccount::blocks
    PointForce* forces;  // of the points, to be filled
};

/// Forces of a block at the present positions: shear springs, bond breaking and losses included.
/// @param features as the kernel was asked for
using ForceKernel = void (*)(World& world, const ContactFeatures& features, const PointBlock& block);
template <InstructionSet>
ForceKernel force_kernel_of(const ContactFeatures& features, std::size_t kind);

/// The geometry alone, as the force kernels take it.
using GeometryKernel = void (*)(World& world, const PointBlock& block);
template <InstructionSet>
GeometryKernel geometry_kernel_of(std::size_t kind);

}  // namespace crackle
