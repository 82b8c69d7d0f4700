// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical equilibrium of a disc assembly at a given pressure on its box, found as the minimum of the enthalpy
//
//   H = U(positions, box) + p·width·height,     -dH/dε_x = virial_x - p·width·height
//
// by motion without a system matrix: some thousand force passes, growing with the packing's length, from any start,
// through any number of contacts opened and closed on the way.
//
// Newton's method does not do that: near the end of compression a strain of a thousandth already changes the network,
// and with a line search and contacts opened and closed in every step it still took 100 to 400 factorisations from an
// imbalance of 1e-2 to 1e-3 (5,000 discs; a factorisation costs as much as 80 passes). Only from 1e-4 on does it
// converge at once.
//
// Two motions. FIRE keeps one power for all discs: it stops them all when those that move fastest go uphill. In large
// packings some spot is always giving way, and the stops delay everybody else; there, discs move against a viscous drag
// that holds back the longest waves just critically. Passes at a free pressure, from quench to equilibrium, radii 1 to
// 2, mean overlap 0.4 % of the mean radius, FIRE and drag: 20,000 discs 28,300 and 13,500, 50,000 discs 61,700 and
// 15,500.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <functional>

#include "specimens/packing/disc_assembly.hpp"

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

/// From so many discs on, discs move against a drag instead of by FIRE, except in a fixed box (quenching: starts far
/// from rest, where FIRE's stops help). Below, about a dozen stops cost little, and published packings keep their
/// bytes.
inline constexpr std::size_t drag_from = 8000;

/// Until the imbalance is at most `tolerance`. Not converged: `converged` is false and the assembly as near as it came.
/// @param max_passes force passes before giving up.
RelaxationResult relax(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_passes,
                       const RelaxationCallback& progress);

}  // namespace crackle
