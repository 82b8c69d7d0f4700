// SPDX-License-Identifier: GPL-3.0-or-later
// Cases whose bonds are faces: moduli, breaks, pictures and restarts, and what they refuse.

#include "specimens/setup/face_bonds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/making/make_specimen.hpp"
#include "specimens/setup/bonded_specimen.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;

struct FaceRock {
    std::string kind = "compression";
    std::string mesh = "voronoi";
    std::string material = "youngs_modulus = 70e9\npoissons_ratio = 0.25\nstiffness_ratio = 1.6";
    std::string strengths = "tensile_strength = 10e6\ncohesion = 40e6\nfriction_angle = 40\nmoment_share = 0.6";
    std::string law = "face", units = "area", more = {};
    int columns = 12;
};

ResolvedCase face_case(const testing::ScratchFolder& scratch, const FaceRock& rock) {
    const auto path = scratch / "case.toml";
    std::ofstream(path) << fmt::format(
        "[packing]\nwidth = {}\nheight = {}\nradius_min = 0.9e-3\nradius_max = 1.4e-3\nmean_overlap = 1e-6\n"
        "[mesh]\nkind = \"{}\"\nmerge_destroyed = true\n[material]\ndensity = 2600\nunits = \"{}\"\n{}\n{}\n"
        "damping_ratio = 0.1\n[bond]\nlaw = \"{}\"\nstrength_distribution = \"weibull\"\nstrength_cv = 0.2\n"
        "strength_seed = 1\n[loading]\nkind = \"{}\"\nrate_tolerance = 0.02\nmax_axial_strain = 0.006\n{}",
        2.3e-3 * rock.columns, 4.6e-3 * rock.columns, rock.mesh, rock.units, rock.material, rock.strengths, rock.law,
        rock.kind, rock.more);
    return read_case(path);
}

TEST(TestWithFaces, HasTheModuliOfItsMaterial) {
    for (const char* mesh : {"voronoi", "delaunay"}) {
        const testing::ScratchFolder scratch;
        FaceRock rock;
        rock.mesh = mesh;
        const VirtualTest test = prepare_test(face_case(scratch, rock), {});
        // Bonded platens hold the ends, which stiffens a specimen twice as high as wide by 1 to 2 % (Poisson's ratio
        // 0.25), and rows at the sides by as much (solver/MODEL.md 5.5).
        EXPECT_TRUE(agrees("Young's modulus", test.state.youngs_modulus, 70e9, 0.04));
        EXPECT_TRUE(within("Poisson's ratio", test.state.poissons_ratio, 0.25, 0.03));
    }
}

TEST(FaceRock, HasTheArealModulusOfItsKeysWithTheCorrectionOfItsMesh) {
    for (const char* mesh : {"voronoi", "delaunay"}) {
        const testing::ScratchFolder scratch;
        FaceRock rock;
        rock.mesh = mesh;
        const ResolvedCase test = face_case(scratch, rock);
        const Specimen specimen = make_specimen(test, test, {});
        const World world = bond_alone(specimen, test.bond, test);
        const FaceModuli moduli =
            face_bonding_of(world, specimen, test.bond, PlatenKind::bonded, specimen.mesh_gap).materials.front().moduli;
        const double expected = 0.5 * 70e9 / (1.0 - 0.25);
        EXPECT_TRUE(agrees("E_c/2 + lambda", 0.5 * moduli.contact + moduli.pressure, expected, 1e-12));
        EXPECT_EQ(moduli.contact, *test.material.normal_stiffness) << "contact points have the modulus of faces";
    }
}

TEST(FaceRock, HasTheFrictionOfItsParticlesIfTheCaseStatesNone) {
    const testing::ScratchFolder scratch;
    const ResolvedCase test = face_case(scratch, FaceRock{});
    Specimen specimen = make_specimen(test, test, {});
    World world = bond_alone(specimen, test.bond, test);
    specimen.material.friction_angle.reset();
    for (Material& material : world.settings.materials) material.friction_angle = 27.0;
    const FaceLaw law =
        face_bonding_of(world, specimen, test.bond, PlatenKind::bonded, specimen.mesh_gap).materials.front().law;
    EXPECT_EQ(law.friction, friction_coefficient(27.0));
    EXPECT_EQ(law.residual_friction, friction_coefficient(27.0));
}

TEST(TestWithFaces, BreaksInTensionAndClosesItsEnergyAccount) {
    const testing::ScratchFolder scratch;
    FaceRock rock;
    rock.kind = "tension";
    VirtualTest test = prepare_test(face_case(scratch, rock), {});
    load_specimen(test, {}, nullptr);
    EXPECT_EQ(test.state.ended_by, ended_by_failure);
    EXPECT_GT(test.world.bonds.broken, 10);
    EXPECT_EQ(test.state.breaks_in_shear + test.state.breaks_in_tension, test.world.bonds.broken);
    double error = 0.0, work = 0.0;
    for (std::int64_t k = 0; k <= test.state.failure.peak_row; ++k) {
        const CurveRow& row = test.state.rows[static_cast<std::size_t>(k)];
        error = std::max(error, std::abs(row.energy_error));
        work = std::max(work, row.platen_work);
    }
    EXPECT_TRUE(within("closing error up to the peak, of the work", error / work, 0.0, 5e-4));
    // Uniform stress breaks the first face at its own strength.
    EXPECT_LT(test.state.failure.peak_stress, 1.2 * 10e6);
    EXPECT_GT(test.state.failure.peak_stress, 0.3 * 10e6);
}

struct Refusal {
    const char* name;
    FaceRock rock;
    const char* says;
};

class FaceRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(FaceRefusal, NamesTheKeyTheFindingAndTheRemedy) {
    const testing::ScratchFolder scratch;
    std::string message = "accepted";
    try {
        face_case(scratch, GetParam().rock);
    } catch (const InputError& error) {
        message = error.what();
    }
    fmt::print("  {}\n", message);
    EXPECT_NE(message.find("case.toml:"), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message << "\nexpected: " << GetParam().says;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

FaceRock with_material(const char* material) {
    FaceRock rock;
    rock.material = material;
    return rock;
}

FaceRock with_strengths(const std::string& more) {
    FaceRock rock;
    rock.strengths += "\n" + more;
    return rock;
}

FaceRock by_coulomb(const char* material) {
    FaceRock rock;
    rock.law = "coulomb";
    rock.material = material;
    rock.strengths = "tensile_strength = 10e6\ncohesion = 40e6\nfriction_angle = 40";
    return rock;
}

/// The thickness stands behind the law, whose closing quote is then part of a comment.
FaceRock with_thickness() {
    FaceRock rock;
    rock.law = "face\"\nthick = 1e-4 #";
    return rock;
}

FaceRock by_points() {
    FaceRock rock;
    rock.units = "point";
    rock.material = "youngs_modulus = 70e9\npoissons_ratio = 0.25";
    return rock;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, FaceRefusal,
    ::testing::Values(
        Refusal{"BothModuli",
                with_material("youngs_modulus = 70e9\npoissons_ratio = 0.25\ncontact_modulus = 70e9\n"
                              "stiffness_ratio = 1.6"),
                "material.contact_modulus"},
        Refusal{"NoModulus", with_material("poissons_ratio = 0.25"), "material.youngs_modulus: found nothing"},
        Refusal{"PoissonsRatioOfOne", with_material("youngs_modulus = 70e9\npoissons_ratio = 1.0"),
                "material.poissons_ratio: found 1, expected a number >= 0 and < 1"},
        Refusal{"PoissonsRatioTooSmallForTheStiffnessRatio",
                with_material("youngs_modulus = 70e9\npoissons_ratio = 0.05\nstiffness_ratio = 3"),
                "material.stiffness_ratio"},
        Refusal{"PoissonsRatioTooLargeWithoutAPressure", with_material("youngs_modulus = 70e9\npoissons_ratio = 0.4"),
                "material.poissons_ratio"},
        Refusal{"KneeWithoutASecondAngle", with_strengths("friction_knee = 1e8"),
                "material.friction_knee needs friction_angle_beyond"},
        Refusal{"SecondAngleWithoutAKnee", with_strengths("friction_angle_beyond = 10"),
                "material.friction_angle_beyond needs friction_knee"},
        Refusal{"SecondAngleAboveTheFirst", with_strengths("friction_knee = 1e8\nfriction_angle_beyond = 50"),
                "friction beyond the knee"},
        Refusal{"MomentShareWithoutFaces",
                by_coulomb("contact_modulus = 70e9\nstiffness_ratio = 2\nmoment_share = 0.5"),
                "material.moment_share needs bond.law = \"face\""},
        Refusal{"ResidualCohesionAboveTheCohesion", with_strengths("softening_slip = 1e-6\nresidual_cohesion = 50e6"),
                "residual cohesion"},
        Refusal{"ThicknessOfItsOwn", with_thickness(), "bond.thick"},
        Refusal{"UnitsOfPoints", by_points(), "material.units: found \"point\", expected \"area\" with faces"}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace crackle
