// SPDX-License-Identifier: GPL-3.0-or-later
// The sparse solve of a bonded specimen against a dense stiffness assembled by finite differences of the force routine:
// the same springs, found twice without sharing code. Under the guide's law the stiffness is unsymmetric.

#include <Eigen/Dense>
#include <cmath>
#include <complex>

#include "solver/elastic.hpp"
#include "specimens/catalogue/disordered.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/dense_stiffness.hpp"

namespace crackle {
namespace {

using testing::rock;
using testing::within;

World bonded(Scene scene, double thick) {
    scene.intact = {true, true, true};
    World world = build_world(std::move(scene));
    bond_all(world, thick);
    return world;
}

/// Lowest and highest bodies of the specimen, pulled apart, sheared and turned.
std::vector<Prescribed> grips(const World& world) {
    double low = 1e300, high = -1e300;
    for (const BodyState& b : world.bodies) low = std::min(low, b.y), high = std::max(high, b.y);
    std::vector<Prescribed> held;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const double share = (world.bodies[b].y - low) / (high - low);
        if (share < 0.1) held.push_back({static_cast<BodyIndex>(b), {0.0, 0.0, 0.0}});
        if (share > 0.9) held.push_back({static_cast<BodyIndex>(b), {3e-6, 1e-5, 1e-4}});
    }
    return held;
}

/// Largest difference of the two solutions over the largest value, displacements and reactions together.
double difference(const World& world, double move, const char* name) {
    const auto n = static_cast<Eigen::Index>(world.bodies.size());
    const Eigen::MatrixXd stiffness = testing::dense_stiffness(world, move);
    const double asymmetry =
        (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() / stiffness.cwiseAbs().maxCoeff();
    const std::vector<Prescribed> held = grips(world);
    const ElasticSolution sparse = solve_elastic(world, held);

    std::vector<bool> free(static_cast<std::size_t>(3 * n), true);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * n);
    for (const Prescribed& p : held) {
        const auto row = 3 * static_cast<Eigen::Index>(p.body);
        u[row] = p.motion.x, u[row + 1] = p.motion.y, u[row + 2] = p.motion.rotation;
        for (Eigen::Index d = 0; d < 3; ++d) free[static_cast<std::size_t>(row + d)] = false;
    }
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = 0; k < 3 * n; ++k) {
        if (free[static_cast<std::size_t>(k)]) rows.push_back(k);
    }
    const Eigen::MatrixXd inner = stiffness(rows, rows);
    const Eigen::VectorXd load = -(stiffness * u)(rows);
    u(rows) = inner.fullPivLu().solve(load).eval();
    const Eigen::VectorXd reactions = stiffness * u;

    double worst_u = 0.0, largest_u = 0.0, worst_f = 0.0, largest_f = 0.0;
    for (Eigen::Index b = 0; b < n; ++b) {
        const Motion& s = sparse.displacement[static_cast<std::size_t>(b)];
        const double reach = world.info[static_cast<std::size_t>(b)].reach;
        const Eigen::Vector3d off{s.x - u[3 * b], s.y - u[3 * b + 1], reach * (s.rotation - u[3 * b + 2])};
        worst_u = std::max(worst_u, off.cwiseAbs().maxCoeff());
        largest_u = std::max({largest_u, std::abs(s.x), std::abs(s.y)});
    }
    for (std::size_t k = 0; k < held.size(); ++k) {
        const auto row = 3 * static_cast<Eigen::Index>(held[k].body);
        worst_f = std::max({worst_f, std::abs(sparse.reaction[k].x - reactions[row]),
                            std::abs(sparse.reaction[k].y - reactions[row + 1])});
        largest_f = std::max({largest_f, std::abs(reactions[row]), std::abs(reactions[row + 1])});
    }
    const double energy = 0.5 * u.dot(reactions);
    fmt::print(
        "  {}: {} bodies, {} bonds, asymmetry {:.2g}; displacements off by {:.3g}, reactions by {:.3g}, energy by "
        "{:.3g}\n",
        name, n, world.bonds_initial, asymmetry, worst_u / largest_u, worst_f / largest_f,
        std::abs(sparse.energy - energy) / energy);
    EXPECT_LT(std::abs(sparse.energy - energy) / energy, 1e-8);
    const bool symmetric = world.segment_law == SegmentLaw::rounded;
    EXPECT_EQ(asymmetry < 1e-8, symmetric);
    return std::max(worst_u / largest_u, worst_f / largest_f);
}

TEST(SparseSolve, AgreesWithADenseStiffnessFromTheForceRoutineForDiscs) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        DisorderedDiscs request;
        request.columns = 7, request.rows = 8, request.mean_overlap = 2e-4, request.shake = 1e-4, request.seed = seed;
        const World world = bonded(disordered_discs(request, rock()), 0.0);
        EXPECT_LT(difference(world, 2e-5, "discs"), 1e-8);
    }
}

TEST(SparseSolve, AgreesWithADenseStiffnessFromTheForceRoutineForPolygons) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        ShakenCells request;
        request.columns = 4, request.rows = 5, request.seed = seed;
        const World world = bonded(shaken_cells(request, rock()), 1.08e-3);
        EXPECT_LT(difference(world, 1e-7, "polygons"), 1e-8);
    }
}

TEST(SparseSolve, AgreesWithADenseStiffnessFromTheForceRoutineForDiscsOnAPlaten) {
    DisorderedDiscs request;
    request.columns = 6, request.rows = 5, request.mean_overlap = 2e-4;
    Scene scene = disordered_discs(request, rock());
    scene.thick = 1e-3;
    scene.add_chain_body(1000, 0, {{-0.05, -0.0208}, {0.3, -0.0208}}, false);
    scene.add_chain_body(1001, 0, {{-0.05, 0.1588}, {0.3, 0.1588}, {0.4, 0.2}}, false);
    const World world = bonded(scene, 1e-3);
    EXPECT_LT(difference(world, 1e-5, "discs between segments"), 1e-8);
}

ShakenCells small_grid(std::uint64_t seed) {
    ShakenCells request;
    request.columns = 4, request.rows = 5, request.seed = seed;
    return request;
}

TEST(SparseSolve, AgreesWithADenseStiffnessFromTheForceRoutineUnderTheGuidesLaw) {
    for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            Scene scene = shaken_cells(small_grid(seed), rock());
            scene.segment_law = law;
            EXPECT_LT(difference(bonded(scene, 1.08e-3), 1e-8, "polygons, guide's law"), 1e-7);
        }
    }
}

TEST(StableStep, LiesBelowTheLimitOfTheUnsymmetricStiffnessUnderTheGuidesLaw) {
    for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            Scene scene = shaken_cells(small_grid(seed), rock());
            scene.segment_law = law;
            World world = bonded(scene, 1.08e-3);
            const Eigen::MatrixXd stiffness = testing::dense_stiffness(world, 1e-8);
            Eigen::VectorXd inverse(stiffness.rows());
            for (std::size_t b = 0; b < world.bodies.size(); ++b) {
                const BodyInertia& inertia = world.inertia[b];
                inverse.segment<3>(3 * static_cast<Eigen::Index>(b)) << inertia.inverse_mass_x, inertia.inverse_mass_y,
                    inertia.inverse_moment;
            }
            const Eigen::EigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * stiffness, false);
            double largest = 0.0, aside = 0.0, lowest = 0.0;
            for (const std::complex<double>& value : solver.eigenvalues()) {
                largest = std::max(largest, std::abs(value));
                aside = std::max(aside, std::abs(value.imag()));
                lowest = std::min(lowest, value.real());
            }
            const double limit = 2.0 / std::sqrt(largest);
            fmt::print(
                "  {} bonds: limit {:.4g} s, bound {:.4g} s ({:.3f} of it); largest imaginary part {:.2g} of the "
                "largest "
                "eigenvalue, lowest real part {:.2g}\n",
                world.bonds_initial, limit, world.step_bound, world.step_bound / limit, aside / largest,
                lowest / largest);
            EXPECT_LE(world.step_bound, limit);
            EXPECT_GT(world.step_bound, 0.4 * limit);
            EXPECT_GT(lowest, -1e-6 * largest);
        }
    }
}

}  // namespace
}  // namespace crackle
