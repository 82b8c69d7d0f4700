// SPDX-License-Identifier: GPL-3.0-or-later
// The stress-strain curve: what is measured in a step, and how curve.csv shows it.
//
// Stress = force of the specimen on a platen (dashpots included) over the initial width, axial strain = displacement of
// the upper platen over the initial height; both positive in the sense of the test (compression in compression, tension
// in tension). Lateral strain = change of the distance between the mean x of the right and of the left side particles
// over its initial value, positive when the specimen widens. Strictly 2D: stress in N/m.
// Tested by tests/recount/recount_test.py.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/quantity.hpp"
#include "solver/world/world.hpp"

namespace crackle {

struct TestSetup;

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
    double confinement_work = 0.0;     ///< J, of membrane, walls or normal force; a column of such tests
    std::int64_t contacts_gained = 0;  ///< points touching without a bond; kept for the summary, not a column

    template <class Self, class Visit>
    static constexpr void fields(Self& s, Visit&& visit) {
        visit("axial_strain", s.axial_strain);
        visit("axial_stress", s.axial_stress);
        visit("stress_top", s.stress_top);
        visit("stress_bottom", s.stress_bottom);
        visit("lateral_strain", s.lateral_strain);
        visit("bonds_broken", s.bonds_broken);
        visit("kinetic_energy", s.kinetic_energy);
        visit("strain_energy", s.strain_energy);
        visit("time", s.time);
        visit("step", s.step);
        visit("interfaces_lost", s.interfaces_lost);
        visit("points_sliding", s.points_sliding);
        visit("dashpot_loss", s.dashpot_loss);
        visit("friction_loss", s.friction_loss);
        visit("fracture_loss", s.fracture_loss);
        visit("platen_work", s.platen_work);
        visit("energy_error", s.energy_error);
        visit("gauge_strain", s.gauge_strain);
        visit("bonds_slid", s.bonds_slid);
        visit("confinement_work", s.confinement_work);
        visit("contacts_gained", s.contacts_gained);
    }
};

/// Needs compute_forces() to have been called. What a membrane presses on a platen is not the specimen's force.
CurveRow observe_row(const World& world, const TestSetup& setup);

/// N/m, mean of the two platens', positive in the sense of the test; needs compute_forces().
double axial_stress(const World& world, const TestSetup& setup);

struct CurveColumn {
    Quantity what;
    double (*value)(const CurveRow&);
    bool whole;            ///< a count
    bool pressed = false;  ///< of tests with a membrane or a normal force only
};
/// In the order of the file.
const std::vector<CurveColumn>& curve_columns();

std::string curve_header(bool pressed);  ///< with line end
/// Numbers read back to the same bits; with line end.
std::string curve_line(const CurveRow& row, bool pressed);

}  // namespace crackle
