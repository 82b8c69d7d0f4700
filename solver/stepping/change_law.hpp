// SPDX-License-Identifier: GPL-3.0-or-later
// Changes the contact law of a pair of materials during a run.
// Tested by tests/solver/stepping/change_law_test.cpp.
#pragma once

#include <string>

#include "solver/world/world.hpp"

namespace crackle {

/// Sets a property of contacts between materials a and b (indices into Settings::materials), from the next force pass
/// on. The properties are normal_stiffness, shear_stiffness (N/m, or Pa), friction_angle (degrees; if the law has
/// a failure envelope, the angle of this envelope), and the law's constants. The stable step is computed again. The
/// energy account restarts, since the energy stored in springs changes abruptly. A back-tension bond keeps its overlap
/// δ0, so its strength k_n δ0 changes with the stiffness. Damping ratios do not change. If a = b, contacts of this
/// material with the domain's walls change as well. Contacts across joints change in all values that the joint does not
/// set itself; their factor for the joint's stiffness in series does not change.
/// @throws InputError for an unknown name, a value out of range, strengths with μT > C, or a constant that the
/// bond law does not have @throws UnstableRun if a given time step is too large for the new stiffness
void change_law(World& world, std::size_t a, std::size_t b, const std::string& name, double value);

}  // namespace crackle
