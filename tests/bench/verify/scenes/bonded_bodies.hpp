// SPDX-License-Identifier: GPL-3.0-or-later
// Small bonded specimens that several claims use.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle::verification {

enum class Kind { discs, polygons };
const char* name_of(Kind kind);

/// A disordered specimen around the origin. Polygons have gaps of 1 mm and are bonded with a thickness of 1.08 mm, so
/// that faces overlap by 0.08 mm.
World free_specimen(Kind kind, double friction_angle, double step_share = 0.5, IntactOptions intact = {});

/// A specimen whose bodies fly apart from the centre, at strain rates of a few per second plus random velocities. Bonds
/// break, and neighbour lists are rebuilt.
World bursting_specimen(Kind kind);

}  // namespace crackle::verification
