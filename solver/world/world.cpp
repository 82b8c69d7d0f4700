// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/world/world.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"

namespace crackle {

bool keeps(const World& world, Remembered remembered) {
    switch (remembered) {
        case Remembered::always:
        case Remembered::since_bonding:
            return true;
        case Remembered::by_guide_law:
            return world.settings.segment_law != SegmentLaw::rounded;
        case Remembered::when_consistent:
            return world.settings.integrator == Integrator::consistent;
        case Remembered::own_shares:
            return world.settings.own_shares();
        case Remembered::own_shear:
            return world.bonds.made && world.settings.own_shear();
        case Remembered::when_dilating:
            return world.settings.dilates();
        case Remembered::between_faces:
            return !world.bodies.flat_faces.empty();
        case Remembered::by_half_strength:
            break;
    }
    return world.bonds.made && facts_of(world.settings.bond_law).remembers_strong_forces;
}

void restart_account(World& world) {
    EnergyAccount& account = world.account;
    account.begun = false;
    account.dashpot_loss = account.friction_loss = account.fracture_loss = account.law_loss = 0.0;
    account.displacement_work = account.force_work = 0.0;
    account.largest_supply = 0.0;
    world.membrane.work = world.membrane.jumped = 0.0;
    world.membrane.wrapped = world.membrane.open = 0;
    std::ranges::fill(account.opening_defects, 0.0);
}

void set_threads(World& world, int threads) {
    if (threads < 1 || threads > 1024) throw InputError(fmt::format("threads: found {}, expected 1 to 1024", threads));
    world.workers.threads = threads;
    world.workers.blocks_done.assign(static_cast<std::size_t>(threads), 0);
    world.workers.plan.valid = false;
}

}  // namespace crackle
