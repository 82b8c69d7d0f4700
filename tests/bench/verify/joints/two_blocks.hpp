// SPDX-License-Identifier: GPL-3.0-or-later
// Two blocks with a joint between them; the lower one is held, and the upper one, which is narrower, moves.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle::verification {

struct TwoBlocks {
    static constexpr double width = 0.04, height = 0.04, thick = 4e-5;  // m, size of the upper block; gap
    static constexpr double modulus = 50e9, ratio = 2.0;                // Pa, k_n over k_s
    static constexpr double distance = 0.5 * height;                    // m, distance that sets the stiffness of a face
    static constexpr double density = 2500.0;

    World world;
    BodyIndex lower = 0, upper = 0;

    /// Stiffness of the face without a joint, N/m; in_series() adds the joint's stiffness per length, Pa/m, in series.
    static constexpr double normal_stiffness() { return modulus * width / distance; }
    static constexpr double in_series(double face, double joint) { return 1.0 / (1.0 / face + 1.0 / (joint * width)); }
};

/// @param x, y controls of the upper block. Its rotation is held, unless both controls are free @param
/// damping_ratio -
TwoBlocks two_blocks(const Joint& joint, const DofControl& x, const DofControl& y, double damping_ratio,
                     Integrator integrator = Integrator::leapfrog);

}  // namespace crackle::verification
