// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of cells that are bonded by faces and loaded between platens in steps.
// Tested by tests/solver/stepping/step_with_faces_test.cpp.
#pragma once

#include "solver/linear/critical_step.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "tests/bench/verify/scenes/cell_worlds.hpp"

namespace crackle::verification {

/// A bonded box of cells.
struct CellSpecimen {
    CellWorld cells;

    World& world() { return cells.world; }
    Faces& faces() { return cells.world.faces; }
    void step() { crackle::step(cells.world); }
    /// Takes a step. @return the energy account before it
    Ledger ledger() {
        compute_forces(cells.world);
        const Ledger ledger = measure_ledger(cells.world);
        advance(cells.world);
        return ledger;
    }
    double exact_step() { return critical_step(cells.world, ClosedPoints::touching).root; }
};

/// Strengths in proportion to those of rock, for a Young's modulus of 1 Pa.
inline FaceLaw brittle_cells() {
    FaceLaw law;
    law.tensile_strength = 1e-4;
    law.cohesion = 4e-4;
    law.friction = 1.2;
    law.moment_share = 0.6;
    law.residual_friction = 0.3;
    return law;
}

/// Bonds a box of cells whose strengths scatter with a coefficient of variation of 0.2.
inline CellSpecimen bond_cells(const CellBox& box, double ratio, const FaceLaw& law, double nu = 0.26,
                               PlatenFaces platens = PlatenFaces::glued) {
    CellSpecimen s{build_box(box)};
    FaceBonding bonding = elastic_rock(s.cells, box.gap, nu, ratio);
    bonding.materials[0].law = law;
    bonding.platens = platens;
    if (box.kind == MeshKind::delaunay) bonding.reference.clear();
    bonding.factors = StrengthFactors(StrengthDistribution::weibull, 0.2, 1);
    bond_by_faces(s.cells.world, bonding);
    return s;
}

/// Moves the upper platen along y and holds the lower one. @param velocity m/s
inline void drive_platens(CellSpecimen& s, double velocity) {
    const DofControl still{Drive::velocity, 0.0, 0.0}, moving{Drive::velocity, velocity, 0.0};
    set_control(s.world(), s.cells.platens[0], {still, still, still}, 0);
    set_control(s.world(), s.cells.platens[1], {still, moving, still}, 0);
}

}  // namespace crackle::verification
