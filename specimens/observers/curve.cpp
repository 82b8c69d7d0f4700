// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/curve.hpp"

#include <fmt/format.h>

#include <cmath>

#include "solver/measure/ledger.hpp"
#include "solver/membrane/press.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

namespace {

// Smallest shear force at which a point counts as sliding, relative to the mean bond strength. Surfaces that only just
// touch may overlap because of round-off, by up to 1e-11 of a bond's overlap.
constexpr double least_sliding_force = 1e-9;

}  // namespace

namespace {

/// Forces of the specimen on its platens, without the forces of the membrane.
PartForces specimen_forces(const World& world, const PlacedApparatus& apparatus) {
    PartForces forces = forces_on_parts(world, apparatus);
    if (apparatus.confined()) {
        forces.driver -= membrane_force_on(world, apparatus.top).fy;
        forces.supports -= membrane_force_on(world, apparatus.bottom).fy;
    }
    return forces;
}

}  // namespace

double axial_stress(const World& world, const PlacedApparatus& apparatus) {
    const PartForces forces = specimen_forces(world, apparatus);
    return 0.5 * apparatus.sense() * (forces.driver - forces.supports) / apparatus.section;
}

CurveRow observe_row(const World& world, const TestSetup& setup) {
    CurveRow row;
    const double sense = setup.apparatus.sense();
    row.axial_strain = setup.apparatus.axial_strain(world);
    const PartForces forces = specimen_forces(world, setup.apparatus);
    row.stress_top = sense * forces.driver / setup.apparatus.section;
    row.stress_bottom = -sense * forces.supports / setup.apparatus.section;
    row.confinement_work = world.account.force_work;
    row.axial_stress = 0.5 * (row.stress_top + row.stress_bottom);
    row.lateral_strain = setup.lateral_strain(world);
    row.gauge_strain = setup.gauge_strain(world);
    row.bonds_broken = world.bonds.broken;
    row.interfaces_lost = world.bonds.interfaces_lost;
    row.time = world.stepping.time;
    row.step = world.stepping.steps;
    row.bonds_slid = world.bonds.broken_after_sliding;
    const double strength =
        setup.bonds.facts().strengths_are_given ? setup.bonds.mean_tensile_strength : setup.bonds.mean_back_tension;
    for (std::size_t k = 0; k < world.points.size(); ++k) {
        constexpr int bond_that_slid = point_bonded | point_slid;
        const std::uint16_t flags = world.points.state[k].flags;
        if ((flags & bond_that_slid) == bond_that_slid) ++row.bonds_slid;
        if ((flags & point_touching) == 0) continue;
        const bool pulled = std::abs(world.points.shear_force[k]) > least_sliding_force * strength;
        if ((flags & point_sliding) != 0 && pulled) ++row.points_sliding;
        if ((flags & point_bonded) == 0) ++row.contacts_gained;
    }
    for (const BrokenFace& face : world.faces.broken)
        if (face.last.slip != 0.0 && std::abs(face.last.shear) > least_sliding_force * strength) ++row.points_sliding;
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
        {{"axial_strain", "-",
          "displacement of the upper platen divided by the initial height, positive in the direction of loading",
          "in tests without platens, displacement of the driving part divided by `strain_length` of summary.json"},
         [](Row r) { return r.axial_strain; },
         false},
        {{"axial_stress", "N/m", "mean of stress_top and stress_bottom, positive in the direction of loading"},
         [](Row r) { return r.axial_stress; },
         false},
        {{"stress_top", "N/m", "stress on the upper platen, positive in the direction of loading",
          "force of the specimen on the platen, dashpots included, divided by the initial width; in tests without "
          "platens, force on the driving part divided by `stress_section` of summary.json"},
         [](Row r) { return r.stress_top; },
         false},
        {{"stress_bottom", "N/m",
          "stress on the lower platen (in tests without platens, on the supports), positive in the direction of "
          "loading"},
         [](Row r) { return r.stress_bottom; },
         false},
        {{"lateral_strain", "-",
          "change in the distance between the left and right side particles, divided by its initial value; positive if "
          "the specimen widens",
          "the distance is measured from the mean x of the left side particles to the mean x of the right ones. Side "
          "particles lie at a side face in the middle half of the height; nan if a side has none. In direct shear "
          "tests, the column is the rise of the upper half box divided by the height"},
         [](Row r) { return r.lateral_strain; },
         false},
        {{"bonds_broken", "", "number of bonded contact points that have broken"},
         [](Row r) { return static_cast<double>(r.bonds_broken); },
         true},
        {{"kinetic_energy", "J", "kinetic energy of all bodies",
          "computed from the mean of the velocities half a time step before and half a time step after the row"},
         [](Row r) { return r.kinetic_energy; },
         false},
        {{"strain_energy", "J", "strain energy of all contact points, relative to the bonded state"},
         [](Row r) { return r.strain_energy; },
         false},
        {{"time", "s since loading began", "", "time of the row"}, [](Row r) { return r.time; }, false},
        {{"step", "steps since loading began", "", "time step of the row"},
         [](Row r) { return static_cast<double>(r.step); },
         true},
        {{"interfaces_lost", "", "number of bonded pairs of bodies whose last bond has broken"},
         [](Row r) { return static_cast<double>(r.interfaces_lost); },
         true},
        {{"points_sliding", "", "number of contact points at the Coulomb limit in the time step of the row",
          "points whose shear force is at most 1e-9 of the mean back-tension (mean tensile strength for coulomb bonds) "
          "are not counted, because their surfaces barely touch"},
         [](Row r) { return static_cast<double>(r.points_sliding); },
         true},
        {{"dashpot_loss", "J", "energy dissipated in dashpots since loading began"},
         [](Row r) { return r.dashpot_loss; },
         false},
        {{"friction_loss", "J", "energy dissipated by sliding since loading began"},
         [](Row r) { return r.friction_loss; },
         false},
        {{"fracture_loss", "J", "energy dissipated by broken bonds since loading began"},
         [](Row r) { return r.fracture_loss; },
         false},
        {{"platen_work", "J", "work done by the platens on the specimen since loading began"},
         [](Row r) { return r.platen_work; },
         false},
        {{"energy_error", "J",
          "imbalance of the energy account: kinetic and strain energy minus their values when loading began, plus "
          "losses, minus work",
          "with the DEMseg guide's contact law, the energy that the law itself loses or creates "
          "(energy_lost_to_contact_law in summary.json) is included in the losses. For bonds that are faces, the "
          "losses "
          "include what broken faces lose because they react to their cells' pressures one step late"},
         [](Row r) { return r.energy_error; },
         false},
        {{"gauge_strain", "-", "axial strain of the gauge length, positive in the direction of loading",
          "the strain is measured between the bonded particles within half a mean particle size of the two ends of the "
          "gauge length. The gauge length is the height without the grips, or without the outer tenths if there are no "
          "grips; nan if an end has no particles"},
         [](Row r) { return r.gauge_strain; },
         false},
        {{"bonds_slid", "",
          "number of bonded contact points that have reached their Coulomb limit, including broken ones",
          "each of these points has a row in slips.csv, if that file is written"},
         [](Row r) { return static_cast<double>(r.bonds_slid); },
         true},
        {{"confinement_work", "J",
          "work done on the specimen since loading began by the membrane, the walls or the normal force of a direct "
          "shear test",
          "only in confined and direct shear tests"},
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
