// SPDX-License-Identifier: GPL-3.0-or-later
// A specimen in half boxes: pressed before it is sheared, and loaded tests of the kinds that are not between platens.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/errors.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/press.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

class Kinds : public ::testing::Test {
  protected:
    TestCase described(const std::string& kind, const std::string& mesh, const std::string& loading, double rate = 0.01,
                       const std::string& numerics = {}) const {
        testing::SmallCase wanted;
        wanted.kind = kind;
        wanted.mesh = mesh;
        wanted.rate = rate;
        wanted.max_strain = 0.002;
        wanted.loading = loading;
        wanted.numerics = numerics;
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    testing::ScratchFolder scratch_;
};

TEST_F(Kinds, BoxPressesWithTheNormalStressBeforeItShears) {
    constexpr double normal = 1e3;  // N/m
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        VirtualTest test = bond_test(described("direct_shear", mesh, "normal_stress = 1e3"));
        World& world = test.world;
        compute_forces(world);
        const std::string name = *mesh == '\0' ? "circles" : mesh;
        const double force = normal * test.setup.width;
        EXPECT_TRUE(agrees(name + ": force on the upper box", world.bodies.force[test.setup.top].fy, force,
                           most_unbalanced_pressed));
        double lower = 0.0;
        for (const SetupPart& part : test.setup.parts)
            if (part.body != test.setup.top) lower += world.bodies.force[part.body].fy;
        // What bodies between them are left with: most_unbalanced of the force on a particle, each.
        EXPECT_TRUE(agrees(name + ": and on the lower one", -lower, force, 1e-3));
        const CurveRow row = observe_row(world, test.setup);
        EXPECT_EQ(row.axial_strain, 0.0);
        EXPECT_EQ(row.lateral_strain, 0.0);
        EXPECT_EQ(world.bonds.broken, 0);
    }
}

TEST_F(Kinds, NormalForceStaysWhenShearingBeginsAndDoesItsWork) {
    constexpr double normal = 1e3;  // N/m
    VirtualTest test = prepare_test(described("direct_shear", "", "normal_stress = 1e3"));
    load_specimen(test);
    const std::vector<CurveRow>& rows = test.state.rows;
    EXPECT_EQ(rows.front().lateral_strain, 0.0);
    EXPECT_EQ(rows.front().confinement_work, 0.0);
    // Its work is minus the force times the rise, to the rounding of a sum over steps.
    const double force = normal * test.setup.width;
    for (const CurveRow& row : rows) {
        const double expected = -force * row.lateral_strain * test.setup.height;
        ASSERT_NEAR(row.confinement_work, expected, 1e-9 * force * test.setup.height * 1e-3) << row.axial_strain;
    }
}

TEST_F(Kinds, NormalStiffnessMakesTheNormalForceGrowWithTheRise) {
    constexpr double normal = 1e3, stiffness = 1e8;  // N/m, N/m2
    TestCase description = described("direct_shear", "", "normal_stress = 1e3\nnormal_stiffness = 1e8");
    description.loading.max_axial_strain = 0.02;  // beyond its strength, where it rises
    VirtualTest test = prepare_test(description);
    load_specimen(test);
    const double force = normal * test.setup.width, spring = stiffness * test.setup.width;
    double highest = 0.0;
    for (const CurveRow& row : test.state.rows) {
        const double rise = row.lateral_strain * test.setup.height;
        highest = std::max(highest, rise);
        const double expected = -(force + 0.5 * spring * rise) * rise;
        ASSERT_NEAR(row.confinement_work, expected, 1e-9 * force * test.setup.height * 1e-3) << row.axial_strain;
    }
    // Held back from rising at the end, the specimen bears what the spring has grown by; its inertia is of the box
    // alone.
    compute_forces(test.world);
    const double rise = test.state.rows.back().lateral_strain * test.setup.height;
    EXPECT_TRUE(
        agrees("force on the upper box, N", test.world.bodies.force[test.setup.top].fy, force + spring * rise, 1e-3));
    EXPECT_GT(spring * highest, 0.1 * force) << "the box has hardly risen: nothing was shown";
    const CurveRow& last = test.state.rows.back();
    EXPECT_TRUE(within("energy error over the work", last.energy_error / last.platen_work, 0.0, 5e-3));
}

TEST_F(Kinds, EnergyClosesWhenShearedFarBeyondTheStrength) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        TestCase description = described("direct_shear", mesh, "normal_stress = 2e4");
        description.loading.max_axial_strain = 0.1;
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        EXPECT_GT(test.world.bonds.broken, 0);
        const CurveRow& last = test.state.rows.back();
        const double work = std::abs(last.platen_work) + std::abs(last.confinement_work);
        EXPECT_TRUE(within(fmt::format("{}: closing error over the works", *mesh == '\0' ? "circles" : mesh),
                           last.energy_error / work, 0.0, 1e-3));
    }
}

TEST_F(Kinds, NormalStiffnessBeyondThatOfTheBondsIsRefused) {
    try {
        prepare_test(described("direct_shear", "", "normal_stress = 0\nnormal_stiffness = 1e12"));
        ADD_FAILURE() << "goes on";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("loading.normal_stiffness: found 1e+12"), std::string::npos)
            << error.what();
    }
}

TEST_F(Kinds, StressRisesByTheLinearSolutionsModulus) {
    const std::pair<const char*, const char*> kinds[] = {{"brazilian", "half_angle = 30"},
                                                         {"bending", "span = 0.13\npad_width = 0.05"},
                                                         {"direct_shear", "normal_stress = 0"}};
    for (const auto& [kind, loading] : kinds) {
        for (const char* mesh : {"", "voronoi"}) {
            // Six discs wide are no disc, and a pad that holds a single one turns about it.
            if (*mesh == '\0' && std::string(kind) != "direct_shear") continue;
            TestCase description = described(kind, mesh, loading, 1e-3, "intact = true");
            description.loading.max_axial_strain = 1e-4;
            VirtualTest test = prepare_test(description);
            ASSERT_TRUE(test.small_strain) << kind << test.no_small_strain;
            load_specimen(test);
            const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
            const double slope = (last.axial_stress - first.axial_stress) / (last.axial_strain - first.axial_strain);
            // Jaws are concave: a corner of a cell in a hollow of theirs meets one edge or the other, as it moves,
            // where the solution has it at one. That is the case of a cell in 20 here, by a share of its stiffness.
            const bool hollow = *mesh != '\0' && std::string(kind) == "brazilian";
            EXPECT_TRUE(agrees(fmt::format("{} {}: slope of the curve", kind, *mesh == '\0' ? "circles" : mesh), slope,
                               test.small_strain->moduli.youngs_modulus, hollow ? 5e-3 : 1e-4));
            EXPECT_TRUE(
                within("energy error over the work", last.energy_error / (last.platen_work + 1e-300), 0.0, 1e-3));
        }
    }
}

}  // namespace
}  // namespace crackle
