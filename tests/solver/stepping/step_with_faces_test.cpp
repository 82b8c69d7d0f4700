// SPDX-License-Identifier: GPL-3.0-or-later
// Steps with faces: the stable step, friction at platens, and bytes that do not depend on the number of threads or on a
// restart. The balance of energy is a claim (tests/bench/verify/faces).

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "solver/world/checkpoint.hpp"
#include "tests/bench/verify/scenes/loaded_cells.hpp"
#include "tests/support/claim.hpp"

namespace crackle::verification {
namespace {

using testing::agrees;
using testing::within;

TEST(StepWithFaces, IsStableJustBelowTheExactStepAndUnstableJustAbove) {
    for (const double share : {0.99, 1.01}) {
        CellSpecimen s = bond_cells({.columns = 6, .rows = 6}, 1.0 / 1.6, {});
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

TEST(StepWithFaces, RubsOnAPlatenWithItsFriction) {
    CellBox box{.columns = 4, .rows = 4, .platens = true};
    CellSpecimen s{build_box(box)};
    FaceBonding bonding = elastic_rock(s.cells, box.gap, 0.26, 1.0);
    bonding.platens = PlatenFaces::rubbing;
    bonding.platen_friction = 0.4;
    bonding.materials[0].law.damping_ratio = 0.2;
    bond_by_faces(s.cells.world, bonding);
    s.world().stepping.time_step = 0.4 * s.exact_step();
    const double stroke = 1e-4 / (2000 * s.world().stepping.time_step);
    drive_platens(s, -stroke);
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

std::string bytes_of(const CellSpecimen& s) { return save_world(s.cells.world); }

TEST(StepWithFaces, GivesTheSameBytesForAnyNumberOfThreadsAndAfterARestart) {
    const auto fresh = [](int threads) {
        FaceLaw law = brittle_cells();
        law.damping_ratio = 0.05;
        law.softening_slip = 1e-4;
        law.residual_cohesion = 1e-4;
        CellSpecimen s = bond_cells({.columns = 20, .rows = 20, .platens = true}, 1.0 / 1.6, law);
        s.world().stepping.time_step = 0.01;
        drive_platens(s, -4e-4);
        set_threads(s.world(), threads);
        return s;
    };
    CellSpecimen one = fresh(1);
    std::vector<std::string> at;
    for (int n = 0; n < 600; ++n) {
        if (n % 100 == 0) at.push_back(bytes_of(one));
        one.step();
    }
    EXPECT_GT(one.faces().broken.size(), 20u);
    const std::string expected = bytes_of(one);
    for (const int threads : {2, 3}) {
        CellSpecimen several = fresh(threads);
        for (int n = 0; n < 600; ++n) several.step();
        EXPECT_TRUE(bytes_of(several) == expected) << threads << " threads";
    }
    for (std::size_t k = 1; k < at.size(); ++k) {
        CellSpecimen again{{load_world(at[k], "memory"), {}, {}}};
        for (std::size_t n = 100 * k; n < 600; ++n) again.step();
        EXPECT_TRUE(bytes_of(again) == expected) << "restarted at step " << 100 * k;
    }
}

}  // namespace
}  // namespace crackle::verification
