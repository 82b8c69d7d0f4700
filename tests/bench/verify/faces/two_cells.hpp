// SPDX-License-Identifier: GPL-3.0-or-later
// Two square cells with a face between them, which are placed so that the face has a given motion.
// Tested by tests/verification/claims_test.cpp.
#pragma once

#include "solver/world/world.hpp"

namespace crackle::verification {

/// Two square cells of side 1 m and E = 1 Pa, of which nothing but the face and three free sides each is loaded. Every
/// face and side is 0.5 m from the centre of its cell. The closed forms are those of this geometry.
struct TwoCells {
    static constexpr double length = 1.0;  // m

    World world;
    Array<BodyState> rest;
    FaceModuli moduli;

    /// Places both cells for a motion of the face, with its midpoint and mean rotation at rest, and computes forces.
    void place(double opening, double sliding, double turn);
    /// Force and moment of the face on body i, from the forces on that body.
    FaceForces forces() const;
    bool broken() const { return !world.faces.broken.empty(); }

    /// p̄ over the opening of an intact face, Pa/m.
    double pressure_rate() const;
    /// Dilation pressure of a cell per area of its face's opening: λ/(A + λ Σ L h_b/E_c), Pa/m².
    double pressure_per_area() const;
};

/// Young's modulus 1 Pa. @param poissons_ratio at 0 and a shear ratio of 1, cells have no pressure
TwoCells two_cells(const FaceLaw& law, double poissons_ratio, double shear_ratio);

}  // namespace crackle::verification
