// SPDX-License-Identifier: GPL-3.0-or-later
// Energy of boxes of cells whose faces break: the balance closes, and the energy does not grow.
// Tested by tests/verification/claims_test.cpp.

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/stepping/time_step.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/loaded_cells.hpp"

namespace crackle::verification {
namespace face_energies {
namespace {

constexpr double shear_ratio = 1.0 / 1.6;

struct Loading {
    double closing_error = 0.0;     ///< largest closing error, relative to the work
    double peak = 0.0, last = 0.0;  ///< N, force of the platen
};

/// Loads a box until a share of its faces is broken.
Loading load(CellSpecimen& s, double velocity, double broken) {
    constexpr double step_share = 0.3;
    constexpr int most_steps = 200'000;
    s.world().stepping.time_step = step_share * s.exact_step();
    drive_platens(s, velocity);
    Loading loading;
    for (int n = 0; n < most_steps; ++n) {
        if (n % 100 != 0) {
            s.step();
            continue;
        }
        const Ledger ledger = s.ledger();
        if (ledger.displacement_work > 0.0)
            loading.closing_error =
                std::max(loading.closing_error, std::abs(ledger.closing_error) / ledger.displacement_work);
        loading.last = std::abs(s.world().bodies.force[s.cells.platens[1]].fy);
        loading.peak = std::max(loading.peak, loading.last);
        if (static_cast<double>(s.faces().broken.size()) > broken * static_cast<double>(s.faces().size())) break;
    }
    return loading;
}

std::vector<ClaimRow> energy_closes_while_faces_break() {
    Rows rows;
    for (const double velocity : {-2e-4, 4e-5}) {
        const std::string name = velocity < 0.0 ? "compression: " : "tension: ";
        FaceLaw law = brittle_cells();
        law.damping_ratio = 0.1;
        CellSpecimen s = bond_cells({.columns = 8, .rows = 8, .platens = true}, shear_ratio, law);
        const Loading loading = load(s, velocity, velocity < 0.0 ? 0.4 : 0.2);
        double least = 0.0, most = 0.0;
        for (const BreakEvent& one : s.world().bonds.events)
            least = std::min(least, one.energy), most = std::max(most, one.energy);
        rows.at_most(name + "force at the end over the peak", loading.last / loading.peak, 0.95, "past the peak");
        rows.absolute(name + "largest closing error, of the work", loading.closing_error, 0.0, 5e-4, "reference");
        rows.absolute(name + "least energy of a break, of the largest", least / most, 0.0, 1e-12, "rounding");
        const EnergyAccount& account = s.world().account;
        rows.shown(name + "share of the work in fracture", account.fracture_loss / account.displacement_work);
    }
    return rows.take();
}

/// Breaks a fifth of the faces, then shakes the specimen without damping between platens at rest.
void add_shaken(Rows& rows, const std::string& name, CellSpecimen s, int steps) {
    load(s, -2e-4, 0.2);
    for (FaceLaw& law : s.faces().laws) law.tensile_strength = law.cohesion = std::numeric_limits<double>::infinity();
    const std::size_t broken = s.faces().broken.size();
    // Where contact points replace faces, they lower the stable step.
    s.world().stepping.automatic_step = true;
    s.world().stepping.step_goal = 0.8 * s.exact_step();
    drive_platens(s, 0.0);
    s.step();
    restart_account(s.world());
    const Ledger first = s.ledger();
    const double start = first.kinetic + first.strain;
    double largest = start;
    Ledger now = first;
    for (int n = 0; n < steps; ++n) {
        if (n % 50 != 0) {
            s.step();
            continue;
        }
        now = s.ledger();
        largest = std::max(largest, now.kinetic + now.strain);
    }
    rows.at_least(name + "share of broken faces", static_cast<double>(broken) / static_cast<double>(s.faces().size()),
                  0.2, "the loading");
    rows.exactly(name + "further breaks", static_cast<double>(s.faces().broken.size() - broken), 0.0);
    // Under leapfrog the energy oscillates in proportion to (ω Δt)², where ω is the frequency of the moving modes.
    rows.at_most(name + "largest energy over the first", largest / start, 1.0 + 2e-3, "leapfrog");
    rows.at_most(name + "last energy over the first", (now.kinetic + now.strain) / start, 1.0, "losses");
    rows.absolute(name + "closing error, of the first energy", now.closing_error / start, 0.0, 0.02, "large steps");
}

std::vector<ClaimRow> broken_specimen_gains_no_energy() {
    Rows rows;
    const CellBox box{.columns = 8, .rows = 8, .platens = true};
    add_shaken(rows, "Voronoi cells, 100,000 steps: ", bond_cells(box, shear_ratio, brittle_cells()), 100'000);
    // If lagged pressures moved by their full changes, the energy would grow here, so they move by fractions of them.
    // Corners of triangles meet at nodes, where contact points need a gap that is wide compared with the motion.
    add_shaken(
        rows, "triangles, 20,000 steps: ",
        bond_cells({.kind = MeshKind::delaunay, .columns = 6, .rows = 6, .lloyd = 20, .gap = 4e-3, .platens = true},
                   shear_ratio, brittle_cells()),
        20'000);
    add_shaken(rows, "ν = 0.45, 20,000 steps: ", bond_cells(box, 1.0, brittle_cells(), 0.45), 20'000);
    return rows.take();
}

}  // namespace
}  // namespace face_energies

std::vector<Claim> face_energy_claims() {
    using namespace face_energies;
    constexpr const char* group = "Faces";
    return {
        {.name = "energy_closes_while_faces_break",
         .group = group,
         .statement = "up to the peak and beyond, the work of the platens is the energy and the losses of the cells to "
                      "5e-4, and no break releases a negative energy",
         .check = energy_closes_while_faces_break,
         .slow = true},
        {.name = "broken_specimen_gains_no_energy",
         .group = group,
         .statement = "the energy of an undamped specimen, a fifth of whose faces is broken, never exceeds the first",
         .check = broken_specimen_gains_no_energy,
         .slow = true},
    };
}

}  // namespace crackle::verification
