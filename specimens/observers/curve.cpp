// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/observers/curve.hpp"

#include <fmt/format.h>

#include "solver/measure/ledger.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

CurveRow observe_row(const World& world, const TestSetup& setup) {
    CurveRow row;
    const double sense = setup.compression ? 1.0 : -1.0;
    row.axial_strain = setup.axial_strain(world);
    row.stress_top = sense * world.bodies.force[setup.top].fy / setup.width;
    row.stress_bottom = -sense * world.bodies.force[setup.bottom].fy / setup.width;
    row.axial_stress = 0.5 * (row.stress_top + row.stress_bottom);
    row.lateral_strain = setup.lateral_strain(world);
    row.gauge_strain = setup.gauge_strain(world);
    row.bonds_broken = world.bonds.broken;
    row.interfaces_lost = world.bonds.interfaces_lost;
    row.time = world.stepping.time;
    row.step = world.stepping.steps;
    for (const PointState& point : world.points.state) {
        const bool touching = (point.flags & point_touching) != 0;
        if (touching && (point.flags & point_sliding) != 0) ++row.points_sliding;
        if (touching && (point.flags & point_bonded) == 0) ++row.contacts_gained;
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
        {{"points_sliding", "", "contact points at the Coulomb limit in this step"},
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
          "axial, between the particles within half a mean particle of the ends of the gauge length, which is the "
          "height "
          "without the grips, or without the outer tenths where there are none; nan where an end has none"},
         [](Row r) { return r.gauge_strain; },
         false},
    };
    return columns;
}

std::string curve_header() {
    std::string line;
    for (const CurveColumn& column : curve_columns()) {
        if (!line.empty()) line += ',';
        line += column.what.name;
    }
    return line + '\n';
}

std::string curve_line(const CurveRow& row) {
    std::string line;
    for (const CurveColumn& column : curve_columns()) {
        if (!line.empty()) line += ',';
        const double value = column.value(row);
        line += column.whole ? fmt::format("{}", static_cast<std::int64_t>(value)) : fmt::format("{}", value);
    }
    return line + '\n';
}

}  // namespace crackle
