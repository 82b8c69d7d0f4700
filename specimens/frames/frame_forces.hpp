// SPDX-License-Identifier: GPL-3.0-or-later
// Normal forces of the contacts in a frame, and the mean stress of each particle, computed from its contact forces:
//     σ = -1/A Σ ½(r⊗f + f⊗r)    N/m, compression positive; summed over the particle's contacts
// Here f [N] is the force on the particle, r [m] points from its centroid to the point of action, and A [m²] is its
// area (for a clump, the total of its circles). Forces are those of the springs without the back-tension of bonds:
// k_n(δ - δ0) along the normal, and the shear force. Dashpots are left out, so the unloaded specimen has zero stress.
// The tensor is symmetrised; its antisymmetric part is a torque. The sum of A σ over many particles, divided by the
// area that they occupy, is the stress of the specimen.
#pragma once

#include <vector>

#include "specimens/frames/placed_frame.hpp"

namespace crackle {

/// Mean stress of one particle, N/m.
struct ParticleStress {
    double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Forces and stresses in a frame.
struct FrameForces {
    /// Elastic normal forces, N, compression positive: first those of BondRecord::points (0 for broken bonds whose
    /// surfaces do not touch), then those of Frame::loose.
    std::vector<double> normal;
    std::vector<ParticleStress> stress;  ///< stress of each body; 0 for platens
};

/// Computes the forces of the contacts and the stresses of the bodies in a frame.
FrameForces find_forces(const PlacedFrame& placed);

/// Area of a body, m².
double area_of(const World& world, BodyIndex body);

}  // namespace crackle
