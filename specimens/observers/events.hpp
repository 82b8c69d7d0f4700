// SPDX-License-Identifier: GPL-3.0-or-later
// events.csv: one row a broken bond (the acoustic-emission-like record), in the order in which bonds break.
//   time [s], step, axial_strain [-, sense of the test], x, y [m] of the contact point, body_i, body_j [ids of the
//   input], orientation [rad, of the contact normal, in (-π/2, π/2]], energy [J, set free], strength [N], normal_force
//   [N, elastic, compression positive] and shear_force [N] of the last step in which the point carried at least half
//   its strength, slid [0/1: had been at the Coulomb limit], mode [shear|tension], last_of_interface [0/1].
#pragma once

#include <string>

#include "solver/world/world.hpp"

namespace crackle {

std::string events_header();  ///< with line end
std::string event_line(const BreakEvent& event, double axial_strain);

}  // namespace crackle
