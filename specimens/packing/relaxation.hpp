// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical equilibrium of a disc assembly at a given pressure on its box, found as the minimum of the enthalpy
//
//   H = U(positions, box) + p·width·height,     -dH/dε_x = virial_x - p·width·height
//
// The minimum is found by dynamics, without a system matrix, in a few thousand force computations. Their number grows
// with the size of the packing. The method works from any start, and any number of contacts may open and close.
//
// Newton's method does not work well: near the end of compression, a strain of 0.001 already changes the contact
// network. From an imbalance of 1e-2 to 1e-3 it took 100 to 400 factorisations, even with a line search and contacts
// updated in every step (5,000 discs; a factorisation costs as much as 80 force computations). It converges quickly
// only below an imbalance of 1e-4.
//
// There are two methods. FIRE uses the power summed over all discs, and stops them all when the fastest ones move
// uphill. In large packings, some region is always yielding, and these stops delay all other regions. Discs in large
// packings therefore move against a viscous drag that damps the longest waves critically. Numbers of force computations
// with FIRE and with drag: 28,300 and 13,500 for 20,000 discs, 61,700 and 15,500 for 50,000 discs. These numbers cover
// the path from quench to equilibrium, for radii from r to 2r and a mean overlap of 0.4 % of the mean radius.
// Tested by tests/specimens/packing/packing_test.cpp.
#pragma once

#include <functional>

#include "specimens/packing/disc_assembly.hpp"

namespace crackle {

/// How the box may change under its pressure.
enum class BoxFreedom {
    fixed,       ///< no pressure acts
    shape_kept,  ///< width and height change by a common factor
    free,        ///< width and height change independently
};

/// Pressure on the box, and how the box may respond.
struct BoxLoad {
    BoxFreedom freedom = BoxFreedom::fixed;
    double pressure = 0.0;  ///< dimensionless: force per length at stiffness 1
};

/// Called occasionally with the current imbalance.
using RelaxationCallback = std::function<void(double imbalance)>;

/// Result of a relaxation.
struct RelaxationResult {
    AssemblySums sums;
    double imbalance = 0.0;  ///< as returned by imbalance()
    bool converged = false;
    bool loose = false;  ///< whether no contact carries load any more (only in a fixed box)
};

/// Largest unbalanced force on a disc divided by the mean contact force, or the relative error |virial/area - p|/p of
/// the pressure if that is larger.
double imbalance(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

/// Number of discs from which the drag method replaces FIRE, except in a fixed box: quenching starts far from
/// equilibrium, where FIRE's stops help. For fewer discs the stops cost little, and FIRE keeps published packings
/// bit-identical.
inline constexpr std::size_t drag_from = 8000;

/// Relaxes until the imbalance is at most `tolerance`. On failure, `converged` is false and the assembly keeps the last
/// state.
/// @param max_passes  number of force computations before giving up
RelaxationResult relax(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_passes,
                       const RelaxationCallback& progress);

}  // namespace crackle
