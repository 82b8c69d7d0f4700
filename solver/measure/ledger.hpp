// SPDX-License-Identifier: GPL-3.0-or-later
// Energy account at time n: energy stored in a world, lost from it and supplied to it.
// Tested by tests/solver/measure/health_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Energies at the positions x_n, and losses and work since the start, all in J. The names in comments are columns of
/// DEMseg's energy.dat; signs are as in these columns.
struct Ledger {
    double potential = 0.0;      // enrg: -Σ m g·x
    double kinetic = 0.0;        // enva, from the mean of v at n - ½ and n + ½
    double strain = 0.0;         // enka; for bonded points, the energy relative to the bonded state
    double dashpot_loss = 0.0;   // enca
    double friction_loss = 0.0;  // enfr
    double fracture_loss = 0.0;  // no DEMseg name; 0 in unbonded scenes
    // No DEMseg name; energy left in springs under the DEMseg guide's segment law when contacts ended; < 0 if the law
    // created energy.
    double law_loss = 0.0;
    double displacement_work = 0.0;  // enxd, work supplied by displacement- and velocity-driven bodies
    double force_work = 0.0;         // enxf, work supplied by applied forces
    /// (potential + kinetic + strain + losses - work) minus its value at the start.
    double closing_error = 0.0;
};

/// Computes the ledger. Call this between compute_forces() and advance().
Ledger measure_ledger(const World& world);

}  // namespace crackle
