// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the exact stable step against dense matrices from finite differences of the force routine. Also checks it
// against runs of bonded specimens between platens just below and just above it.
// Tested by tests/verification/claims_test.cpp.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>

#include "solver/linear/critical_step.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/disordered.hpp"
#include "specimens/making/lattices.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/between_platens.hpp"
#include "tests/bench/verify/scenes/dense_stiffness.hpp"
#include "tests/bench/verify/scenes/packed_case.hpp"
#include "tests/bench/verify/scenes/step_limit.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

/// Bonds are unbreakable, since finite differences move the bodies.
World bonded(Scene scene, double thick) {
    scene.intact = {true, true, true};
    World world = build_world(std::move(scene));
    bond_all(world, thick);
    return at_rest(std::move(world));
}

Material damped(double ratio) {
    Material material = rock();
    material.damping_ratio = ratio;
    return material;
}

/// Every other body has a second material with much more damping, so that K and C have no common modes.
Scene unevenly_damped(Scene scene) {
    scene.materials = {damped(0.05), damped(0.6)};
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) scene.bodies[b].material = static_cast<int>(b % 2);
    return scene;
}

Scene few_discs() {
    DisorderedDiscs discs;
    discs.columns = 6, discs.rows = 6, discs.mean_overlap = 2e-4, discs.shake = 1e-4;
    return disordered_discs(discs, rock());
}

Scene few_cells(std::uint64_t seed = 1) {
    ShakenCells cells;
    cells.columns = 4, cells.rows = 5, cells.seed = seed;
    return shaken_cells(cells, rock());
}

/// C = -∂F/∂v at rest; the force is linear in v.
Eigen::MatrixXd dense_damping(const World& rest) {
    const auto rows = 3 * static_cast<Eigen::Index>(rest.bodies.size());
    Eigen::MatrixXd damping(rows, rows);
    for (Eigen::Index c = 0; c < rows; ++c) {
        World world = rest;
        BodyState& body = world.bodies.state[static_cast<std::size_t>(c / 3)];
        (c % 3 == 0 ? body.vx : c % 3 == 1 ? body.vy : body.omega) = 1e-6;
        compute_forces(world);
        for (Eigen::Index b = 0; b < rows / 3; ++b) {
            const BodyForce& force = world.bodies.force[static_cast<std::size_t>(b)];
            damping.col(c).segment<3>(3 * b) << -1e6 * force.fx, -1e6 * force.fy, -1e6 * force.torque;
        }
    }
    return damping;
}

Eigen::VectorXd inverse_masses(const World& world) {
    Eigen::VectorXd inverse(3 * static_cast<Eigen::Index>(world.bodies.size()));
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const BodyInertia& inertia = world.bodies.inertia[b];
        inverse.segment<3>(3 * static_cast<Eigen::Index>(b)) << inertia.inverse_mass_x, inertia.inverse_mass_y,
            inertia.inverse_moment;
    }
    return inverse;
}

/// Stiffness and damping over mass, from the force routine alone.
struct Dense {
    Eigen::MatrixXd stiffness, damping;
};
Dense dense_of(const World& rest, double move) {
    World undamped = rest;
    for (ContactLaw& law : undamped.settings.laws) {
        law.normal_damping = law.shear_damping = 0.0;
        law.normal_damping_ratio_term = law.shear_damping_ratio_term = 0.0;
    }
    const Eigen::VectorXd inverse = inverse_masses(rest);
    return {inverse.asDiagonal() * dense_stiffness(undamped, move), inverse.asDiagonal() * dense_damping(rest)};
}

/// Step at which 4 - 2Δt C - Δt² K becomes singular: 1/s, where s is the largest real root of s² - sC/2 - K/4.
double dense_limit(const Dense& dense) {
    const Eigen::Index n = dense.stiffness.rows();
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    companion << 0.5 * dense.damping, 0.25 * dense.stiffness, Eigen::MatrixXd::Identity(n, n),
        Eigen::MatrixXd::Zero(n, n);
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
    return 1.0 / solver.eigenvalues().real().maxCoeff();
}

/// Spectral radius of one leapfrog step, v' = v - Δt(Kx + Cv), x' = x + Δt v'.
double dense_growth(const Dense& dense, double dt) {
    const Eigen::Index n = dense.stiffness.rows();
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd kept = one - dt * dense.damping;
    Eigen::MatrixXd step(2 * n, 2 * n);
    step << kept, -dt * dense.stiffness, dt * kept, one - dt * dt * dense.stiffness;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(step, false);
    return solver.eigenvalues().cwiseAbs().maxCoeff();
}

std::vector<ClaimRow> exact_step_is_that_of_a_dense_matrix() {
    Rows rows;
    const auto check = [&](const std::string& name, const World& rest, double move) {
        const Dense dense = dense_of(rest, move);
        const double root = critical_step(rest, ClosedPoints::touching).root;
        rows.relative(name + ": exact step, s", root, dense_limit(dense), 1e-8, "finite differences");
        // Growth above 1 varies as the root of the distance from the limit, which magnifies its errors by 1/√0.01.
        rows.relative(name + ": growth a step at 1.01 of it, less 1",
                      growth_per_step(rest, ClosedPoints::touching, 1.01 * root) - 1.0,
                      dense_growth(dense, 1.01 * root) - 1.0, 1e-6, "finite differences");
        rows.absolute(name + ": spectral radius at 0.99 of it", dense_growth(dense, 0.99 * root), 1.0, 1e-4,
                      "rigid motion is a double root, √1e-8");
    };
    const World apart = build_world(disc_chain(20, 0.02, 0.041, rock()));  // listed, but not in contact
    rows.at_least("discs apart: exact step, s", critical_step(apart, ClosedPoints::touching).root,
                  std::numeric_limits<double>::infinity(), "no stiffness");
    check("triangular lattice", bonded(triangular_lattice(5, 5, 0.02, 2e-4, rock(45.0)), 0.0), 2e-5);
    check("discs", bonded(few_discs(), 0.0), 2e-5);
    check("discs of two dampings", bonded(unevenly_damped(few_discs()), 0.0), 2e-5);
    check("polygons", bonded(few_cells(), 1.08e-3), 1e-7);
    check("polygons of two dampings", bonded(unevenly_damped(few_cells()), 1.08e-3), 1e-7);
    return rows.take();
}

std::vector<ClaimRow> exact_step_of_specimens_between_platens() {
    Rows rows;
    for (const auto kind : {SpecimenKind::circles, SpecimenKind::delaunay, SpecimenKind::voronoi}) {
        ResolvedCase description = packed_case(1, LoadingKind::compression, 0.01, 0.01);
        if (kind != SpecimenKind::circles) {
            mesh_voronoi(description);
            description.mesh->kind = from_name<MeshKind>(name_of(kind)).value();
        }
        const std::string name = kind == SpecimenKind::circles    ? "circles"
                                 : kind == SpecimenKind::delaunay ? "Delaunay triangles"
                                                                  : "Voronoi cells";
        check_step_limit(rows, name, at_rest(prepare_test(description).world));
    }
    return rows.take();
}

std::vector<ClaimRow> exact_step_where_materials_are_damped_unevenly() {
    Rows rows;
    check_step_limit(rows, "discs", bonded(unevenly_damped(few_discs()), 0.0));
    check_step_limit(rows, "polygons", bonded(unevenly_damped(few_cells()), 1.08e-3));
    return rows.take();
}

std::vector<ClaimRow> bound_under_the_guides_law_lies_below_the_limit_of_its_unsymmetric_stiffness() {
    Rows rows;
    for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            Scene scene = few_cells(seed);
            scene.segment_law = law;
            const World world = bonded(std::move(scene), 1.08e-3);
            const Eigen::MatrixXd over_mass = inverse_masses(world).asDiagonal() * dense_stiffness(world, 1e-8);
            const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(over_mass, false).eigenvalues();
            const double largest = values.cwiseAbs().maxCoeff(), limit = 2.0 / std::sqrt(largest);
            const std::string name =
                std::string(law == SegmentLaw::demseg ? "sum" : "mean") + ", seed " + std::to_string(seed);
            rows.at_most(name + ": the engine's bound over the limit", world.stepping.step_bound / limit, 1.0,
                         "a bound");
            rows.at_least(name + ": the same, from below", world.stepping.step_bound / limit, 0.4, "of use");
            rows.at_least(name + ": lowest real part over the largest eigenvalue", values.real().minCoeff() / largest,
                          -1e-6, "finite differences");
            rows.shown(name + ": largest imaginary part over it", values.imag().maxCoeff() / largest);
        }
    }
    return rows.take();
}

}  // namespace

std::vector<Claim> exact_step_claims() {
    constexpr const char* group = "Critical step";
    return {
        {.name = "exact_step_is_that_of_a_dense_matrix",
         .group = group,
         .statement = "critical_step() is the step at which 4M - 2Δt·C - Δt²·K becomes singular, and growth_per_step() "
                      "the spectral radius of a step; K and C are computed by finite differences of the forces",
         .check = exact_step_is_that_of_a_dense_matrix},
        {.name = "exact_step_of_specimens_between_platens",
         .group = group,
         .statement = "at 0.99 of the exact step random velocities stay bounded; at 1.01 its mode grows as predicted",
         .check = exact_step_of_specimens_between_platens,
         .note = "H = ½v(M - Δt C/2 - Δt²K/4)v + ½x̄Kx̄ never grows. At 0.99 the matrix is at least M/100, so the sum of "
                 "kinetic and strain energy stays below 100 H + 121 H."},
        {.name = "exact_step_where_materials_are_damped_unevenly",
         .group = group,
         .statement = "the exact step, with damping ratios of 0.05 and 0.6 in one specimen",
         .check = exact_step_where_materials_are_damped_unevenly},
        {.name = "bound_under_the_guides_law_lies_below_the_limit_of_its_unsymmetric_stiffness",
         .group = group,
         .statement = "step bound ≤ 2/√max|λ(M⁻¹K)|, with K by finite differences of the force routine",
         .check = bound_under_the_guides_law_lies_below_the_limit_of_its_unsymmetric_stiffness},
    };
}

}  // namespace crackle::verification
