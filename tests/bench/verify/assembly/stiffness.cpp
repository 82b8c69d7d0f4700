// SPDX-License-Identifier: GPL-3.0-or-later
// Small-strain stiffness of a specimen: the sparse solve is compared with slow runs and with the affine bound.
// Tested by tests/verification/claims_test.cpp.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/linear/elastic.hpp"
#include "solver/measure/point_view.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/build_world.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/making/disordered.hpp"
#include "tests/bench/verify/groups.hpp"
#include "tests/bench/verify/rows.hpp"
#include "tests/bench/verify/scenes/between_platens.hpp"
#include "tests/bench/verify/scenes/dense_stiffness.hpp"
#include "tests/bench/verify/scenes/packed_case.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"

namespace crackle::verification {
namespace {

/// Force on the platens divided by the displacement of the upper one, N/m.
struct Stiffness {
    double solved, run;
    std::int64_t broken;
};
Stiffness stiffness_of(Kind kind, double sense, double strain, double duration) {
    const double height = between_platens(kind, 0.0, {true, true, true}).height;
    LoadedSpecimen loaded = between_platens(kind, sense * strain * height / duration, {true, true, true});
    World& world = loaded.world;
    const ElasticSolution solution =
        solve_elastic(world, {{loaded.low, {0.0, 0.0, 0.0}}, {loaded.high, {0.0, 1.0, 0.0}}});
    // Mean force of both platens during the last fifth of the run, divided by the mean displacement during that time.
    const double start = world.bodies.state[loaded.high].y;
    double force = 0.0, way = 0.0;
    while (world.stepping.time < duration) {
        compute_forces(world);
        if (world.stepping.time > 0.8 * duration) {
            force += 0.5 * (world.bodies.force[loaded.low].fy - world.bodies.force[loaded.high].fy);
            way += world.bodies.state[loaded.high].y - start;
        }
        advance(world);
    }
    return {solution.reaction[1].y, force / way, world.bonds.broken};
}

std::vector<ClaimRow> slow_run_measures_the_stiffness_of_the_sparse_solve() {
    Rows rows;
    // Half a second is many times the transit time of a wave, about 0.01 s.
    for (const Kind kind : {Kind::discs, Kind::polygons}) {
        for (const double sense : {-1.0, 1.0}) {
            const Stiffness got = stiffness_of(kind, sense, 1e-4, 0.5);
            const std::string name = fmt::format("{} {}", name_of(kind), sense > 0.0 ? "pulled" : "squeezed");
            rows.relative(name + ", strain 1e-4: platen force over displacement, N/m", got.run, got.solved, 5e-3,
                          "reference");
            rows.exactly(name + ": bonds broken", static_cast<double>(got.broken), 0.0);
        }
    }
    for (const double sense : {-1.0, 1.0}) {
        // At ten times the strain at which bonds would break, the intact specimen is still linear, apart from its
        // change of shape.
        const Stiffness got = stiffness_of(Kind::discs, sense, 1e-2, 0.5);
        rows.relative(fmt::format("discs {}, strain 1e-2: platen force over displacement, N/m",
                                  sense > 0.0 ? "pulled" : "squeezed"),
                      got.run, got.solved, 1e-2, "change of shape");
    }
    return rows.take();
}

std::vector<ClaimRow> intact_test_has_the_moduli_of_the_sparse_solve() {
    Rows rows;
    for (const bool meshed : {false, true}) {
        for (const LoadingKind kind : {LoadingKind::tension, LoadingKind::compression}) {
            ResolvedCase description = packed_case(1, kind, 0.002, 1e-4);  // a small strain; the solve is linear
            if (meshed) mesh_voronoi(description);
            description.numerics.intact = true;
            VirtualTest test = prepare_test(description);
            load_specimen(test);
            // Measured over the upper half of the strain, after the motion caused by the start of loading has died
            // away.
            const CurveRow &half = test.state.rows[test.state.rows.size() / 2], &last = test.state.rows.back();
            const double strain = last.axial_strain - half.axial_strain;
            const double lateral = (last.lateral_strain - half.lateral_strain) / strain;
            const std::string name = fmt::format("{} in {}", meshed ? "Voronoi cells" : "circles", name_of(kind));
            rows.relative(name + ": E, N/m", (last.axial_stress - half.axial_stress) / strain,
                          test.state.youngs_modulus, 5e-3, "reference");
            rows.relative(name + ": ν", test.setup.apparatus.compression ? lateral : -lateral,
                          test.state.poissons_ratio, 1e-2, "a difference");
        }
    }
    return rows.take();
}

/// Prescribes motion of the specimen's lowest and highest bodies, which are pulled apart, sheared and rotated.
std::vector<Prescribed> grips(const World& world) {
    double low = 1e300, high = -1e300;
    for (const BodyState& b : world.bodies.state) low = std::min(low, b.y), high = std::max(high, b.y);
    std::vector<Prescribed> held;
    for (std::size_t b = 0; b < world.bodies.size(); ++b) {
        const double share = (world.bodies.state[b].y - low) / (high - low);
        if (share < 0.1) held.push_back({static_cast<BodyIndex>(b), {0.0, 0.0, 0.0}});
        if (share > 0.9) held.push_back({static_cast<BodyIndex>(b), {3e-6, 1e-5, 1e-4}});
    }
    return held;
}

/// Compares the sparse solve with a dense stiffness from finite differences of the force routine. Rows: largest
/// relative differences of displacements and reactions, energies, and the dense matrix's asymmetry.
void compare_with_dense(Rows& rows, const std::string& name, Scene scene, double thick, double move) {
    scene.intact = {true, true, true};
    const bool symmetric = scene.segment_law == SegmentLaw::rounded;
    World world = build_world(std::move(scene));
    bond_all(world, thick);
    const auto n = static_cast<Eigen::Index>(world.bodies.size());
    const Eigen::MatrixXd stiffness = dense_stiffness(world, move);
    const std::vector<Prescribed> held = grips(world);
    const ElasticSolution sparse = solve_elastic(world, held);

    std::vector<bool> free(static_cast<std::size_t>(3 * n), true);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * n);
    for (const Prescribed& p : held) {
        const auto row = 3 * static_cast<Eigen::Index>(p.body);
        u[row] = p.motion.x, u[row + 1] = p.motion.y, u[row + 2] = p.motion.rotation;
        for (Eigen::Index d = 0; d < 3; ++d) free[static_cast<std::size_t>(row + d)] = false;
    }
    std::vector<Eigen::Index> unknown;
    for (Eigen::Index k = 0; k < 3 * n; ++k) {
        if (free[static_cast<std::size_t>(k)]) unknown.push_back(k);
    }
    const Eigen::MatrixXd inner = stiffness(unknown, unknown);
    const Eigen::VectorXd load = -(stiffness * u)(unknown);
    u(unknown) = inner.fullPivLu().solve(load).eval();
    const Eigen::VectorXd reactions = stiffness * u;

    double worst_u = 0.0, largest_u = 0.0, worst_f = 0.0, largest_f = 0.0;
    for (Eigen::Index b = 0; b < n; ++b) {
        const BodyMotion& s = sparse.displacement[static_cast<std::size_t>(b)];
        const double reach = world.bodies.info(static_cast<std::size_t>(b)).reach;
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
    // Central differences with Richardson extrapolation have an error of fourth order in the move, plus round-off
    // divided by the move. Under the guide's law the move must stay within one branch of the law, so it is a tenth of
    // the move for other polygons.
    const double tolerance = symmetric ? 1e-8 : 1e-7;
    rows.absolute(name + ": error of displacements, over the largest", worst_u / largest_u, 0.0, tolerance,
                  "finite differences");
    rows.absolute(name + ": error of reactions, over the largest", worst_f / largest_f, 0.0, tolerance,
                  "finite differences");
    rows.relative(name + ": energy, J", sparse.energy, 0.5 * u.dot(reactions), tolerance, "finite differences");
    const double asymmetry =
        (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() / stiffness.cwiseAbs().maxCoeff();
    const std::string label = name + ": asymmetry of the force routine's stiffness, over its largest entry";
    if (symmetric) {
        rows.absolute(label, asymmetry, 0.0, tolerance, "finite differences");
    } else {
        rows.at_least(label, asymmetry, 1e-3, "δ is no potential");
    }
}

std::vector<ClaimRow> sparse_solve_is_that_of_the_force_routine() {
    Rows rows;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        DisorderedDiscs discs;
        discs.columns = 7, discs.rows = 8, discs.mean_overlap = 2e-4, discs.shake = 1e-4, discs.seed = seed;
        compare_with_dense(rows, fmt::format("discs {}", seed), disordered_discs(discs, rock()), 0.0, 2e-5);
        ShakenCells cells;
        cells.columns = 4, cells.rows = 5, cells.seed = seed;
        compare_with_dense(rows, fmt::format("polygons {}", seed), shaken_cells(cells, rock()), 1.08e-3, 1e-7);
    }
    DisorderedDiscs discs;
    discs.columns = 6, discs.rows = 5, discs.mean_overlap = 2e-4;
    Scene scene = disordered_discs(discs, rock());
    scene.thick = 1e-3;
    scene.add_chain_body(1000, 0, {{-0.05, -0.0208}, {0.3, -0.0208}}, false);
    scene.add_chain_body(1001, 0, {{-0.05, 0.1588}, {0.3, 0.1588}, {0.4, 0.2}}, false);
    compare_with_dense(rows, "discs between segments", std::move(scene), 1e-3, 1e-5);
    return rows.take();
}

std::vector<ClaimRow> sparse_solve_is_that_of_the_force_routine_under_the_guides_law() {
    Rows rows;
    for (const SegmentLaw law : {SegmentLaw::demseg, SegmentLaw::demseg_mean}) {
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            ShakenCells cells;
            cells.columns = 4, cells.rows = 5, cells.seed = seed;
            Scene scene = shaken_cells(cells, rock());
            scene.segment_law = law;
            const char* name = law == SegmentLaw::demseg ? "sum" : "mean";
            compare_with_dense(rows, fmt::format("{}, polygons {}", name, seed), std::move(scene), 1.08e-3, 1e-8);
        }
    }
    return rows.take();
}

/// The least energy of u = (a x, ε y) without rotation, summed over all bonds and expressed as a modulus. With the
/// platens at their positions (held laterally) this motion is admissible, so the true energy is lower for any fabric. x
/// is measured from the domain's middle.
double affine_modulus(const VirtualTest& test) {
    const World& world = test.world;
    const auto face = [&](BodyIndex platen) { return element_positions(world, platen)[0].y; };
    const auto place = [&](BodyIndex b) {
        if (test.setup.apparatus.is_platen(b)) return Vec2{0.0, face(b)};
        return Vec2{world.bodies.state[b].x - world.bodies.state[test.setup.apparatus.bottom].x,
                    world.bodies.state[b].y};
    };
    double aa = 0.0, ae = 0.0, ee = 0.0;  // energy ½(aa a² + 2 ae aε + ee ε²)
    for (PointIndex k = 0; k < world.points.size(); ++k) {
        const PointView view = view_point(world, k);
        if (!view.bonded) continue;
        const Vec2 between = place(view.body_i) - place(view.body_j), tangent = perpendicular(view.normal);
        const Vec2 x{between.x, 0.0}, y{0.0, between.y};
        const auto add = [&](double stiffness, Vec2 direction) {
            aa += stiffness * dot(x, direction) * dot(x, direction);
            ae += stiffness * dot(x, direction) * dot(y, direction);
            ee += stiffness * dot(y, direction) * dot(y, direction);
        };
        add(view.normal_stiffness, view.normal);
        add(view.shear_stiffness, tangent);
    }
    const double twice_energy = ee - ae * ae / aa,
                 rise = face(test.setup.apparatus.top) - face(test.setup.apparatus.bottom);
    // The energy is ½ R D with R = E W D/H.
    return twice_energy * test.setup.specimen.height / (test.setup.specimen.width * rise * rise);
}

/// The affine modulus of an isotropic fabric away from boundaries: M k_n(k_n+k_s)/(3k_n+k_s), M = Σl²/A over bonds of
/// discs.
double isotropic_modulus(const VirtualTest& test) {
    double sum = 0.0, kn = 0.0, ks = 0.0;
    for (PointIndex k = 0; k < test.world.points.size(); ++k) {
        const PointView view = view_point(test.world, k);
        if (!view.bonded || view.kind != PointKind::circle_circle) continue;
        const BodyState &i = test.world.bodies.state[view.body_i], &j = test.world.bodies.state[view.body_j];
        sum += (i.x - j.x) * (i.x - j.x) + (i.y - j.y) * (i.y - j.y);
        kn = view.normal_stiffness, ks = view.shear_stiffness;
    }
    return sum / (test.setup.specimen.width * test.setup.specimen.height) * kn * (kn + ks) / (3.0 * kn + ks);
}

std::vector<ClaimRow> modulus_lies_below_the_affine_bound() {
    Rows rows;
    double mean = 0.0, mean_isotropic = 0.0;
    constexpr int packings = 20;
    for (int seed = 1; seed <= packings; ++seed) {
        const VirtualTest test = prepare_test(packed_case(seed, LoadingKind::tension, 0.01, 0.01));
        const double ratio = test.state.youngs_modulus / affine_modulus(test);
        mean += ratio / packings;
        mean_isotropic += test.state.youngs_modulus / isotropic_modulus(test) / packings;
        rows.at_most(fmt::format("packing {}: E over its affine bound", seed), ratio, 1.0, "rigorous");
    }
    rows.shown("mean ratio", mean);
    rows.shown("mean ratio to the isotropic bulk value M k_n(k_n+k_s)/(3k_n+k_s), M = Σl²/A", mean_isotropic);
    return rows.take();
}

}  // namespace

std::vector<Claim> stiffness_claims() {
    constexpr const char* group = "Specimens";
    return {
        {.name = "sparse_solve_is_that_of_the_force_routine",
         .group = group,
         .statement = "K u = f for the specimen's bonds and platens is exact: finite differences of the forces in a "
                      "step give the same springs",
         .check = sparse_solve_is_that_of_the_force_routine},
        {.name = "sparse_solve_is_that_of_the_force_routine_under_the_guides_law",
         .group = group,
         .statement = "K u = f with the unsymmetric stiffness k b ∇δᵀ of the guide's law for segments",
         .check = sparse_solve_is_that_of_the_force_routine_under_the_guides_law},
        {.name = "intact_test_has_the_moduli_of_the_sparse_solve",
         .group = group,
         .statement = "E and ν of a slow virtual test with intact bonds are those of the sparse solve",
         .check = intact_test_has_the_moduli_of_the_sparse_solve},
        {.name = "slow_run_measures_the_stiffness_of_the_sparse_solve",
         .group = group,
         .statement = "if bonds neither break nor slip, the stiffness in a slow run (platen force over displacement) "
                      "is that of the sparse solve",
         .check = slow_run_measures_the_stiffness_of_the_sparse_solve},
        {.name = "modulus_lies_below_the_affine_bound",
         .group = group,
         .statement = "E ≤ the minimum over a of the energy of u = (a x, ε y) without rotation, including platen bonds",
         .check = modulus_lies_below_the_affine_bound,
         .note = "Packings of 120 circles between bonded platens. Any admissible motion stores at least the true "
                 "energy, so no tolerance is needed."},
    };
}

}  // namespace crackle::verification
