// SPDX-License-Identifier: GPL-3.0-or-later
// Small regular specimens bonded between two flat segments. Both segments are held laterally and in rotation; the upper
// one moves.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"
#include "tests/bench/verify/scenes/bonded_bodies.hpp"

namespace crackle::verification {

struct LoadedSpecimen {
    World world;
    BodyIndex low = 0, high = 0;  // platens
    double height = 0.0;          // m, distance between the platens
};

/// @param speed velocity of the upper platen, m/s, positive upwards; initial velocities of particles vary linearly
/// between the platens
/// @param friction_angle degrees  @param damping_ratio -
/// @param time_step s; 0 for an automatic step
LoadedSpecimen between_platens(Kind kind, double speed, const IntactOptions& intact, double friction_angle = 27.0,
                               double damping_ratio = 0.2, double time_step = 0.0);

}  // namespace crackle::verification
