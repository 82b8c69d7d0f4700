// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the bytes of a run depend neither on the number of threads nor on where it was stopped and resumed.
// Several threads are used even if the machine has fewer cores; each must have processed blocks of points.

#include <map>

#include "solver/stepping/step.hpp"
#include "solver/world/checkpoint.hpp"
#include "tests/support/jointed_cells.hpp"
#include "tests/verification/bursting_specimens.hpp"

namespace crackle {
namespace {

using namespace testing;

TEST(Determinism, ThreadsDoNotChangeABitForBurstingDiscs) {
    check_threads(bursting_discs(30, 30, 0.3, 0.1), 500, 5, 50);
}

TEST(Determinism, ThreadsDoNotChangeABitForBurstingPolygons) {
    check_threads(bursting_cells(14, 14, 3.0, 0.2), 600, 3, 20);
}

TEST(Determinism, ThreadsDoNotChangeABitUnderTheGuidesLaw) {
    check_threads(bursting_cells(14, 14, 3.0, 0.2, SegmentLaw::demseg), 600, 3, 20);
}

TEST(Determinism, StoppingAndTakingUpAgainDoesNotChangeABitUnderTheGuidesLaw) {
    check_restarts(bursting_cells(7, 7, 1.0, 0.2, SegmentLaw::demseg), 500, 23);
    check_restarts(bursting_cells(7, 7, 1.0, 0.2, SegmentLaw::demseg_mean), 500, 24);
}

TEST(Determinism, StoppingAndTakingUpAgainDoesNotChangeABitForDiscs) {
    check_restarts(bursting_discs(14, 14, 1.0, 0.2), 500, 21);
}

TEST(Determinism, StoppingAndTakingUpAgainDoesNotChangeABitForPolygons) {
    check_restarts(bursting_cells(7, 7, 1.0, 0.2), 500, 22);
}

TEST(Determinism, HoldsUnderTheConsistentIntegratorToo) {
    const World discs = bursting_discs(14, 14, 1.0, 0.2, Integrator::consistent);
    const World cells = bursting_cells(7, 7, 1.0, 0.2, SegmentLaw::rounded, Integrator::consistent);
    EXPECT_EQ(discs.points.opening.size(), discs.points.size());
    check_threads(bursting_discs(30, 30, 0.3, 0.1, Integrator::consistent), 500, 5, 50);
    check_restarts(discs, 500, 21);
    check_restarts(cells, 500, 22);
    // The result must differ from that of leapfrog, whose worlds store no opening data.
    const World plain = bursting_discs(14, 14, 1.0, 0.2);
    EXPECT_TRUE(plain.points.opening.empty());
    World one = discs, other = plain;
    for (int n = 0; n < 500; ++n) step(one), step(other);
    EXPECT_NE(one.bodies.state[0].x, other.bodies.state[0].x);
}

/// Joints of every kind: bonded and weak, open with an aperture, dilating, with their own stiffnesses. The rows slide
/// over each other, and everything flies apart.
World sliding_jointed_cells(int columns, int rows, Integrator integrator) {
    JointedCells cells;
    cells.columns = columns, cells.rows = rows;
    cells.integrator = integrator;
    cells.joints.resize(3);
    cells.joints[0].strength_factor = 1e-2;
    cells.joints[0].friction_angle = 20.0;
    cells.joints[0].dilation_angle = 8.0;
    cells.joints[0].dilation_slip = 1e-4;
    cells.joints[0].normal_stiffness = 1e11;
    cells.joints[0].shear_stiffness = 2e10;
    cells.joints[1].bonded = false;
    cells.joints[1].friction_angle = 25.0;
    cells.joints[1].dilation_angle = 5.0;
    cells.joints[2].bonded = false;
    cells.joints[2].aperture = 5e-6;
    cells.above_row = {{rows / 4, 0}, {rows / 2, 1}};
    cells.right_of_column = {{columns / 2, 2}};
    World world = jointed_world(cells);
    verification::shake(world, 20.0, 5);
    for (BodyState& body : world.bodies.state) {
        const double height = body.y / (cells.size * rows) - 0.5, width = body.x / (cells.size * columns) - 0.5;
        body.vx += 4.0 * height - 0.5 * width;
        body.vy += 1.5 * height;
    }
    return world;
}

TEST(Determinism, HoldsAcrossJoints) {
    for (const Integrator integrator : {Integrator::leapfrog, Integrator::consistent}) {
        check_threads(sliding_jointed_cells(16, 16, integrator), 800, 2, 20);
        check_restarts(sliding_jointed_cells(8, 8, integrator), 800, 25);
        World world = sliding_jointed_cells(8, 8, integrator), one_by_one = world;
        one_by_one.workers.one_by_one = true;
        for (int n = 0; n < 800; ++n) step(world), step(one_by_one);
        EXPECT_TRUE(save_world(world) == save_world(one_by_one)) << "points in lanes";
        double opened = 0.0;
        for (const double slip : world.points.slip) opened = std::max(opened, slip);
        EXPECT_GT(opened, 0.0) << "none has dilated";
    }
}

TEST(Events, AreTheDifferenceOfTheBondSets) {
    for (World world : {bursting_discs(14, 14, 1.0, 0.2), bursting_cells(10, 10, 2.0, 0.2),
                        bursting_cells(10, 10, 5.0, 0.2, SegmentLaw::demseg)}) {
        const auto bonds = [](const World& w) {
            std::map<std::pair<int, int>, int> count;
            for (PointIndex k = 0; k < w.points.size(); ++k) {
                if ((w.points.state[k].flags & point_bonded) == 0) continue;
                const ContactPoint p = w.points.contact[k];
                const int a = w.bodies.info(p.body_i).id, b = w.bodies.info(p.body_j).id;
                ++count[{std::min(a, b), std::max(a, b)}];
            }
            return count;
        };
        auto before = bonds(world);
        const std::int64_t interfaces = static_cast<std::int64_t>(before.size());
        EXPECT_EQ(world.bonds.interfaces_initial, interfaces);
        for (int n = 0; n < 1500; ++n) step(world);
        compute_forces(world);
        std::int64_t last = 0;
        for (const BreakEvent& event : world.bonds.events) {
            --before[{std::min(event.body_i, event.body_j), std::max(event.body_i, event.body_j)}];
            last += event.last_of_interface ? 1 : 0;
        }
        std::erase_if(before, [](const auto& entry) { return entry.second == 0; });
        EXPECT_EQ(before, bonds(world));
        EXPECT_EQ(last, world.bonds.interfaces_lost);
        EXPECT_EQ(interfaces - static_cast<std::int64_t>(before.size()), world.bonds.interfaces_lost);
        EXPECT_EQ(static_cast<std::int64_t>(world.bonds.events.size()), world.bonds.broken);
        fmt::print("  {} of {} bonds broken, {} of {} interfaces lost\n", world.bonds.broken, world.bonds.initial,
                   world.bonds.interfaces_lost, world.bonds.interfaces_initial);
        EXPECT_GT(world.bonds.interfaces_lost, 0);
        EXPECT_LT(world.bonds.interfaces_lost, interfaces);
    }
}

TEST(Checkpoint, ForeignTruncatedAndLongerBytesAreRefused) {
    const std::string good = save_world(bursting_discs(4, 4, 1.0, 0.1));
    const auto refused = [](const std::string& bytes) {
        try {
            load_world(bytes, "some/checkpoint");
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("some/checkpoint"), std::string::npos) << error.what();
            return true;
        }
        return false;
    };
    EXPECT_TRUE(refused(""));
    EXPECT_TRUE(refused("not a checkpoint at all, but long enough"));
    EXPECT_TRUE(refused(good.substr(0, good.size() - 1)));
    EXPECT_TRUE(refused(good.substr(0, good.size() / 2)));
    EXPECT_TRUE(refused(good + "x"));
    EXPECT_FALSE(refused(good));
}

}  // namespace
}  // namespace crackle
