// SPDX-License-Identifier: GPL-3.0-or-later
// Small bonded specimens that several claims use.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle::verification {

enum class Kind { discs, polygons };
const char* name_of(Kind kind);

/// Disordered, around the origin. Polygons: gap 1 mm, bonded with 1.08 mm, so that faces overlap by 0.08 mm.
World free_specimen(Kind kind, double friction_angle, double step_share = 0.5, IntactOptions intact = {});

/// Bodies fly apart from the centre at a few strains a second and at random on top, so that bonds break and lists age.
World bursting_specimen(Kind kind);

}  // namespace crackle::verification
