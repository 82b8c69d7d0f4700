// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the direct shear test, in which a specimen in two half boxes is compressed and then sheared, and other kinds of
// test without platens.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "solver/base/errors.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
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
    ResolvedCase described(const std::string& kind, const std::string& mesh, const std::string& loading,
                           double rate = 0.01, const std::string& numerics = {}) const {
        testing::SmallCase wanted;
        wanted.kind = kind;
        wanted.mesh = mesh;
        wanted.rate = rate;
        wanted.max_strain = 0.002;
        wanted.loading = loading;
        wanted.numerics = numerics;
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    /// Circles of a few millimetres in the shear box under 5 MPa. @param tables TOML tables of traces and mesh
    ResolvedCase packed(const std::string& tables, double max_strain) const {
        std::ofstream(scratch_ / "packed.toml") << fmt::format(
            "[packing]\nwidth = 0.03\nheight = 0.02\nradius_min = 0.9e-3\nradius_max = 1.6e-3\nmean_overlap = "
            "1e-6\nseed = 4\n"
            "{}[material]\ndensity = 2650.0\nunits = \"area\"\ncontact_modulus = 60e9\nstiffness_ratio = 2.5\n"
            "friction_angle = 45.0\ntensile_strength = 200e6\ncohesion = 600e6\ndamping_ratio = 0.2\n[bond]\n"
            "law = \"coulomb\"\nrange = 0.1\n[loading]\nkind = \"direct_shear\"\nnormal_stress = 5e6\n"
            "max_axial_strain = {}\n",
            tables, max_strain);
        return read_case(scratch_ / "packed.toml");
    }
    testing::ScratchFolder scratch_;
};

constexpr const char* open_joint =
    "[[trace]]\nname = \"joint\"\npoints = [0.0, 0.01, 0.03, 0.01]\nbonded = false\nfriction_angle = 30.0\n";

// Compression brings unbonded circles into contact, so it differs from the linear solution, which contains only bonds.
TEST_F(Kinds, BoxPressesCirclesThatMeetByTheNormalStress) {
    for (const char* joint : {"", open_joint}) {
        VirtualTest test = bond_test(packed(joint, 0.001));
        compute_forces(test.world);
        const double force = 5e6 * test.setup.specimen.width;
        EXPECT_TRUE(agrees(fmt::format("{}: force on the upper box", *joint == '\0' ? "rock" : "joint"),
                           test.world.bodies.force[test.setup.apparatus.top].fy, force, most_unbalanced_pressed));
        EXPECT_EQ(test.world.bonds.broken, 0);
    }
}

// The joint separates the boxes from side to side, so its normal and shear stresses are the forces on the boxes divided
// by its length.
TEST_F(Kinds, OpenJointAmongCirclesSlidesAtItsFriction) {
    ResolvedCase description = packed(open_joint, 4e-4);
    description.loading.strength_drop = 1.0;  // it continues to slide
    VirtualTest test = prepare_test(description);
    const double strength = 5e6 * std::tan(30.0 * std::numbers::pi / 180.0);
    const double strain = test.setup.rate_rule.first_strain;
    // Before sliding the solution is linear, and points carry equal stress except at the ends of the boxes.
    EXPECT_TRUE(within("strain of the rule over the stress that slides by the modulus",
                       strain * test.small_strain->moduli.youngs_modulus / strength, 1.0, 0.3));
    load_specimen(test);
    double sum = 0.0, count = 0.0;
    for (const CurveRow& row : test.state.rows) {
        if (row.axial_strain < 2.0 * strain) continue;
        sum += row.axial_stress;
        ++count;
    }
    ASSERT_GT(count, 20.0);
    EXPECT_TRUE(agrees("mean shear stress while it slides", sum / count, strength, 0.03));
    EXPECT_TRUE(within("largest over it", test.state.failure.largest_stress / strength, 1.0, 0.1));
    EXPECT_TRUE(within("rise over the way", test.state.rows.back().lateral_strain / 4e-4, 0.0, 0.02));
    EXPECT_EQ(test.world.bonds.broken, 0);
}

TEST_F(Kinds, BoxPressesWithTheNormalStressBeforeItShears) {
    constexpr double normal = 1e3;  // N/m
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        VirtualTest test = bond_test(described("direct_shear", mesh, "normal_stress = 1e3"));
        World& world = test.world;
        compute_forces(world);
        const std::string name = *mesh == '\0' ? "circles" : mesh;
        const double force = normal * test.setup.specimen.width;
        EXPECT_TRUE(agrees(name + ": force on the upper box", world.bodies.force[test.setup.apparatus.top].fy, force,
                           most_unbalanced_pressed));
        double lower = 0.0;
        for (const SetupPart& part : test.setup.apparatus.parts)
            if (part.body != test.setup.apparatus.top) lower += world.bodies.force[part.body].fy;
        // The tolerance is the unbalanced force allowed on each particle between the boxes.
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
    // The work is minus the force times the rise, up to the round-off of a sum over steps.
    const double force = normal * test.setup.specimen.width;
    for (const CurveRow& row : rows) {
        const double expected = -force * row.lateral_strain * test.setup.specimen.height;
        ASSERT_NEAR(row.confinement_work, expected, 1e-9 * force * test.setup.specimen.height * 1e-3)
            << row.axial_strain;
    }
}

TEST_F(Kinds, NormalStiffnessMakesTheNormalForceGrowWithTheRise) {
    constexpr double normal = 1e3, stiffness = 1e8;  // N/m, N/m2
    ResolvedCase description = described("direct_shear", "", "normal_stress = 1e3\nnormal_stiffness = 1e8");
    description.loading.max_axial_strain = 0.02;  // beyond its strength, so that it dilates
    VirtualTest test = prepare_test(description);
    load_specimen(test);
    const double force = normal * test.setup.specimen.width, spring = stiffness * test.setup.specimen.width;
    double highest = 0.0;
    for (const CurveRow& row : test.state.rows) {
        const double rise = row.lateral_strain * test.setup.specimen.height;
        highest = std::max(highest, rise);
        const double expected = -(force + 0.5 * spring * rise) * rise;
        ASSERT_NEAR(row.confinement_work, expected, 1e-9 * force * test.setup.specimen.height * 1e-3)
            << row.axial_strain;
    }
    // The spring's increasing force acts on the specimen at the end; only the box has inertia.
    compute_forces(test.world);
    const double rise = test.state.rows.back().lateral_strain * test.setup.specimen.height;
    EXPECT_TRUE(agrees("force on the upper box, N", test.world.bodies.force[test.setup.apparatus.top].fy,
                       force + spring * rise, 1e-3));
    EXPECT_GT(spring * highest, 0.1 * force) << "the box has hardly risen: nothing was shown";
    const CurveRow& last = test.state.rows.back();
    EXPECT_TRUE(within("energy error over the work", last.energy_error / last.platen_work, 0.0, 5e-3));
}

TEST_F(Kinds, EnergyClosesWhenShearedFarBeyondTheStrength) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        ResolvedCase description = described("direct_shear", mesh, "normal_stress = 2e4");
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
            // A specimen six circles wide is not a disc, and a pad that touches a single circle rotates about it.
            if (*mesh == '\0' && std::string(kind) != "direct_shear") continue;
            ResolvedCase description = described(kind, mesh, loading, 1e-3, "intact = true");
            description.loading.max_axial_strain = 1e-4;
            VirtualTest test = prepare_test(description);
            ASSERT_TRUE(test.small_strain) << kind << test.no_small_strain;
            load_specimen(test);
            const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
            const double slope = (last.axial_stress - first.axial_stress) / (last.axial_strain - first.axial_strain);
            // Jaws are concave: a cell's corner in a hollow touches one edge or the other as it moves, but only one in
            // the linear solution. Here one cell in 20 is affected, by a fraction of its stiffness.
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
