// SPDX-License-Identifier: GPL-3.0-or-later
// Energy supplied to and dissipated by a world since its energy account was started (read by measure/ledger.hpp).
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/base/fields.hpp"

namespace crackle {

/// Losses of one block of points in a force pass. Blocks are summed in index order, so the sum does not depend on the
/// number of threads.
struct LossBlock {
    double dashpot = 0.0, friction = 0.0, law = 0.0;  // J
    std::uint32_t broken = 0;
    // Number of points that have begun to carry load but are not yet accounted for in StepControl::step_bound.
    std::uint32_t gained = 0;

    CRACKLE_FIELDS(dashpot, friction, law, broken, gained);
};

/// Energies of a world since its account was started, all in J.
struct EnergyAccount {
    bool begun = false;           // whether the initial energy is known
    double initial_energy = 0.0;  // J; potential, kinetic and strain energy at the start of the account
    double dashpot_loss = 0.0, friction_loss = 0.0, fracture_loss = 0.0, law_loss = 0.0;
    double displacement_work = 0.0, force_work = 0.0;
    double largest_supply = 0.0;  // J, largest energy supplied so far; used by the check for runaway energy
    // For each body: sum of OpeningMemory::defect over the points that have left the neighbour list, J. Empty without
    // the consistent integrator.
    std::vector<double> opening_defects;
    std::vector<LossBlock> blocks;  // losses in the last force pass, for each block of points

    CRACKLE_FIELDS(begun, initial_energy, dashpot_loss, friction_loss, fracture_loss, law_loss, displacement_work,
                   force_work, largest_supply, opening_defects, blocks);
};

}  // namespace crackle
