// SPDX-License-Identifier: GPL-3.0-or-later
// The Brazilian disc by its linear solution: Hondros' stress at the centre, and the effect of glued arcs.
// Tested by tests/verification/claims_test.cpp.

#include <cmath>
#include <numbers>
#include <vector>

#include "solver/linear/elastic.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/lattice_case.hpp"

namespace crackle::verification {
namespace disc_scenes {
namespace {

constexpr double alpha = 10.0 * std::numbers::pi / 180.0;  // rad, half the angle of the arc
constexpr double reach = 0.3;                              // averaging radius over the disc's radius
constexpr int parts = 400;

/// Weight of a position at a distance from the middle, relative to `reach`. It is smooth, so that single bonds at the
/// edge of the region do not matter.
double weight(double distance) {
    const double rest = 1.0 - distance * distance;
    return rest > 0.0 ? 15.0 / 16.0 * rest * rest : 0.0;  // its integral over -1 to 1 is 1
}

/// Mean tensile stress across the load line about the centre, N/m.
double stress_across(const VirtualTest& test, const std::vector<BodyMotion>& displacement) {
    const World& world = test.world;
    // The section passes between discs, not through a row of centres.
    const double at = test.setup.specimen.middle + 0.1 * LatticeCase::spacing, half = 0.5 * test.setup.specimen.width;
    double force = 0.0;
    for (const Spring& spring : springs_of(world, ClosedPoints::bonded)) {
        const BodyState &a = world.bodies.state[spring.i], &b = world.bodies.state[spring.j];
        if ((a.x < at) == (b.x < at)) continue;
        const double y = a.y + (at - a.x) / (b.x - a.x) * (b.y - a.y);
        const double pull = spring.stiffness * times(spring, spring.gradient, displacement) * spring.push[0];
        // Tension on the body to the left, along -x.
        force += weight((y - test.setup.specimen.middle_height) / (reach * half)) * (a.x < at ? pull : -pull);
    }
    return -force / (reach * half);
}

/// Stress in Hondros' disc for a pressure of 1 on both arcs.
double hondros() {
    double sum = 0.0;
    for (int k = 0; k < parts; ++k) {
        const double along = 2.0 * (k + 0.5) / parts - 1.0, r2 = std::pow(along * reach, 2.0);
        const double a = (1.0 - r2) * std::sin(2.0 * alpha) / (1.0 - 2.0 * r2 * std::cos(2.0 * alpha) + r2 * r2);
        const double b = std::atan((1.0 + r2) / (1.0 - r2) * std::tan(alpha));
        sum += 2.0 / std::numbers::pi * (a - b) * weight(along) * 2.0 / parts;
    }
    return sum;
}

BodyIndex nearest_body(const VirtualTest& test, Vec2 place) {
    BodyIndex nearest = 0;
    double least = 1e300;
    for (BodyIndex b = 0; b < test.world.bodies.size(); ++b) {
        const BodyState& body = test.world.bodies.state[b];
        const double away = std::hypot(body.x - place.x, body.y - place.y);
        if (test.setup.apparatus.is_platen(b) || away >= least) continue;
        least = away;
        nearest = b;
    }
    return nearest;
}

VirtualTest disc(const std::string& jaws) {
    return LatticeCase{.columns = 61,
                       .rows = 71,
                       .loading =
                           "[loading]\nkind = \"brazilian\"\nhalf_angle = 10\naxial_strain_rate = 0.01\n"
                           "max_axial_strain = 0.001\n" +
                           jaws,
                       .hexagons = true}
        .bonded();
}

std::vector<ClaimRow> disc_under_even_pressure_has_hondros_stress() {
    const VirtualTest test = disc("platens = \"frictional\"\nplaten_friction_angle = 0\n");
    const double half = 0.5 * test.setup.specimen.width;
    const Vec2 centre{test.setup.specimen.middle, test.setup.specimen.middle_height};
    std::vector<BodyMotion> loads(test.world.bodies.size());
    for (const double side : {1.0, -1.0}) {
        for (int k = 0; k < parts; ++k) {
            const double angle = ((k + 0.5) / parts * 2.0 - 1.0) * alpha;
            const Vec2 out{side * std::sin(angle), side * std::cos(angle)};
            const Vec2 place{centre.x + half * out.x, centre.y + half * out.y};
            const double force = half * 2.0 * alpha / parts;
            const BodyIndex b = nearest_body(test, place);
            const BodyState& body = test.world.bodies.state[b];
            loads[b].x -= force * out.x;
            loads[b].y -= force * out.y;
            loads[b].rotation -= force * ((place.x - body.x) * out.y - (place.y - body.y) * out.x);
        }
    }
    // The disc is held at its centre and in rotation; the reaction there is 0.
    const ElasticSolution solution = solve_elastic(test.world, {{nearest_body(test, centre), {}}}, loads);
    Rows rows;
    rows.absolute("force at the fixed centre over the load", solution.reaction[0].y / half, 0.0, 1e-6, "symmetry");
    rows.relative("stress across the load line at the centre", stress_across(test, solution.displacement), hondros(),
                  0.02, "a mean over 9 cells");
    return rows.take();
}

std::vector<ClaimRow> glued_arcs_stretch_the_centre_less() {
    const VirtualTest test = disc("");
    const double half = 0.5 * test.setup.specimen.width;
    const double force =
        test.small_strain->moduli.youngs_modulus * test.setup.apparatus.section;  // N, force at a strain of 1
    const double got = -stress_across(test, test.small_strain->moduli.solution.displacement);
    Rows rows;
    rows.absolute("stress across over Hondros'", got / (hondros() * force / (2.0 * half * std::sin(alpha))), 0.95, 0.02,
                  "a cell of 5 under each arc");
    return rows.take();
}

}  // namespace
}  // namespace disc_scenes

std::vector<Claim> disc_claims() {
    using namespace disc_scenes;
    constexpr const char* group = "Laboratory";
    return {
        {.name = "disc_under_even_pressure_has_hondros_stress",
         .group = group,
         .statement = "σ_θ = (2p/π)(A − B) on the loaded diameter of a disc, p over 20°",
         .check = disc_under_even_pressure_has_hondros_stress,
         .note = "Disc of 60 hexagons across, by the sparse solve."},
        {.name = "glued_arcs_stretch_the_centre_less",
         .group = group,
         .statement = "Glued jaws press unevenly and restrain the disc laterally: the stress is a twentieth smaller "
                      "than that of Hondros",
         .check = glued_arcs_stretch_the_centre_less,
         .note = "Disc of 60 hexagons across, by the sparse solve."},
    };
}

}  // namespace crackle::verification
