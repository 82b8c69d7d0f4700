// SPDX-License-Identifier: GPL-3.0-or-later
// The linear solution of simply supported beams: deflection, and the stress intensity at a notch from the energy
// release rate.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "solver/linear/springs.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/lattice_case.hpp"

namespace crackle::verification {
namespace beams_scenes {
namespace {

const double row_height = std::sqrt(0.75) * LatticeCase::spacing;

std::string bending(const std::string& keys) {
    return "[loading]\nkind = \"bending\"\naxial_strain_rate = 0.01\nmax_axial_strain = 0.001\n" + keys;
}

std::vector<ClaimRow> beam_bends_as_the_theory_of_elasticity_has_it() {
    const auto over_theory = [](int columns, int rows, double span, double pad) {
        const LatticeCase beam{.columns = columns,
                               .rows = rows,
                               .loading = bending(fmt::format("span = {}\npad_width = {}\n", span, pad))};
        const VirtualTest test = beam.bonded();
        const double depth = rows * row_height, ratio = depth / test.setup.apparatus.span;
        const double expected = beam.modulus() * std::pow(depth / test.setup.specimen.height, 3.0) /
                                (1.0 + 2.85 * ratio * ratio - 0.84 * ratio * ratio * ratio);
        return test.small_strain->moduli.youngs_modulus / expected;
    };
    const double coarse = over_theory(118, 13, 0.224, 0.006), fine = over_theory(226, 25, 0.43, 0.0115);
    Rows rows;
    rows.shown("nominal modulus over theory, 13 rows", coarse);
    rows.at_most("25 rows, difference from theory", std::abs(fine - 1.0), std::abs(coarse - 1.0),
                 "share of outer rows");
    rows.absolute("towards many rows", fine + (fine - coarse) * 13.0 / 12.0, 1.0, 0.02, "pads press in");
    return rows.take();
}

struct NotchedBeam {
    double compliance;        // m/N, displacement at the load divided by the load
    double stress_intensity;  // m^-1/2, stress intensity by the formula, divided by the load
    double points;            // largest number of bonded points between two cells
};
/// A beam with a notch that ends between row number `cut` and the next.
NotchedBeam notched_beam(const LatticeCase& lattice, int cut) {
    LatticeCase beam = lattice;
    const double notch = LatticeCase::radius - LatticeCase::overlap + (cut - 0.25) * row_height;
    beam.shape = fmt::format("[shape]\nnotch = {}\n", notch);
    const VirtualTest test = beam.bonded();
    const TestSetup& setup = test.setup;
    std::map<std::pair<BodyIndex, BodyIndex>, int> of_pair;
    for (const Spring& spring : springs_of(test.world, ClosedPoints::bonded))
        ++of_pair[std::minmax(spring.i, spring.j)];
    int most = 0;
    for (const auto& [pair, count] : of_pair) most = std::max(most, count);
    const double load =
        test.small_strain->moduli.youngs_modulus * setup.apparatus.section;  // N/m, load at a strain of 1
    return {setup.apparatus.length / load, setup.apparatus.stress_intensity / setup.apparatus.section, 0.5 * most};
}

std::vector<ClaimRow> notched_beam_sets_free_the_energy_of_its_stress_intensity() {
    constexpr int depth = 25;
    // The span is four times the depth, and each end extends half a depth beyond its support.
    const LatticeCase lattice{.columns = static_cast<int>(5.0 * depth * row_height / LatticeCase::spacing),
                              .rows = depth,
                              .loading = bending(""),
                              .hexagons = true,
                              .room = 0.5 * LatticeCase::spacing};
    std::vector<NotchedBeam> beams;
    for (const int cut : {7, 9, 11, 13}) beams.push_back(notched_beam(lattice, cut));
    Rows rows;
    rows.exactly("contact points of a face, each a spring along and across", beams.front().points, 4.0);
    for (const std::size_t k : {1U, 2U}) {
        // Energy release rate for a load of 1.
        const double released = 0.5 * (beams[k + 1].compliance - beams[k - 1].compliance) / (4.0 * row_height);
        rows.relative(fmt::format("K_I of a notch of {} of {} rows", 7 + 2 * k, depth),
                      std::sqrt(lattice.modulus() * released), beams[k].stress_intensity, 0.05,
                      "a quarter row of notch");
    }
    return rows.take();
}

}  // namespace
}  // namespace beams_scenes

std::vector<Claim> beam_claims() {
    using namespace beams_scenes;
    constexpr const char* group = "Laboratory";
    return {
        {.name = "beam_bends_as_the_theory_of_elasticity_has_it",
         .group = group,
         .statement = "δ = PS³/(48EI) [1 + 2.85 (W/S)² − 0.84 (W/S)³] (Timoshenko & Goodier, art. 23)",
         .check = beam_bends_as_the_theory_of_elasticity_has_it,
         .note =
             "A row represents √3/2 of a spacing. Outer rows are softer; this error is proportional to their share, so "
             "the result is extrapolated from two lattices. Each pad indents the beam by 2/π ln(W/c) P/E, 1 to 2 %."},
        {.name = "notched_beam_sets_free_the_energy_of_its_stress_intensity",
         .group = group,
         .statement = "K² = E P²/2 dC/da is (P S/W^1.5 f(a/W))² (ASTM E399), with the compliance C of the sparse solve",
         .check = notched_beam_sets_free_the_energy_of_its_stress_intensity,
         .note = "Hexagons, 25 rows deep, S = 4W; dC over four rows."},
    };
}

}  // namespace crackle::verification
