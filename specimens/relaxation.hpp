// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical equilibrium of a disc assembly at a given pressure on its box, found as the minimum of the enthalpy
//
//   H = U(positions, box) + p·width·height,     -dH/dε_x = virial_x - p·width·height
//
// by two methods that complement each other: FIRE (damped dynamics, Guénolé et al. 2020) finds its way from anywhere, but needs
// thousands of passes for the last digits, as soft shear waves cross the box slowly; Newton's method on the contact network
// (sparse Cholesky) ends in a few iterations once the network hardly changes. relax() alternates until the tolerance is met.
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
    double imbalance = 0.0;    ///< see imbalance()
    bool converged = false;
    bool loose = false;        ///< nothing carries load any more (only in a fixed box)
};

/// Largest unbalanced force on a disc / mean contact force, or the box's |virial/area - p|/p if that is larger.
double imbalance(const DiscAssembly& assembly, const BoxLoad& load, const AssemblySums& sums);

/// FIRE alone, until the imbalance is at most `tolerance`.
RelaxationResult relax_fire(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_passes,
                            const RelaxationCallback& progress);

/// Newton alone; gives up where it stops getting nearer. @param max_iterations factorisations of the stiffness matrix.
RelaxationResult relax_newton(DiscAssembly& assembly, const BoxLoad& load, double tolerance, int max_iterations,
                              const RelaxationCallback& progress);

/// Both in turns. Not converged: `converged` is false and the assembly as near as it came.
RelaxationResult relax(DiscAssembly& assembly, const BoxLoad& load, double tolerance, const RelaxationCallback& progress);

}  // namespace crackle
