// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical equilibrium of a disc assembly at a given pressure on its box, found as the minimum of the enthalpy
//
//   H = U(positions, box) + p·width·height,     -dH/dε_x = virial_x - p·width·height
//
// with FIRE, damped dynamics without a system matrix: some thousand force passes, growing with the packing's length,
// from any start, through any number of contacts opened and closed on the way (which stop Newton's method: near the end
// of compression a strain of a thousandth already changes the network).
#pragma once

#include <functional>

#include "specimens/disc_assembly.hpp"

namespace crackle {

enum class BoxFreedom {
    fixed,       ///< no pressure acts
    shape_kept,  ///< width and height by one factor
    free,        ///< width and height each by their own
};

struct BoxLoad {
    BoxFreedom freedom = BoxFreedom::fixed;
    double pressure = 0.0;  ///< force / length with stiffness 1, so a pure number
};

/// Called now and then with the imbalance reached.
using RelaxationCallback = std::function<void(double imbalance)>;

struct RelaxationResult {
    AssemblySums sums;
    double imbalance = 0.0;  ///< see imbalance()
    bool converged = false;
    bool loose = false;  ///< nothing carries load any more (only in a fixed box)
};

/// Largest unbalanced force on a disc / mean contact force, or the box's |virial/area - p|/p if that is larger.
double imbalance(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

/// Until the imbalance is at most `tolerance`. Not converged: `converged` is false and the assembly as near as it came.
/// @param max_passes force passes before giving up.
RelaxationResult relax(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_passes,
                       const RelaxationCallback& progress);

}  // namespace crackle
