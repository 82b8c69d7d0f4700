// SPDX-License-Identifier: GPL-3.0-or-later
// First bond break of the triangular lattice under uniaxial tension, along and across a bond row, with the engine's own
// contact law. All discs are moved by a homogeneous strain, under which every inner disc is in equilibrium by symmetry.
// The lateral strain is adjusted so that the lateral stress remains zero.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace lattice_strength_scenes {
namespace {

// The overlap is small, so that the change of shape up to the break, δ0/2R = 2.5e-5, is negligible.
constexpr double radius = 0.02, overlap = 1e-6, spacing = 2.0 * radius - overlap, kn = 1e7, strength = kn * overlap;
constexpr int increments = 8000;  // approximate number until the break

struct Pull {
    double shear_share;
    double friction;  // μ
    bool slip;        // whether the Coulomb limit applies
    bool along;       // whether tension is along the bond row (x) or across it (y)
};

struct FirstBreak {
    double stress = 0.0;      // N/m, stress in the last increment before the break
    double lateral = 0.0;     // N/m, largest lateral stress until then
    double unbalanced = 0.0;  // N, largest net force on the observed disc until then
    bool right_bonds = true;  // whether only bonds of the expected rows broke
    bool slid = false;
};

/// Stress and net force of one inner disc: ½Σ f⊗l divided by its cell's area.
struct DiscStress {
    double xx = 0.0, yy = 0.0;
    Vec2 net;
};
DiscStress stress_of(const World& world, BodyIndex disc) {
    DiscStress stress;
    const double area = 0.5 * std::sqrt(3.0) * spacing * spacing;
    // There are no walls.
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const ContactPoint point = world.points.contact[k];
        if (point.body_i != disc && point.body_j != disc) continue;
        const PointForce& force = world.points.force[k];
        const double sign = point.body_i == disc ? 1.0 : -1.0;
        const BodyIndex other = point.body_i == disc ? point.body_j : point.body_i;
        const Vec2 arm{world.bodies.state[other].x - world.bodies.state[disc].x,
                       world.bodies.state[other].y - world.bodies.state[disc].y};
        stress.xx += 0.5 * sign * force.fx * arm.x / area;
        stress.yy += 0.5 * sign * force.fy * arm.y / area;
        stress.net = stress.net + sign * Vec2{force.fx, force.fy};
    }
    return stress;
}

FirstBreak pull(const Pull& request) {
    const double angle = std::atan(request.friction) * 180.0 / std::numbers::pi;
    Scene scene = triangular_lattice(5, 5, radius, overlap, rock(angle, request.shear_share));
    scene.intact.no_sliding = !request.slip;
    scene.intact.no_new_contacts = true;
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    const Array<BodyState> start = world.bodies.state;
    const BodyIndex inner = body_of_id(world, 12);           // the middle of rows of 5, 4, 5, 4, 5
    const double by = 1.4 * overlap / spacing / increments;  // strain per increment; inclined bonds open by less
    const double c11 = std::sqrt(3.0) / 4.0 * (3.0 + request.shear_share) * kn;
    double axial = 0.0, lateral = 0.0;
    compute_forces(world);
    FirstBreak result;
    for (int n = 0; n < 3 * increments; ++n) {
        const DiscStress stress = stress_of(world, inner);
        const double sideways = request.along ? stress.yy : stress.xx;
        axial += by;
        lateral -= sideways / c11;
        const Vec2 stretch = request.along ? Vec2{1.0 + axial, 1.0 + lateral} : Vec2{1.0 + lateral, 1.0 + axial};
        for (std::size_t b = 0; b < world.bodies.size(); ++b) {
            BodyState& body = world.bodies.state[b];
            const double x = stretch.x * start[b].x, y = stretch.y * start[b].y;
            body.vx = (x - body.x) / world.stepping.time_step;
            body.vy = (y - body.y) / world.stepping.time_step;
            body.x = x, body.y = y;
        }
        world.stepping.drift = world.stepping.time_step;
        world.stepping.forces_current = false;
        compute_forces(world);
        if (world.bonds.broken > 0) {
            result.stress = request.along ? stress.xx : stress.yy;
            for (const BreakEvent& event : world.bonds.events) {
                const bool in_row = std::abs(event.orientation) < 0.1;
                result.right_bonds = result.right_bonds && in_row == request.along;
            }
            break;
        }
        result.lateral = std::max(result.lateral, std::abs(sideways));
        result.unbalanced = std::max(result.unbalanced, norm(stress.net));
        for (const PointState point : world.points.state) result.slid = result.slid || (point.flags & point_slid) != 0;
    }
    return result;
}

double expected_along(double share) { return std::sqrt(3.0) * (1.0 + share) * strength / (radius * (3.0 + share)); }
double expected_across(double share) { return std::sqrt(3.0) * (1.0 + share) * strength / (radius * (2.0 + share)); }

void check(Rows& rows, const std::string& name, const FirstBreak& got, double expected) {
    // The error is one increment of stress, 1/increments, since the break is found after it. The delayed lateral strain
    // adds the same amount, and the change of shape is added as well.
    rows.relative(name + ": stress, N/m", got.stress, expected, 3.0 / increments + overlap / radius, "increment");
    rows.exactly(name + ": breaks only bonds of the expected rows", got.right_bonds ? 1.0 : 0.0, 1.0);
    rows.absolute(name + ": lateral stress during loading, over that", got.lateral / expected, 0.0, 3.0 / increments,
                  "increment");
    rows.absolute(name + ": force on an inner disc, over F_b", got.unbalanced / strength, 0.0, 1e-9, "symmetry");
}

std::vector<ClaimRow> first_break_pulled_along_a_bond_row() {
    Rows rows;
    for (const double share : {0.0, 0.25, 0.5, 1.0}) {
        check(rows, fmt::format("k_s/k_n {}, without slip", share), pull({share, 1.0, false, true}),
              expected_along(share));
        if (share == 0.0) continue;
        const double enough = share / std::sqrt(3.0);
        const FirstBreak holds = pull({share, 1.02 * enough, true, true});
        check(rows, fmt::format("k_s/k_n {}, μ 1.02 of what holds", share), holds, expected_along(share));
        rows.exactly(fmt::format("k_s/k_n {}, μ 1.02 of what holds: slips", share), holds.slid ? 1.0 : 0.0, 0.0);
        const FirstBreak slips = pull({share, 0.98 * enough, true, true});
        rows.exactly(fmt::format("k_s/k_n {}, μ 0.98 of it: slips", share), slips.slid ? 1.0 : 0.0, 1.0);
    }
    return rows.take();
}

std::vector<ClaimRow> first_break_pulled_across_a_bond_row() {
    Rows rows;
    for (const double share : {0.0, 0.25, 1.0}) {
        check(rows, fmt::format("k_s/k_n {}, without slip", share), pull({share, 1.0, false, false}),
              expected_across(share));
        if (share == 0.0) continue;
        for (const double friction : {0.3, 1.0}) {
            const FirstBreak got = pull({share, friction, true, false});
            check(rows, fmt::format("k_s/k_n {}, μ {}", share, friction), got,
                  0.5 * std::sqrt(3.0) * strength / radius);
            rows.exactly(fmt::format("k_s/k_n {}, μ {}: slips", share, friction), got.slid ? 1.0 : 0.0, 1.0);
        }
    }
    return rows.take();
}

}  // namespace
}  // namespace lattice_strength_scenes

std::vector<Claim> lattice_strength_claims() {
    using namespace lattice_strength_scenes;
    constexpr const char* group = "Chains and lattices";
    return {
        {.name = "first_break_pulled_along_a_bond_row",
         .group = group,
         .statement = "σ = √3(k_n+k_s)F_b/[R(3k_n+k_s)] with and without slip, if μ > k_s/(√3 k_n)",
         .check = first_break_pulled_along_a_bond_row,
         .note = "At the break, the bonds at 60° carry |T| = √3 k_s F_b/(3k_n+k_s), and their normal force is reduced "
                 "by |T|/√3. They hold while √3 k_s ≤ 3μk_n, which gives the reference's μ > 0.144 and 0.577."},
        {.name = "first_break_pulled_across_a_bond_row",
         .group = group,
         .statement =
             "σ = √3F_b/(2R) with Coulomb's limit, which vanishes as δ → 0; √3(k_n+k_s)F_b/[R(2k_n+k_s)] without slip",
         .check = first_break_pulled_across_a_bond_row},
    };
}

}  // namespace crackle::verification
