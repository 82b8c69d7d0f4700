// SPDX-License-Identifier: GPL-3.0-or-later
// Steps with faces: energy closes while faces break, never grows without damping, and no byte depends on the number of
// threads or on a restart.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/faces/face_pass.hpp"
#include "solver/linear/critical_step.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/stepping/bonding.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "solver/stepping/time_step.hpp"
#include "solver/world/checkpoint.hpp"
#include "tests/solver/faces/cell_worlds.hpp"
#include "tests/support/claim.hpp"

namespace crackle::face_test {
namespace {

using testing::agrees;
using testing::within;

struct Specimen {
    CellWorld cells;

    World& world() { return cells.world; }
    Faces& faces() { return cells.world.faces; }
    void step() { crackle::step(cells.world); }
    Ledger ledger() {
        compute_forces(cells.world);
        const Ledger ledger = measure_ledger(cells.world);
        advance(cells.world);
        return ledger;
    }
    double exact_step() { return critical_step(cells.world, ClosedPoints::touching).root; }
};

/// Strengths as of a rock whose Young's modulus is 1.
FaceLaw brittle() {
    FaceLaw law;
    law.tensile_strength = 1e-4;
    law.cohesion = 4e-4;
    law.friction = 1.2;
    law.moment_share = 0.6;
    law.residual_friction = 0.3;
    return law;
}

Specimen specimen(const CellBox& box, double ratio, const FaceLaw& law, double nu = 0.26,
                  PlatenFaces platens = PlatenFaces::glued) {
    Specimen s{build_box(box)};
    FaceBonding bonding = elastic_rock(s.cells, box.gap, nu, ratio);
    bonding.materials[0].law = law;
    bonding.platens = platens;
    if (box.kind == MeshKind::delaunay) bonding.reference.clear();
    bonding.factors = StrengthFactors(StrengthDistribution::weibull, 0.2, 1);
    bond_by_faces(s.cells.world, bonding);
    return s;
}

void drive(Specimen& s, double velocity) {
    const DofControl still{Drive::velocity, 0.0, 0.0}, moving{Drive::velocity, velocity, 0.0};
    set_control(s.world(), s.cells.platens[0], {still, still, still}, 0);
    set_control(s.world(), s.cells.platens[1], {still, moving, still}, 0);
}

TEST(StepWithFaces, IsStableJustBelowTheExactStepAndUnstableJustAbove) {
    for (const double share : {0.99, 1.01}) {
        Specimen s = specimen({.columns = 6, .rows = 6}, 1.0 / 1.6, {});
        s.world().stepping.time_step = share * s.exact_step();
        std::mt19937 random(5);
        for (BodyState& body : s.world().bodies.state) body.vx = 1e-9 * static_cast<double>(random() % 100);
        s.step();
        const double before = s.ledger().kinetic;
        for (int n = 0; n < 2000; ++n) s.step();
        const double growth = s.ledger().kinetic / before;
        if (share < 1.0) {
            EXPECT_LT(growth, 100.0);
        } else {
            EXPECT_GT(growth, 1e6);
        }
    }
}

/// Loads a box until a share of its faces is broken. @return the largest closing error, of the work done
double load(Specimen& s, double velocity, double broken, double step_share = 0.3) {
    s.world().stepping.time_step = step_share * s.exact_step();
    drive(s, velocity);
    double worst = 0.0;
    for (int n = 0; n < 200'000; ++n) {
        if (n % 100 != 0) {
            s.step();
            continue;
        }
        const Ledger ledger = s.ledger();
        if (ledger.displacement_work > 0.0)
            worst = std::max(worst, std::abs(ledger.closing_error) / ledger.displacement_work);
        if (static_cast<double>(s.faces().broken.size()) > broken * static_cast<double>(s.faces().size())) break;
    }
    EXPECT_GT(static_cast<double>(s.faces().broken.size()), broken * static_cast<double>(s.faces().size()));
    return worst;
}

TEST(StepWithFaces, ClosesItsEnergyAccountWhileFacesBreak) {
    for (const double velocity : {-2e-4, 4e-5}) {
        FaceLaw law = brittle();
        law.damping_ratio = 0.1;
        Specimen s = specimen({.columns = 8, .rows = 8, .platens = true}, 1.0 / 1.6, law);
        const double error = load(s, velocity, 0.1);
        EXPECT_TRUE(within("largest closing error, of the work", error, 0.0, 5e-4));
        double least = 0.0, most = 0.0;
        for (const BreakEvent& one : s.world().bonds.events)
            least = std::min(least, one.energy), most = std::max(most, one.energy);
        EXPECT_TRUE(within("least energy of a break, of the largest", least / most, 0.0, 1e-12));
        EXPECT_GT(s.world().account.dashpot_loss, 0.0);
        fmt::print("  losses: fracture {:.3g}, friction {:.3g}, dashpots {:.3g}, lag {:.3g} of work {:.3g} J\n",
                   s.world().account.fracture_loss, s.world().account.friction_loss, s.world().account.dashpot_loss,
                   s.faces().lag_loss, s.world().account.displacement_work);
    }
}

/// Breaks a fifth of the faces, then shakes the specimen without damping between platens at rest. @return largest
/// energy over that at the start, less 1
double shake(Specimen s, int steps) {
    load(s, -2e-4, 0.2);
    for (FaceLaw& law : s.faces().laws) law.tensile_strength = law.cohesion = std::numeric_limits<double>::infinity();
    const std::size_t broken = s.faces().broken.size();
    // Contact points lower the step where they take over from faces.
    s.world().stepping.automatic_step = true;
    s.world().stepping.step_goal = 0.8 * s.exact_step();
    drive(s, 0.0);
    s.step();
    restart_account(s.world());
    const Ledger first = s.ledger();
    const double start = first.kinetic + first.strain;
    double largest = start;
    for (int n = 0; n < steps; ++n) {
        if (n % 50 != 0) {
            s.step();
            continue;
        }
        const Ledger now = s.ledger();
        largest = std::max(largest, now.kinetic + now.strain);
    }
    EXPECT_EQ(s.faces().broken.size(), broken);
    const Ledger last = s.ledger();
    EXPECT_LT(last.kinetic + last.strain, start);
    EXPECT_TRUE(within("closing error, of the energy", last.closing_error / start, 0.0, 0.02));
    fmt::print("  energy {:.4g} -> {:.4g} J; friction {:.3g}, lag {:.3g}\n", start, last.kinetic + last.strain,
               last.friction_loss, last.law_loss);
    return largest / start - 1.0;
}

TEST(StepWithFaces, GainsNoEnergyOver100000StepsIfPartlyBroken) {
    const Specimen voronoi = specimen({.columns = 8, .rows = 8, .platens = true}, 1.0 / 1.6, brittle());
    EXPECT_TRUE(within("Voronoi: largest energy over the first, less 1", shake(voronoi, 100'000), 0.0, 2e-3));
}

TEST(StepWithFaces, GainsNoEnergyWhereTheLagMustBeSlowed) {
    const Specimen triangles = specimen(
        // Corners meet at nodes, where points need a gap that is wide compared with the motion.
        {.kind = MeshKind::delaunay, .columns = 6, .rows = 6, .lloyd = 20, .gap = 4e-3, .platens = true}, 1.0 / 1.6,
        brittle());
    EXPECT_TRUE(within("triangles: largest energy over the first, less 1", shake(triangles, 20'000), 0.0, 2e-3));
    const Specimen soft = specimen({.columns = 8, .rows = 8, .platens = true}, 1.0, brittle(), 0.45);
    EXPECT_TRUE(within("nu = 0.45: largest energy over the first, less 1", shake(soft, 20'000), 0.0, 2e-3));
}

TEST(StepWithFaces, RubsOnAPlatenWithItsFriction) {
    CellBox box{.columns = 4, .rows = 4, .platens = true};
    Specimen s{build_box(box)};
    FaceBonding bonding = elastic_rock(s.cells, box.gap, 0.26, 1.0);
    bonding.platens = PlatenFaces::rubbing;
    bonding.platen_friction = 0.4;
    bonding.materials[0].law.damping_ratio = 0.2;
    bond_by_faces(s.cells.world, bonding);
    s.world().stepping.time_step = 0.4 * s.exact_step();
    const double stroke = 1e-4 / (2000 * s.world().stepping.time_step);
    drive(s, -stroke);
    for (int n = 0; n < 2000; ++n) s.step();
    // The upper platen then moves along the box, which sticks to the lower one at first.
    const DofControl still{Drive::velocity, 0.0, 0.0}, along{Drive::velocity, 0.5 * stroke, 0.0};
    set_control(s.world(), s.cells.platens[1], {along, still, still}, 0);
    for (int n = 0; n < 20'000; ++n) s.step();
    compute_forces(s.world());
    const BodyForce& on_platen = s.world().bodies.force[s.cells.platens[1]];
    EXPECT_GT(on_platen.fy, 0.5e-4);
    EXPECT_TRUE(agrees("shear over normal force", -on_platen.fx / on_platen.fy, 0.4, 1e-2));
    const Ledger ledger = measure_ledger(s.world());
    EXPECT_TRUE(within("closing error, of the work", ledger.closing_error / ledger.displacement_work, 0.0, 5e-4));
}

TEST(StepWithFaces, RunsToTheModulusOfTheSolve) {
    // Loads that rise slowly to a strain and rest there, with dashpots that end the vibration.
    FaceLaw law;
    law.damping_ratio = 0.3;
    Specimen s = specimen({.columns = 6, .rows = 6, .platens = true}, 1.0, law, 0.26, PlatenFaces::smooth);
    s.world().stepping.time_step = 0.5 * s.exact_step();
    const double strain = 1e-5;
    constexpr int ramp = 4000;
    drive(s, -strain / (ramp * s.world().stepping.time_step));
    for (int n = 0; n < ramp; ++n) s.step();
    drive(s, 0.0);
    for (int n = 0; n < 6000; ++n) s.step();
    compute_forces(s.world());
    const double stress = s.world().bodies.force[s.cells.platens[1]].fy;
    EXPECT_TRUE(agrees("Young's modulus", stress / strain, 1.0, 1e-3));
}

std::string bytes_of(const Specimen& s) { return save_world(s.cells.world); }

TEST(StepWithFaces, GivesTheSameBytesForAnyNumberOfThreadsAndAfterARestart) {
    const auto fresh = [](int threads) {
        FaceLaw law = brittle();
        law.damping_ratio = 0.05;
        law.softening_slip = 1e-4;
        law.residual_cohesion = 1e-4;
        Specimen s = specimen({.columns = 20, .rows = 20, .platens = true}, 1.0 / 1.6, law);
        s.world().stepping.time_step = 0.01;
        drive(s, -4e-4);
        set_threads(s.world(), threads);
        return s;
    };
    Specimen one = fresh(1);
    std::vector<std::string> at;
    for (int n = 0; n < 600; ++n) {
        if (n % 100 == 0) at.push_back(bytes_of(one));
        one.step();
    }
    EXPECT_GT(one.faces().broken.size(), 20u);
    const std::string expected = bytes_of(one);
    for (const int threads : {2, 3}) {
        Specimen several = fresh(threads);
        for (int n = 0; n < 600; ++n) several.step();
        EXPECT_TRUE(bytes_of(several) == expected) << threads << " threads";
    }
    for (std::size_t k = 1; k < at.size(); ++k) {
        Specimen again{{load_world(at[k], "memory"), {}, {}}};
        for (std::size_t n = 100 * k; n < 600; ++n) again.step();
        EXPECT_TRUE(bytes_of(again) == expected) << "restarted at step " << 100 * k;
    }
}

}  // namespace
}  // namespace crackle::face_test
