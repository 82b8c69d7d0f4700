// SPDX-License-Identifier: GPL-3.0-or-later
// Area change of a specimen under pressure on all sides.
// Tested by tests/verification/claims_test.cpp.

#include <cmath>
#include <vector>

#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/lattice_case.hpp"

namespace crackle::verification {
namespace pressure_scenes {
namespace {

/// Area change relative to that computed from the moduli of the specimen's linear solution.
double loss_over_theory(int columns, int rows) {
    constexpr double pressure = 1e3;  // N/m, a tenth of what the bonds withstand
    const LatticeCase block{.columns = columns,
                            .rows = rows,
                            .loading =
                                "[confinement]\npressure = 1e3\n[loading]\nkind = \"biaxial\"\n"
                                "axial_strain_rate = 0.01\nmax_axial_strain = 0.001\n"};
    const VirtualTest test = block.bonded();
    const TestSetup& setup = test.setup;
    const auto mean_way = [&](const std::vector<BodyIndex>& side) {
        double sum = 0.0;
        for (const BodyIndex b : side) sum += test.world.bodies.state[b].x - setup.bonds.start[b].x;
        return sum / static_cast<double>(side.size());
    };
    double left = 0.0, right = 0.0;
    for (const BodyIndex b : setup.gauges.left) left += setup.bonds.start[b].x;
    for (const BodyIndex b : setup.gauges.right) right += setup.bonds.start[b].x;
    const double gauge =
        right / static_cast<double>(setup.gauges.right.size()) - left / static_cast<double>(setup.gauges.left.size());
    const double lateral = (mean_way(setup.gauges.right) - mean_way(setup.gauges.left)) / gauge;
    const double axial = (test.world.bodies.state[setup.apparatus.top].y - setup.bonds.start[setup.apparatus.top].y) /
                         setup.specimen.height;
    const double expected = -2.0 * pressure * (1.0 - test.state.poissons_ratio) / test.state.youngs_modulus;
    return (lateral + axial) / expected;
}

std::vector<ClaimRow> block_under_pressure_loses_the_area_of_its_moduli() {
    Rows rows;
    rows.shown("loss over theory, 20 discs across", loss_over_theory(20, 47));
    rows.absolute("40 discs across", loss_over_theory(40, 93), 1.0, 0.02, "reference");
    return rows.take();
}

}  // namespace
}  // namespace pressure_scenes

std::vector<Claim> pressure_claims() {
    using namespace pressure_scenes;
    return {
        {.name = "block_under_pressure_loses_the_area_of_its_moduli",
         .group = "Laboratory",
         .statement = "ΔA/A = −2p(1 − ν)/E under a pressure p on all sides",
         .check = block_under_pressure_loses_the_area_of_its_moduli,
         .note = "A lattice of discs under its membrane; the boundary causes an error of the order d/W."},
    };
}

}  // namespace crackle::verification
