// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "solver/measure/ledger.hpp"
#include "solver/membrane/press.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

namespace {

// Of the mean back-tension: surfaces that just touch overlap by the rounding of their places, up to 1e-11 of a bond's.
constexpr double least_sliding_force = 1e-9;

}  // namespace

namespace {

/// Of the specimen alone.
PartForces specimen_forces(const World& world, const TestSetup& setup) {
    PartForces forces = forces_on_parts(world, setup);
    if (setup.confined()) {
        forces.driver -= membrane_force_on(world, setup.top).fy;
        forces.supports -= membrane_force_on(world, setup.bottom).fy;
    }
    return forces;
}

}  // namespace

double axial_stress(const World& world, const TestSetup& setup) {
    const PartForces forces = specimen_forces(world, setup);
    return 0.5 * setup.sense() * (forces.driver - forces.supports) / setup.section;
}

CurveRow observe_row(const World& world, const TestSetup& setup) {
    CurveRow row;
    const double sense = setup.sense();
    row.axial_strain = setup.axial_strain(world);
    const PartForces forces = specimen_forces(world, setup);
    row.stress_top = sense * forces.driver / setup.section;
    row.stress_bottom = -sense * forces.supports / setup.section;
    row.confinement_work = world.account.force_work;
    row.axial_stress = 0.5 * (row.stress_top + row.stress_bottom);
    row.lateral_strain = setup.lateral_strain(world);
    row.gauge_strain = setup.gauge_strain(world);
    row.bonds_broken = world.bonds.broken;
    row.interfaces_lost = world.bonds.interfaces_lost;
    row.time = world.stepping.time;
    row.step = world.stepping.steps;
    row.bonds_slid = world.bonds.broken_after_sliding;
    const double strength = setup.coulomb_bonds ? setup.mean_tensile_strength : setup.mean_back_tension;
    for (std::size_t k = 0; k < world.points.size(); ++k) {
        constexpr int bond_that_slid = point_bonded | point_slid;
        const std::uint16_t flags = world.points.state[k].flags;
        if ((flags & bond_that_slid) == bond_that_slid) ++row.bonds_slid;
        if ((flags & point_touching) == 0) continue;
        const bool pulled = std::abs(world.points.shear_force[k]) > least_sliding_force * strength;
        if ((flags & point_sliding) != 0 && pulled) ++row.points_sliding;
        if ((flags & point_bonded) == 0) ++row.contacts_gained;
    }
    const Ledger ledger = measure_ledger(world);
    row.kinetic_energy = ledger.kinetic;
    row.strain_energy = ledger.strain;
    row.dashpot_loss = ledger.dashpot_loss;
    row.friction_loss = ledger.friction_loss;
    row.fracture_loss = ledger.fracture_loss;
    row.platen_work = ledger.displacement_work;
    row.energy_error = ledger.closing_error;
    return row;
}

const std::vector<CurveColumn>& curve_columns() {
    using Row = const CurveRow&;
    static const std::vector<CurveColumn> columns{
        {{"axial_strain", "-", "positive in the sense of the test",
          "displacement of the upper platen over the initial height"},
         [](Row r) { return r.axial_strain; },
         false},
        {{"axial_stress", "N/m", "mean of both platens, positive in the sense of the test"},
         [](Row r) { return r.axial_stress; },
         false},
        {{"stress_top", "N/m", "upper platen, positive in the sense of the test",
          "force of the specimen on it, dashpots included, over the initial width"},
         [](Row r) { return r.stress_top; },
         false},
        {{"stress_bottom", "N/m", "lower platen, positive in the sense of the test"},
         [](Row r) { return r.stress_bottom; },
         false},
        {{"lateral_strain", "-", "positive when the specimen widens",
          "growth of the distance between the mean x of the right and of the left side particles over its initial "
          "value; side particles are those at a side face, in the middle half of the height; nan without any"},
         [](Row r) { return r.lateral_strain; },
         false},
        {{"bonds_broken", "", "bonded points broken so far"},
         [](Row r) { return static_cast<double>(r.bonds_broken); },
         true},
        {{"kinetic_energy", "J", "", "of all bodies, with the mean of the velocities half a step before and after"},
         [](Row r) { return r.kinetic_energy; },
         false},
        {{"strain_energy", "J", "of all contact points, from the bonded state"},
         [](Row r) { return r.strain_energy; },
         false},
        {{"time", "s since loading began", "", "of the row"}, [](Row r) { return r.time; }, false},
        {{"step", "steps since loading began", "", "of the row"},
         [](Row r) { return static_cast<double>(r.step); },
         true},
        {{"interfaces_lost", "", "pairs of bodies whose last bond has broken so far"},
         [](Row r) { return static_cast<double>(r.interfaces_lost); },
         true},
        {{"points_sliding", "", "contact points at the Coulomb limit in this step",
          "with a shear force above 1e-9 of the mean back-tension, so that surfaces that just touch do not count"},
         [](Row r) { return static_cast<double>(r.points_sliding); },
         true},
        {{"dashpot_loss", "J", "so far"}, [](Row r) { return r.dashpot_loss; }, false},
        {{"friction_loss", "J", "so far"}, [](Row r) { return r.friction_loss; }, false},
        {{"fracture_loss", "J", "so far", "taken by broken bonds"}, [](Row r) { return r.fracture_loss; }, false},
        {{"platen_work", "J", "done on the specimen so far"}, [](Row r) { return r.platen_work; }, false},
        {{"energy_error", "J", "kinetic + strain - both at the start of loading + losses - work",
          "what the account of energy leaves open; under the guide's law what the law itself takes or makes, "
          "energy_lost_to_contact_law of summary.json, counts among the losses"},
         [](Row r) { return r.energy_error; },
         false},
        {{"gauge_strain", "-", "positive in the sense of the test",
          "axial, between the bonded particles within half a mean particle of the ends of the gauge length, which is "
          "the height without the grips, or without the outer tenths where there are none; nan where an end has none"},
         [](Row r) { return r.gauge_strain; },
         false},
        {{"bonds_slid", "", "bonded points that have been at their Coulomb limit so far, broken ones among them",
          "each has its row in slips.csv, where that is asked for"},
         [](Row r) { return static_cast<double>(r.bonds_slid); },
         true},
        {{"confinement_work", "J",
          "done by the membrane, the walls, or the normal force of direct shear, on the specimen so far",
          "of such tests"},
         [](Row r) { return r.confinement_work; },
         false,
         true},
    };
    return columns;
}

namespace {

auto of_row(bool pressed) {
    return [pressed](const CurveColumn& column) { return pressed || !column.pressed; };
}

}  // namespace

std::string curve_header(bool pressed) {
    return table_line(curve_columns(), of_row(pressed), [](const CurveColumn& column) { return column.what.name; });
}

std::string curve_line(const CurveRow& row, bool pressed) {
    return table_line(curve_columns(), of_row(pressed), [&](const CurveColumn& column) {
        const double value = column.value(row);
        return column.whole ? fmt::format("{}", static_cast<std::int64_t>(value)) : fmt::format("{}", value);
    });
}

}  // namespace crackle
