// SPDX-License-Identifier: GPL-3.0-or-later
// What has left or entered a world as energy since its account began (measure/ledger.hpp reads it).
// Tested by tests/verification/two_bodies_test.cpp.
#pragma once

#include <cstdint>
#include <vector>

namespace crackle {

/// What one block of points adds in a force pass; blocks are added up in their order, on any number of threads.
struct LossBlock {
    double dashpot = 0.0, friction = 0.0, law = 0.0;  // J
    std::uint32_t broken = 0;
    std::uint32_t gained = 0;  // points that carry load and are not counted in StepControl::step_bound yet

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("dashpot", s.dashpot);
        visit("friction", s.friction);
        visit("law", s.law);
        visit("broken", s.broken);
        visit("gained", s.gained);
    }
};

/// J throughout.
struct EnergyAccount {
    bool begun = false;           // the energy that it begins with is known
    double initial_energy = 0.0;  // potential, kinetic and strain energy at the beginning
    double dashpot_loss = 0.0, friction_loss = 0.0, fracture_loss = 0.0, law_loss = 0.0;
    double displacement_work = 0.0, force_work = 0.0;
    double largest_supply = 0.0;          // for the runaway check
    std::vector<double> opening_defects;  // per body: OpeningMemory::defect of points that have left the list; empty
                                          // without the consistent integrator
    std::vector<LossBlock> blocks;        // of the last force pass

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("begun", s.begun);
        visit("initial_energy", s.initial_energy);
        visit("dashpot_loss", s.dashpot_loss);
        visit("friction_loss", s.friction_loss);
        visit("fracture_loss", s.fracture_loss);
        visit("law_loss", s.law_loss);
        visit("displacement_work", s.displacement_work);
        visit("force_work", s.force_work);
        visit("largest_supply", s.largest_supply);
        visit("opening_defects", s.opening_defects);
        visit("blocks", s.blocks);
    }
};

}  // namespace crackle
