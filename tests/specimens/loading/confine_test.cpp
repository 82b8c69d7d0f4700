// SPDX-License-Identifier: GPL-3.0-or-later
// Tests a specimen between platens under a membrane: equilibrium before loading, the effect of the pressure on its
// area, and a test resumed from there.

#include "specimens/loading/confine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "solver/base/errors.hpp"
#include "solver/measure/ledger.hpp"
#include "solver/membrane/wrap.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/elastic/held_parts.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

class Confined : public ::testing::Test {
  protected:
    ResolvedCase described(const std::string& mesh, double pressure, const std::string& loading = {},
                           const std::string& side = "membrane") const {
        testing::SmallCase wanted;
        wanted.kind = "biaxial";
        wanted.mesh = mesh;
        wanted.rate = 0.05;
        wanted.max_strain = 0.01;
        wanted.loading = loading;
        wanted.output =
            fmt::format("curve_rows = 2000\nframes = 5\n[confinement]\npressure = {}\nside = \"{}\"", pressure, side);
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    testing::ScratchFolder scratch_;
};

constexpr double pressure = 1e3;  // N/m

TEST_F(Confined, SpecimenIsInEquilibriumBeforeLoadingBegins) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        for (const char* loading : {"", "platens = \"frictional\"\nplaten_friction_angle = 10"}) {
            VirtualTest test = prepare_test(described(mesh, pressure, loading));
            World& world = test.world;
            // Without velocities, dashpots carry no force.
            for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
            velocities_changed(world);
            compute_forces(world);
            const CurveRow row = observe_row(world, test.setup);
            const std::string what =
                std::string(*mesh == '\0' ? "circles" : mesh) + (*loading == '\0' ? "" : ", friction");
            EXPECT_TRUE(
                within(what + ": stress of the platens over the pressure", row.axial_stress / pressure, 1.0, 1e-4));
            EXPECT_EQ(row.axial_strain, 0.0);
            EXPECT_TRUE(within("lateral strain", row.lateral_strain, 0.0, 1e-15));
            EXPECT_EQ(world.bonds.broken, 0);
            EXPECT_EQ(test.setup.apparatus.confining_pressure, pressure);
            // The probe disc has the size of a mean particle.
            const double particle = std::sqrt(test.setup.specimen.width * test.setup.specimen.height /
                                              static_cast<double>(test.setup.specimen.particles));
            EXPECT_TRUE(agrees("radius of the membrane's disc, m", world.membrane.probe, 0.5 * particle, 1e-12));
        }
    }
}

TEST_F(Confined, SpecimenThatItsPlatensDoNotHoldIsRefusedSoon) {
    // The last circles on one side are slightly nearer to one platen than those on the other, because of the membrane's
    // pressure.
    const auto file = scratch_ / "smooth.toml";
    std::ofstream(file) << "include = \"" CRACKLE_SOURCE_DIR "/specimens/rocks/softrock.toml\"\n"
                        << "title = \"smooth platens\"\n[packing]\ncount = 300\n[confinement]\npressure = 5e6\n"
                        << "[loading]\nkind = \"biaxial\"\nmax_axial_strain = 0.01\nplatens = \"frictional\"\n"
                        << "platen_friction_angle = 0.01\n";
    const ResolvedCase smooth = read_case(file);
    std::string refused;
    try {
        VirtualTest prepared = prepare_test(smooth);
    } catch (const InputError& error) {
        refused = error.what();
    }
    EXPECT_NE(refused.find("slides between its platens"), std::string::npos) << refused;
    EXPECT_NE(refused.find("raise loading.platen_friction_angle"), std::string::npos) << refused;
}

/// Force of the specimen on a wall, N; positive if it pushes the wall outwards.
double force_on_wall(const VirtualTest& test, std::size_t wall) {
    const double force = test.world.bodies.force[test.setup.apparatus.parts[wall].body].fx;
    return wall == 1 ? -force : force;
}

TEST_F(Confined, WallsAreInEquilibriumWithTheSpecimenBeforeLoadingBegins) {
    for (const char* mesh : {"", "delaunay", "voronoi"}) {
        for (const char* loading : {"", "platens = \"frictional\"\nplaten_friction_angle = 10"}) {
            VirtualTest test = prepare_test(described(mesh, pressure, loading, "walls"));
            World& world = test.world;
            ASSERT_EQ(test.setup.apparatus.parts.size(), 4U);
            for (BodyState& body : world.bodies.state) body.vx = body.vy = body.omega = 0.0;
            velocities_changed(world);
            compute_forces(world);
            const std::string what =
                std::string(*mesh == '\0' ? "circles" : mesh) + (*loading == '\0' ? "" : ", friction");
            const CurveRow row = observe_row(world, test.setup);
            EXPECT_TRUE(
                within(what + ": stress of the platens over the pressure", row.axial_stress / pressure, 1.0, 1e-4));
            for (const std::size_t wall : {1U, 2U}) {
                EXPECT_TRUE(agrees(fmt::format("{}: force on wall {}", what, wall), force_on_wall(test, wall),
                                   pressure * test.setup.specimen.height, 1e-4));
                EXPECT_EQ(world.bodies.force[test.setup.apparatus.parts[wall].body].fy, 0.0) << "walls are smooth";
            }
            EXPECT_EQ(row.axial_strain, 0.0);
            EXPECT_EQ(world.bonds.broken, 0);
            EXPECT_EQ(test.setup.apparatus.confining_pressure, pressure);
        }
    }
}

TEST_F(Confined, WallsDoTheWorkOfTheirForceAndTheEnergyCloses) {
    for (const char* mesh : {"", "voronoi"}) {
        VirtualTest test = prepare_test(described(mesh, pressure, {}, "walls"));
        const auto apart = [&] {
            const auto x = [&](std::size_t wall) {
                return test.world.bodies.state[test.setup.apparatus.parts[wall].body].x;
            };
            return x(2) - x(1);
        };
        const double before = apart();
        load_specimen(test);
        const CurveRow& last = test.state.rows.back();
        EXPECT_GT(test.state.failure.peak_stress, 2.0 * pressure);
        EXPECT_GT(apart(), before);
        const double force = pressure * test.setup.specimen.height;
        EXPECT_TRUE(agrees("work of the walls, J", last.confinement_work, -force * (apart() - before), 1e-9));
        const double work = std::abs(last.platen_work) + std::abs(last.confinement_work);
        EXPECT_TRUE(within("closing error over the works", last.energy_error / work, 0.0, 2e-3));
    }
}

TEST_F(Confined, SpecimenBetweenWallsHasTheModulusOfItsSolutionAndIsNoSofterThanInAMembrane) {
    for (const char* mesh : {"", "voronoi"}) {
        ResolvedCase description = described(mesh, pressure, {}, "walls");
        description.loading.max_axial_strain = 1e-4;  // small enough that initial waves would be noticed
        description.loading.rate = parts::StrainRate{5e-4};
        VirtualTest test = prepare_test(description);
        const double solved = nominal_stress(test.setup.apparatus, test.small_strain->moduli.solution.reaction);
        load_specimen(test);
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        ASSERT_EQ(last.bonds_broken, 0);
        const double modulus = (last.axial_stress - first.axial_stress) / last.axial_strain;
        EXPECT_TRUE(agrees("slope, N/m", modulus, solved, 2e-3));
        EXPECT_GE(solved, test.state.youngs_modulus);
        EXPECT_LT(solved, 1.1 * test.state.youngs_modulus)
            << "the specimen widens freely, so walls restrain only its unevenness";
    }
}

TEST_F(Confined, LoadingBetweenWallsBeginsWithoutAShock) {
    for (const char* mesh : {"", "voronoi"}) {
        ResolvedCase description = described(mesh, pressure, {}, "walls");
        description.loading.rate = parts::RateTolerance{0.01};
        VirtualTest test = prepare_test(description);
        const auto kinetic = [&] {
            compute_forces(test.world);
            return measure_ledger(test.world).kinetic;
        };
        const double first = kinetic();
        for (int n = 0; n < 12; ++n) step(test.world);
        // Walls at rest at the beginning would take 5e-4 of the energy in twelve steps; a fifth of this would be
        // noticed.
        EXPECT_TRUE(agrees("kinetic energy after twelve steps, J", kinetic(), first, 1e-4));
    }
}

TEST_F(Confined, StressOnThePlatensIsTheirsAloneAndItsEnergyCloses) {
    for (const char* mesh : {"", "voronoi"}) {
        VirtualTest test = prepare_test(described(mesh, pressure));
        load_specimen(test);
        const std::vector<CurveRow>& rows = test.state.rows;
        ASSERT_GT(rows.size(), 100U);
        const auto peak = static_cast<std::size_t>(test.state.failure.peak_row);
        EXPECT_GT(rows[peak].axial_stress, 2.0 * pressure);
        const CurveRow& last = rows.back();
        EXPECT_LT(rows[peak].confinement_work, 0.0) << "a specimen that widens lifts the membrane";
        const double work = std::abs(last.platen_work) + std::abs(last.confinement_work);
        EXPECT_TRUE(within("closing error over the works", last.energy_error / work, 0.0, 2e-3));
    }
}

TEST_F(Confined, SpecimenThatHoldsHasTheModulusOfTheSolveWhateverThePressure) {
    for (const char* mesh : {"", "voronoi"}) {
        ResolvedCase description = described(mesh, pressure);
        description.numerics.intact = true;
        description.loading.max_axial_strain = 1e-4;
        description.loading.rate = parts::StrainRate{5e-4};
        VirtualTest test = prepare_test(description);
        load_specimen(test);
        const CurveRow &first = test.state.rows.front(), &last = test.state.rows.back();
        const double modulus = (last.axial_stress - first.axial_stress) / last.axial_strain;
        EXPECT_TRUE(agrees("slope, N/m", modulus, test.state.youngs_modulus, 2e-3));
        const double widening = (last.lateral_strain - first.lateral_strain) / last.axial_strain;
        EXPECT_TRUE(agrees("widening over shortening", widening, test.state.poissons_ratio, 5e-3));
    }
}

TEST_F(Confined, SpecimenIsStrongerUnderMorePressure) {
    std::vector<double> strengths;
    for (const double p : {100.0, 2e3, 4e3}) {
        VirtualTest test = prepare_test(described("voronoi", p));
        load_specimen(test);
        strengths.push_back(test.state.failure.peak_stress);
        fmt::print("  {:.0f} N/m: {:.0f} N/m\n", p, strengths.back());
    }
    EXPECT_GT(strengths[1], strengths[0] + 1.9e3);
    EXPECT_GT(strengths[2], strengths[1] + 2e3);
}

TEST_F(Confined, PressureBeyondTheRockIsRefusedWhateverThePlatens) {
    for (const char* loading : {"", "platens = \"frictional\"\nplaten_friction_angle = 10"}) {
        try {
            prepare_test(described("", 1e7, loading));
            ADD_FAILURE() << "continues without its pressure: " << loading;
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("confinement.pressure: found no equilibrium"), std::string::npos) << message;
        }
    }
}

TEST_F(Confined, PressureBelongsToBiaxialTestsAlone) {
    const auto refusal = [&](const std::string& kind, const std::string& table, const std::string& numerics = {}) {
        testing::SmallCase wanted;
        wanted.kind = kind;
        wanted.numerics = numerics;
        wanted.output = "curve_rows = 2000\nframes = 5\n" + table;
        try {
            read_case(testing::write_small_case(scratch_ / "", wanted));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("read");
    };
    EXPECT_NE(refusal("tension", "[confinement]\npressure = 1e3").find("needs loading.kind = \"biaxial\""),
              std::string::npos);
    EXPECT_NE(refusal("compression", "[confinement]\npressure = 1e3").find("needs loading.kind = \"biaxial\""),
              std::string::npos);
    EXPECT_NE(refusal("biaxial", "").find("confinement.pressure"), std::string::npos);
    EXPECT_NE(refusal("compression", "[confinement]\nside = \"walls\"").find("needs loading.kind = \"biaxial\""),
              std::string::npos);
    EXPECT_NE(refusal("biaxial", "[confinement]\npressure = 1e3\nside = \"wall\"").find("found \"wall\""),
              std::string::npos);
    EXPECT_NE(
        refusal("biaxial", "[confinement]\npressure = 1e3\nside = \"walls\"", "intact = true").find("numerics.intact"),
        std::string::npos);
    EXPECT_NE(refusal("biaxial", "[confinement]\npressure = -1e3").find("found -1000"), std::string::npos);
}

}  // namespace
}  // namespace crackle
