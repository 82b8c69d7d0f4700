// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/stepping/motion.hpp"
#include "solver/base/chosen_set.hpp"

namespace crackle {

MoveRange move_range_for(const World& world) {
    return of_chosen_set([&]<InstructionSet S>() {
        return move_range_of<S>(world.settings.gravity != Vec2{}, world.bodies.some_turn());
    });
}

MoveListed move_listed_for(const World& world, bool turning, bool clear) {
    return of_chosen_set(
        [&]<InstructionSet S>() { return move_listed_of<S>(world.settings.gravity != Vec2{}, turning, clear); });
}

}  // namespace crackle
