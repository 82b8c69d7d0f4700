// SPDX-License-Identifier: GPL-3.0-or-later
// Two square cells with a face between them, which are placed so that the face has a given motion.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle::verification {

/// Two square cells of side 1 m and E = 1 Pa, joined by one face; only it and the three free sides of each cell carry
/// load. Every face and side is 0.5 m from the centre of its cell. The closed forms hold for this geometry.
struct TwoCells {
    static constexpr double length = 1.0;  // m

    World world;
    Array<BodyState> rest;
    FaceModuli moduli;

    /// Moves both cells symmetrically, so that the face has this opening, sliding and turn, and computes forces.
    void place(double opening, double sliding, double turn);
    /// Force and moment of the face on body i, from the forces on that body.
    FaceForces forces() const;
    bool broken() const { return !world.faces.broken.empty(); }

    /// Ratio of p̄ to the opening of an intact face, Pa/m.
    double pressure_rate() const;
    /// Dilation pressure of a cell per area by which its face has opened: λ/(A + λ Σ L h_b/E_c), Pa/m².
    double pressure_per_area() const;
};

/// Young's modulus 1 Pa. @param poissons_ratio at 0 and a shear ratio of 1, cells have no pressure
TwoCells two_cells(const FaceLaw& law, double poissons_ratio, double shear_ratio);

}  // namespace crackle::verification
