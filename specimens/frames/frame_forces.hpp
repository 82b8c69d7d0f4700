// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of a moment: normal to its contacts, and the mean stress that they mean for each particle.
//   σ = -1/A Σ ½(r⊗f + f⊗r)    N/m, compression positive; over the particle's contacts
// f [N] the force on the particle, r [m] from its centroid to where it acts, A [m²] its area (a clump's: of its circles
// together). Springs only, less the back-tension of bonds: normal k_n(δ - δ0) and shear, no dashpots, so that the
// unloaded specimen has no stress. Symmetrised: what is left over turns the particle. Sums of A σ over many particles
// and the area they stand on give the specimen's stress.
#pragma once

#include <vector>

#include "specimens/frames/placed_frame.hpp"

namespace crackle {

/// Of one particle, N/m.
struct ParticleStress {
    double xx = 0.0, yy = 0.0, xy = 0.0;
};

struct FrameForces {
    /// N, elastic, compression positive: of TestSetup::bonds (0 of broken ones that do not touch), then of
    /// Frame::loose.
    std::vector<double> normal;
    std::vector<ParticleStress> stress;  ///< by body; of platens 0
};

FrameForces find_forces(const PlacedFrame& placed);

/// m²
double area_of(const World& world, BodyIndex body);

}  // namespace crackle
