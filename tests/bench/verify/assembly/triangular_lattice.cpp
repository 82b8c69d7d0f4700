// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness of the bonded triangular lattice by the sparse solve.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/linear/elastic.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/world/world.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace triangular_lattice_scenes {
namespace {

constexpr double radius = 0.02, overlap = 8e-5, spacing = 2.0 * radius - overlap, kn = 1e7;

World lattice(int columns, int rows, double shear_share) {
    Scene scene = triangular_lattice(columns, rows, radius, overlap, rock(45.0, shear_share));
    scene.intact = {true, true, true};
    World world = build_world(std::move(scene));
    bond_all(world, 0.0);
    return world;
}

struct Strain {
    double xx, yy, xy;  // tensor components
};

struct Section {
    Vec2 across_x, across_y;  // N, force on the right half across x = const, on the upper half across y = const
    double affine_error;      // largest deviation from the affine displacement, relative to the largest displacement
};

/// Outer discs are displaced affinely without rotation, and inner discs are solved for; returns the forces across the
/// middle of the lattice.
Section strained(int columns, int rows, double shear_share, const Strain& e) {
    const World world = lattice(columns, rows, shear_share);
    std::vector<Prescribed> held;
    const auto affine = [&](std::size_t b) {
        const BodyState& body = world.bodies.state[b];
        return BodyMotion{e.xx * body.x + e.xy * body.y, e.xy * body.x + e.yy * body.y, 0.0};
    };
    std::vector<int> bonds(world.bodies.size());
    for (const BodyPair& pair : world.points.contact.pairs) ++bonds[pair.body_i], ++bonds[pair.body_j];
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        if (bonds[b] < 6) held.push_back({static_cast<BodyIndex>(b), affine(b)});
    }
    const ElasticSolution solution = solve_elastic(world, held);
    Section section{{}, {}, 0.0};
    double largest = 0.0;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyMotion expected = affine(b), got = solution.displacement[b];
        largest = std::max({largest, std::abs(expected.x), std::abs(expected.y)});
        section.affine_error =
            std::max({section.affine_error, std::abs(got.x - expected.x), std::abs(got.y - expected.y)});
        if (shear_share > 0.0) section.affine_error = std::max(section.affine_error, radius * std::abs(got.rotation));
    }
    section.affine_error /= largest;  // without shear springs discs rotate freely, so rotations are not compared
    // Sections pass between discs, not through centres.
    const double x = spacing * (0.5 * columns + 0.2), y = spacing * std::sqrt(3.0) * 0.5 * (0.5 * rows + 0.2);
    for (std::size_t k = 0; k < held.size(); ++k) {
        const Vec2 force{solution.reaction[k].x, solution.reaction[k].y};
        if (world.bodies.state[held[k].body].x > x) section.across_x = section.across_x + force;
        if (world.bodies.state[held[k].body].y > y) section.across_y = section.across_y + force;
    }
    return section;
}

/// Stress of the infinite lattice. Two more rows, or one more column, add exactly their own part of the section force.
struct Stress {
    double xx, yy, xy, yx;
};
Stress bulk_stress(double shear_share, const Strain& e, double& affine_error) {
    const Section small = strained(8, 9, shear_share, e);
    const Section tall = strained(8, 11, shear_share, e), wide = strained(9, 9, shear_share, e);
    affine_error = std::max({affine_error, small.affine_error, tall.affine_error, wide.affine_error});
    const Vec2 fx = (1.0 / (std::sqrt(3.0) * spacing)) * (tall.across_x - small.across_x);
    const Vec2 fy = (1.0 / spacing) * (wide.across_y - small.across_y);
    return {fx.x, fy.y, fx.y, fy.x};
}

std::vector<ClaimRow> stiffness_of_the_triangular_lattice() {
    Rows rows;
    for (const double share : {0.0, 0.25, 0.5, 1.0, 2.0}) {
        double worst = 0.0;
        const Stress along = bulk_stress(share, {1e-4, 0.0, 0.0}, worst);
        const Stress across = bulk_stress(share, {0.0, 1e-4, 0.0}, worst);
        const Stress shear = bulk_stress(share, {0.0, 0.0, 1e-4}, worst);
        const double c11 = along.xx / 1e-4, c12 = along.yy / 1e-4;
        const std::string label = fmt::format("k_s/k_n {}: ", share);
        rows.relative(label + "E/k_n", (c11 - c12 * c12 / c11) / kn,
                      2.0 * std::sqrt(3.0) * (1.0 + share) / (3.0 + share), 1e-9, "rounding");
        rows.absolute(label + "ν", c12 / c11, (1.0 - share) / (3.0 + share), 1e-9, "rounding");
        rows.relative(label + "C22/k_n", across.yy / 1e-4 / kn, std::sqrt(3.0) / 4.0 * (3.0 + share), 1e-9, "rounding");
        rows.relative(label + "C33/k_n", shear.xy / 2e-4 / kn, std::sqrt(3.0) / 4.0 * (1.0 + share), 1e-9, "rounding");
        rows.absolute(label + "difference of the two shear stress components, over C33ε",
                      (shear.xy - shear.yx) / shear.xy, 0.0, 1e-9, "rounding");
        rows.absolute(label + "difference of inner discs from the affine motion, over it", worst, 0.0, 1e-9,
                      "rounding");
    }
    return rows.take();
}

}  // namespace
}  // namespace triangular_lattice_scenes

std::vector<Claim> triangular_lattice_claims() {
    using namespace triangular_lattice_scenes;
    constexpr const char* group = "Chains and lattices";
    return {
        {.name = "stiffness_of_the_triangular_lattice",
         .group = group,
         .statement = "E = 2√3 k_n(k_n+k_s)/(3k_n+k_s), ν = (k_n-k_s)/(3k_n+k_s), C33 = (√3/4)(k_n+k_s)",
         .check = stiffness_of_the_triangular_lattice},
    };
}

}  // namespace crackle::verification
