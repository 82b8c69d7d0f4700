// SPDX-License-Identifier: GPL-3.0-or-later
// The stress-strain curve: the values measured in a step, and their format in curve.csv.
//
// Stress is the force of the specimen on a platen (dashpots included), divided by the initial width. Axial strain is
// the displacement of the upper platen divided by the initial height. Both are positive in the direction of loading:
// compressive in compression, tensile in tension. Lateral strain is the change in distance between the mean x of the
// left and right side particles, divided by its initial value; positive when the specimen widens. The model is strictly
// 2D, so stress is in N/m.
// Tested by tests/recount/recount_test.py.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/fields.hpp"
#include "solver/base/quantity.hpp"
#include "solver/world/world.hpp"

namespace crackle {

struct PlacedApparatus;
struct TestSetup;

/// One row of curve.csv.
struct CurveRow {
    double axial_strain = 0.0;
    double axial_stress = 0.0;   // N/m, mean of the two platens
    double stress_top = 0.0;     // N/m
    double stress_bottom = 0.0;  // N/m
    double lateral_strain = 0.0;
    std::int64_t bonds_broken = 0;
    double kinetic_energy = 0.0;  // J
    double strain_energy = 0.0;   // J
    double time = 0.0;            // s
    std::int64_t step = 0;
    std::int64_t interfaces_lost = 0;
    std::int64_t points_sliding = 0;
    double dashpot_loss = 0.0;   // J
    double friction_loss = 0.0;  // J
    double fracture_loss = 0.0;  // J
    double platen_work = 0.0;    // J
    double energy_error = 0.0;   // J
    double gauge_strain = 0.0;
    std::int64_t bonds_slid = 0;
    double confinement_work =
        0.0;  ///< J, work of membrane, walls or normal force; written only in tests with one of these
    std::int64_t contacts_gained =
        0;  ///< points that touch without a bond; kept for the summary, not written as a column

    CRACKLE_FIELDS(axial_strain, axial_stress, stress_top, stress_bottom, lateral_strain, bonds_broken, kinetic_energy,
                   strain_energy, time, step, interfaces_lost, points_sliding, dashpot_loss, friction_loss,
                   fracture_loss, platen_work, energy_error, gauge_strain, bonds_slid, confinement_work,
                   contacts_gained);
};

/// Row of the curve for the current step. Requires compute_forces(). The force of the membrane on a platen does not
/// count as force of the specimen.
CurveRow observe_row(const World& world, const TestSetup& setup);

/// Mean stress of the two platens, N/m, positive in the direction of loading; requires compute_forces().
double axial_stress(const World& world, const PlacedApparatus& apparatus);

/// A column of curve.csv.
struct CurveColumn {
    Quantity what;
    double (*value)(const CurveRow&);
    bool whole;            ///< whether the values are whole numbers
    bool pressed = false;  ///< whether the column exists only in tests with a membrane or a normal force
};
/// The columns in file order.
const std::vector<CurveColumn>& curve_columns();

std::string curve_header(bool pressed);  ///< header line, including the line end
/// Line for a row, including the line end. Reading its numbers back gives identical bits.
std::string curve_line(const CurveRow& row, bool pressed);

}  // namespace crackle
