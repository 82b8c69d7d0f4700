// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that two held bodies of a deck exert normal and friction forces on each other like any others. Their outputs
// have closed forms, and the energy account closes. Without outputs such pairs have no contact points.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "solver/demseg/deck_run.hpp"
#include "solver/stepping/build_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using namespace testing;

constexpr double kn = 1e8, ks = 0.25e8, friction_angle = 20.0;
constexpr double rounding = 1e-12;  // round-off of sums of a few hundred numbers

/// Circles of radius 1 in a row at distances of 1.9, all held; a ramp of 100 steps moves and rotates them.
class HeldPairs : public ::testing::Test {
  protected:
    struct Way {
        double x = 0.0, turn = 0.0;
    };

    /// @param start jclid
    void write_deck(const std::vector<Way>& ways, int start = 0) const {
        std::filesystem::create_directories(scratch_ / "deck");
        std::string geometry = fmt::format("1 0 0\n1e-4 0 0\n1\n2.5 {} {} 0 0 {}\n-10 20 -10 10 0.1\n{} 0 0\n", kn, ks,
                                           friction_angle, ways.size());
        std::string controls = fmt::format("{} 0 100 10 1\n{}\n", start, ways.size()), moved;
        for (std::size_t k = 0; k < ways.size(); ++k) {
            geometry += fmt::format("{0} 1 1\n0 0 0\n1 1\n{1} 0 0\n", k + 1, 1.9 * static_cast<double>(k));
            controls += fmt::format("{} ", k + 1);
            moved += fmt::format("{} 1 {} 1 0 1 {}\n", k + 1, ways[k].x, ways[k].turn);
        }
        std::ofstream(scratch_ / "deck" / "in_gm.dat") << geometry;
        std::ofstream(scratch_ / "deck" / "in_bc.dat") << controls << "\n" << ways.size() << "\n" << moved;
    }
    void run(const std::string& from, const std::string& to, std::int64_t steps = 100) const {
        DeckOptions options;
        options.folder = scratch_ / from;
        options.output = scratch_ / to;
        options.goes_on = from != "deck";
        options.steps = steps;
        DeckRun(options).run();
    }
    /// Rows of f-d_curve.dat: step, id, fx, x, fy, y, moment, angle.
    Rows forces_on(int body, const std::string& folder = "out") const {
        return rows_of(read_rows(scratch_ / folder / "f-d_curve.dat"), 1, body);
    }
    Rows energies(const std::string& folder = "out") const { return read_rows(scratch_ / folder / "energy.dat"); }

    ScratchFolder scratch_;
};

TEST_F(HeldPairs, PressEachOtherByTheirOverlap) {
    write_deck({{}, {}});
    run("deck", "out");
    const double expected = kn * 0.1;
    for (const Rows& rows : {forces_on(1), forces_on(2)}) ASSERT_EQ(rows.size(), 100u);
    EXPECT_TRUE(agrees("force on the left one", forces_on(1).back()[2], -expected, rounding));
    EXPECT_TRUE(agrees("force on the right one", forces_on(2).back()[2], expected, rounding));
    EXPECT_TRUE(agrees("strain energy", energies().back()[3], 0.5 * kn * 0.01, rounding));
    EXPECT_TRUE(within("closing error", energies().back()[8], 0.0, rounding * 0.5 * kn * 0.01));
    const std::vector<DeckFrame> contacts = read_frames(scratch_ / "out" / "cont2.dat");
    ASSERT_EQ(contacts.back().rows.size(), 1u);
    EXPECT_TRUE(agrees("force of the contact", contacts.back().rows[0][5], expected, rounding));
}

TEST_F(HeldPairs, OfAChainEachHasTheDifferenceOfItsTwoContacts) {
    const std::vector<Way> ways{
        {0.0, 0.0}, {0.04, 0.0}, {-0.02, 0.0}, {0.07, 0.0}, {0.3, 0.0}};  // the last one separates
    write_deck(ways);
    run("deck", "out");
    double largest = 0.0, worst = 0.0;
    for (int step = 1; step <= 100; ++step) {
        std::vector<double> contact(ways.size() + 1, 0.0);  // before, between and after them
        double strain = 0.0;
        for (std::size_t k = 1; k < ways.size(); ++k) {
            const double overlap = 0.1 - (ways[k].x - ways[k - 1].x) * step / 100.0;
            contact[k] = kn * std::max(0.0, overlap);
            strain += 0.5 * kn * std::pow(std::max(0.0, overlap), 2);
        }
        for (std::size_t k = 0; k < ways.size(); ++k) {
            const double got = forces_on(static_cast<int>(k) + 1)[static_cast<std::size_t>(step) - 1][2];
            largest = std::max(largest, std::abs(got));
            worst = std::max(worst, std::abs(got - (contact[k] - contact[k + 1])));
        }
        ASSERT_NEAR(energies()[static_cast<std::size_t>(step)][3], strain, 1e-11 * strain) << step;
    }
    EXPECT_TRUE(within("largest error of a force over the largest force", worst / largest, 0.0, 1e-11));
    // In a step in which a spring opens, the error of the trapezoidal work is at most the energy stored at the start of
    // the step.
    const double last_step = 0.23 / 100.0;
    EXPECT_TRUE(within("closing error", energies().back()[8], 0.0, 0.5 * kn * last_step * last_step));
}

TEST_F(HeldPairs, RubByTheirHistoryUpToCoulombsLimit) {
    constexpr double arm = 0.95, limit_overlap = 0.1;
    const double limit = std::tan(friction_angle * std::numbers::pi / 180.0) * kn * limit_overlap;
    for (const double turn : {0.1, 0.4}) {
        write_deck({{}, {0.0, turn}});
        const std::string out = fmt::format("turned{}", turn);
        run("deck", out);
        const double spring = ks * arm * turn;
        EXPECT_EQ(spring > limit, turn > 0.2) << "one sticks, one slides";
        const double expected = -std::min(spring, limit);
        const std::vector<double> left = forces_on(1, out).back(), right = forces_on(2, out).back();
        EXPECT_TRUE(agrees("shear force on the left one", left[4], expected, 1e-11));
        EXPECT_TRUE(agrees("moment on the right one", right[6], arm * expected, 1e-11));
        const std::vector<double> energy = energies(out).back();
        const double stored = 0.5 * expected * expected / ks;
        EXPECT_TRUE(agrees("strain energy", energy[3], 0.5 * kn * 0.01 + stored, 1e-11));
        // In the step in which the limit is reached, the mean force is below it.
        const double step = arm * turn / 100.0;
        EXPECT_TRUE(within("lost to friction", energy[5], limit * std::max(0.0, arm * turn - limit / ks),
                           ks * step * step / 8.0));
        EXPECT_TRUE(within("closing error", energy[8], 0.0, 1e-11 * energy[3]));
    }
}

TEST_F(HeldPairs, KeepTheirSpringsWhereTheRunGoesOn) {
    write_deck({{}, {0.01, 0.1}, {-0.02, -0.3}});
    run("deck", "whole");
    run("deck", "first", 37);
    run("first", "second", 63);
    for (const char* name : {"f-d_curve.dat", "energy.dat", "cont2.dat"}) {
        EXPECT_EQ(read_file(scratch_ / "first" / name) + read_file(scratch_ / "second" / name),
                  read_file(scratch_ / "whole" / name))
            << name;
    }
    std::filesystem::remove(scratch_ / "first" / "new_state.bin");
    run("first", "by text", 63);
    EXPECT_TRUE(agrees("shear force", forces_on(1, "by text").back()[4], forces_on(1, "whole").back()[4], 1e-9));
    EXPECT_TRUE(agrees("moment", forces_on(3, "by text").back()[6], forces_on(3, "whole").back()[6], 1e-9));
}

TEST_F(HeldPairs, AreBondedAndBreakLikeOthers) {
    write_deck({{}, {}, {0.2002, 0.0}}, 3);
    run("deck", "out");
    // Bonded at an overlap of 0.1 and pulled by 0.002002 per step, so that the bond breaks within 50 steps.
    EXPECT_TRUE(within("force on the middle one, at first", forces_on(2).front()[2], kn * 0.002002, kn * 1e-12));
    const Rows middle = forces_on(2);
    double largest = 0.0;
    for (const std::vector<double>& row : middle) largest = std::max(largest, row[2]);
    EXPECT_TRUE(agrees("largest force on the middle one", largest, kn * 49 * 0.002002, 1e-9));
    EXPECT_EQ(middle.back()[2], 0.0);
    const Rows bonds = read_rows(scratch_ / "out" / "bonds.dat");
    EXPECT_EQ(bonds.front(), (std::vector<double>{0.0, 2.0, 0.0}));
    EXPECT_EQ(bonds.back(), (std::vector<double>{100.0, 1.0, 1.0}));
}

TEST_F(HeldPairs, AreFoundByFilesFromBeforeTheyWereHeld) {
    // The guide's first way of loading: the chain's first two circles are held and the last one is pulled.
    const std::string held = "\n1\n20\n3\n1 1 0.0 1 0.0 1 0.0\n2 1 0.0 1 0.0 1 0.0\n20 1 4.2 1 0.0 1 0.0\n";
    std::filesystem::create_directories(scratch_ / "deck");
    for (const char* name : {"in_gm.dat", "in_cf0.dat"})
        std::filesystem::copy_file(shipped_deck("chain_pulled") / name, scratch_ / "deck" / name);
    std::ofstream(scratch_ / "deck" / "in_bc.dat") << "3 1 20000 200 10" << held;
    run("deck", "bonded");
    EXPECT_EQ(read_rows(scratch_ / "bonded" / "bonds.dat").back()[1], 19.0);

    std::ofstream(scratch_ / "deck" / "in_bc.dat") << "3 0 100 100 10\n0\n0\n";
    run("deck", "free");
    std::ofstream(scratch_ / "free" / "new_in_bc.dat") << "1 100 20000 200 10" << held;
    run("free", "continued");
    EXPECT_EQ(read_rows(scratch_ / "continued" / "bonds.dat").back()[1], 19.0);
}

TEST_F(HeldPairs, MayBeDrivenThroughEachOther) {
    std::filesystem::create_directories(scratch_ / "deck");
    std::ofstream(scratch_ / "deck" / "in_gm.dat") << "1 0 0\n1e-4 0 0\n1\n2.5 1e8 0 0 0 0\n-10 20 -10 10 0.1\n0 2 0\n"
                                                      "1 1 1\n0 0 0\n1 0 0\n5 0\n2 1 1\n0 0 0\n1 2 -1\n2 -3\n";
    std::ofstream(scratch_ / "deck" / "in_bc.dat") << "0 0 1000 100 100\n1\n1\n2\n1 1 0 1 0 1 0\n2 1 0 1 3 1 0\n";
    EXPECT_NO_THROW(run("deck", "out", 1000));
}

/// Two overlapping circles, both with a prescribed velocity.
Scene held_circles(DrivenContacts wanted) {
    Scene scene;
    Material material;
    material.density = 2.5;
    material.normal_stiffness = kn;
    material.shear_stiffness = ks;
    scene.materials = {material};
    scene.domain = {-10.0, 10.0, -10.0, 10.0, {true, true, true, true}};
    scene.time_step = 1e-4;
    for (int k = 0; k < 2; ++k) {
        scene.add_circle_body(k + 1, 0, {{1.9 * k, 0.0}, 1.0, 0.0});
        Control control;
        control.body = k;
        control.x = control.y = control.rotation = {Drive::velocity, 0.0};
        scene.controls.push_back(control);
    }
    scene.driven_contacts = wanted;
    return scene;
}

TEST(HeldBodies, HaveNoContactPointsUnlessSomebodyReadsThem) {
    EXPECT_EQ(build_world(held_circles(DrivenContacts::none)).points.size(), 0u);
    EXPECT_EQ(build_world(held_circles(Scene{}.driven_contacts)).points.size(), 0u);
    EXPECT_EQ(build_world(held_circles(DrivenContacts::all)).points.size(), 1u);
}

TEST(HeldBodies, OfADeckAreReadWhereThereAreTwo) {
    const ScratchFolder scratch;
    const auto contacts_of = [&](const char* deck) {
        DeckOptions options;
        options.folder = shipped_deck(deck);
        options.output = scratch / "out";
        return DeckRun(options).world().settings.driven_contacts;
    };
    EXPECT_EQ(contacts_of("slope_k1"), DrivenContacts::unless_held) << "one";
    EXPECT_EQ(contacts_of("chain_pulled"), DrivenContacts::all) << "two";
}

}  // namespace
}  // namespace crackle
