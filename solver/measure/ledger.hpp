// SPDX-License-Identifier: GPL-3.0-or-later
// The account of energy at time n: what a world holds, what it has lost, what was put in.
// Tested by tests/solver/measure/health_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle {

/// Energies at x_n, and what has gone since the start. All in J; signs as in DEMseg's energy.dat.
struct Ledger {
    double potential = 0.0;      // enrg: -Σ m g·x
    double kinetic = 0.0;        // enva: with the mean of v at n ± ½
    double strain = 0.0;         // enka: bonded points count from their bonded state
    double dashpot_loss = 0.0;   // enca
    double friction_loss = 0.0;  // enfr
    double fracture_loss = 0.0;  // ours; 0 in unbonded scenes
    double law_loss = 0.0;  // ours; left in springs of the guide's law when contacts ended; < 0: the law made energy
    double displacement_work = 0.0;  // enxd: done on the system by displacement- and velocity-driven bodies
    double force_work = 0.0;         // enxf
    /// (potential + kinetic + strain + losses - works) - the same at the start.
    double closing_error = 0.0;
};

/// Energies at x_n; call between compute_forces() and advance().
Ledger measure_ledger(const World& world);

}  // namespace crackle
