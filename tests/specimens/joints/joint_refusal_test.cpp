// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that incompatible keys of joints are refused with the key, what was found and a remedy, and that valid
// combinations are unchanged after writing and reading.

#include <gtest/gtest.h>

#include <sstream>

#include "specimens/case/case_file.hpp"
#include "specimens/case/joint_checks.hpp"
#include "tests/specimens/joints/cases.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::joint_refusal_test {
namespace {

std::string refused(const std::string& text) {
    return testing::refusal([&] { testing::joints_of(text); });
}
std::string of_set(const std::string& keys) { return refused("[[joint_set]]\nname = \"a\"\n" + keys); }

TEST(JointRefusals, ALawHasItsOwnKeysAndNoOthers) {
    for (const auto& [keys, says] : {
             std::pair{"angle = 0.0\n",
                       "joint_set[1]: found no amount, expected one of number, p10, p20, p21, spacing"},
             {"angle = 0.0\np21 = 1.0\nspacing = 0.1\n", "found p21 and spacing"},
             {"spacing = 0.1\n", "joint_set[1].angle: found nothing"},
             {"angle = 0.0\nkappa = 3.0\nspacing = 0.1\n", "orientation = \"fixed\" does not use it"},
             {"orientation = \"von_mises\"\nangle = 0.0\nspacing = 0.1\n", "joint_set[1].kappa: found nothing"},
             {"orientation = \"fisher\"\ndip = 10.0\ndip_direction = 0.0\nfisher_k = 3.0\nspacing = 0.1\n",
              "joints.section_trend: found nothing"},
             {"angle = 0.0\nlength = \"gaps\"\nlength_mean = 1.0\nspacing = 0.1\n",
              "joint_set[1].gap_mean: found nothing"},
             {"angle = 0.0\nlength_mean = 1.0\nspacing = 0.1\n", "length = \"persistent\" does not use it"},
             {"angle = 0.0\nlength = \"exponential\"\nlength_mean = 1.0\nspacing = 0.1\n",
              "expected \"persistent\" or \"gaps\""},
             {"angle = 0.0\nlength = \"uniform\"\nlength_mean = 1.0\nlength_deviation = 1.0\np21 = 1.0\n",
              "less than length_mean = 1 m"},
             {"angle = 0.0\nlength = \"power_law\"\nlength_min = 1.0\nlength_max = 1.0\nlength_exponent = 2.0\np21 = "
              "1.0\n",
              "less than length_max"},
             {"angle = 0.0\nspacing = 0.1\nspacing_law = \"lognormal\"\n",
              "joint_set[1].spacing_deviation: found nothing"},
             {"angle = 0.0\np21 = 0.1\nspacing_law = \"fixed\"\n",
              "joint_set[1].spacing_law needs spacing as the amount"},
             {"angle = 0.0\np20 = 0.1\n", "lines have no midpoints"},
             {"angle = 0.0\nspacing = 0.1\nthrough = [1.0]\n", "found 1 number, expected two"},
             {"angle = 0.0\nspacing = 0.1\nscan_line = 3.0\n", "joint_set[1].scan_line needs p10 as the amount"},
             {"angle = 0.0\nspacing = -0.1\n", "expected a number > 0 in m"},
             {"angle = 0.0\nspacing = 0.1\nspacings = 0.1\n", "found an unknown key"},
         }) {
        EXPECT_NE(of_set(keys).find(says), std::string::npos) << keys << says;
    }
}

TEST(JointRefusals, NamesAndTracesAreChecked) {
    const std::string set = "[[joint_set]]\nname = \"a\"\nangle = 0.0\nspacing = 0.1\n";
    for (const auto& [text, says] : {
             std::pair{set + set, "joint_set[2].name: found \"a\" a second time"},
             {"[joints]\nseed = 3\n", "joints: found no [[joint_set]] or [[trace]]"},
             {"[joints]\nsection_trend = 3.0\n" + set,
              "joints.section_trend needs a set with orientation = \"fisher\""},
             {"[[trace]]\nname = \"t\"\n", "trace[1]: found neither points nor a file"},
             {"[[trace]]\npoints = [0.0, 0.0, 1.0, 1.0]\nfile = \"f\"\n", "trace[1]: found points and a file"},
             {"[[trace]]\npoints = [0.0, 0.0, 1.0]\n", "found 3 numbers, expected x and y of at least two points"},
             {"[[trace]]\npoints = [0.5, 0.25, 0.5, 0.25, 0.5, 0.25]\n",
              "trace[1].points: found points that coincide, expected at least two different points"},
             {"[[trace]]\npoints = [0.0, 0.0, 1.0, 1.0]\nscale = 2.0\n", "trace[1].scale needs a file"},
             {"[[trace]]\nfile = \"f\"\noffset = [1.0]\n", "trace[1].offset: found 1 number"},
         }) {
        EXPECT_NE(refused(text).find(says), std::string::npos) << says;
    }
}

TEST(JointRefusals, MechanicsOfAJointGoTogether) {
    const std::string set = "angle = 0.0\nspacing = 0.1\n";
    for (const auto& [keys, says] : {
             std::pair{"bonded = false\nstrength_factor = 0.5\n",
                       "joint_set[1].strength_factor cannot be given here: an open joint"},
             {"bonded = false\ncohesion = 1e6\n", "an open joint has no bonds"},
             {"bonded = false\nfriction_angle = 30.0\nresidual_friction_angle = 20.0\n",
              "friction_angle applies to its faces"},
             {"aperture = 1e-4\n", "joint_set[1].aperture: found 0.0001 m, expected no aperture for a bonded joint"},
             {"tensile_strength = 1e5\ncohesion = 1e6\nstrength_factor = 0.5\n", "already replace it"},
             {"friction_angle = 20.0\nresidual_friction_angle = 25.0\n", "at most friction_angle, 20 deg"},
             {"dilation_slip = 1e-3\n", "joint_set[1].dilation_slip needs a dilation_angle > 0"},
             {"normal_stiffness = 0.0\n", "expected a number > 0 in Pa/m"},
             {"friction_angle = 90.0\n", "joint_set[1].friction_angle: found 90"},
             {"bonded = 1\n", "joint_set[1].bonded: found 1"},
         }) {
        EXPECT_NE(of_set(set + keys).find(says), std::string::npos) << keys << says;
    }
    EXPECT_NE(refused("[[trace]]\npoints = [0.0, 0.0, 1.0, 1.0]\naperture = 1e-3\n").find("trace[1].aperture"),
              std::string::npos);
}

/// A rock with coulomb bonds and a joint.
std::string of_rock(const std::string& keys, const std::string& thick = "") {
    const testing::ScratchFolder folder;
    std::ofstream(folder / "case.toml") << R"([packing]
width = 0.5
height = 1.0
radius_min = 0.01
radius_max = 0.02
mean_overlap = 1e-5
[material]
density = 2500.0
units = "area"
contact_modulus = 50e9
stiffness_ratio = 2.5
friction_angle = 40.0
residual_friction_angle = 25.0
tensile_strength = 5e6
cohesion = 15e6
[mesh]
kind = "voronoi"
)" << thick << "[bond]\nlaw = \"coulomb\"\n[loading]\nkind = \"compression\"\nmax_axial_strain = 0.01\n"
                                        << "[[trace]]\npoints = [0.0, 0.5, 0.5, 0.6]\n"
                                        << keys;
    return testing::refusal([&] { read_case(folder / "case.toml"); });
}

TEST(JointRefusals, MechanicsGoWithTheRocks) {
    for (const auto& [keys, says] : {
             std::pair{"residual_friction_angle = 41.0\n", "at most the rock's friction_angle, 40 deg"},
             {"dilation_angle = 26.0\n", "at most the friction angle of the sliding joint, 25 deg"},
             {"dilation_angle = 26.0\nfriction_angle = 30.0\n", "accepted"},
             {"cohesion = 1e6\n", "trace[1].cohesion: found a tensile strength of 5e+06 Pa"},
             {"cohesion = 1e6\ntensile_strength = 0.0\n", "accepted"},
             {"friction_angle = 80.0\n", "trace[1].friction_angle: found a tensile strength"},
             {"strength_factor = 0.0\n", "accepted"},
             {"bonded = false\nfriction_angle = 80.0\n", "accepted"},
         }) {
        EXPECT_NE(of_rock(keys).find(says), std::string::npos) << keys << says;
    }
    EXPECT_NE(of_rock("bonded = false\naperture = 1.1e-3\n", "thick = 1e-3\n")
                  .find("trace[1].aperture: found 0.0011 m, expected at most the gap of the mesh, 0.001 m"),
              std::string::npos);
    EXPECT_EQ(of_rock("bonded = false\naperture = 0.9e-3\n", "thick = 1e-3\n"), "accepted");
    const std::string other = testing::refusal([&] {
        const testing::ScratchFolder folder;
        std::ofstream(folder / "case.toml")
            << testing::rock << "[[trace]]\npoints = [0.0, 0.5, 0.5, 0.6]\nbonded = false\n";
        read_case(folder / "case.toml");
    });
    EXPECT_NE(other.find("trace[1].bonded: found a value with bond.law = \"back_tension\", expected bond.law = "
                         "\"coulomb\" or \"face\" and material.units = \"area\""),
              std::string::npos);
}

TEST(JointRefusals, ARefusalNamesFileAndLine) {
    EXPECT_NE(of_set("angle = 0.0\nkappa = 3.0\nspacing = 0.1\n")
                  .find("joints.toml:4: joint_set[1].kappa cannot be given here"),
              std::string::npos);
}

TEST(ResolvedJoints, AreReadAgain) {
    const testing::ScratchFolder folder;
    std::ofstream(folder / "joints.toml") << testing::rock + R"([joints]
seed = 5
section_trend = 20.0
[[joint_set]]
name = "planes"
orientation = "fisher"
dip = 30.0
dip_direction = 100.0
fisher_k = 50.0
length = "gaps"
length_mean = 0.3
gap_mean = 0.1
spacing = 0.2
through = [0.1, 0.2]
[[trace]]
file = "survey.txt"
scale = 0.001
)";
    std::ofstream(folder / "survey.txt") << "0 0 1 1\n";
    const ResolvedCase test = read_case(folder / "joints.toml");
    std::filesystem::create_directory(folder / "out");
    std::ostringstream text;
    write_resolved_case(text, test, folder / "out");
    std::ofstream(folder / "out" / "case.toml") << text.str();
    const ResolvedCase again = read_case(folder / "out" / "case.toml");
    ASSERT_EQ(again.joints.sets.size(), 1U);
    EXPECT_EQ(again.joints.sets[0].amount.through, (Vec2{0.1, 0.2}));
    EXPECT_EQ(again.joints.sets[0].directions.mean(), test.joints.sets[0].directions.mean());
    EXPECT_EQ(std::get<TraceFile>(again.joints.traces[0].from).path, (folder / "survey.txt").lexically_normal());
    const auto files = files_read(test);
    EXPECT_NE(std::find(files.begin(), files.end(), (folder / "survey.txt").lexically_normal()), files.end());
}

}  // namespace
}  // namespace crackle::joint_refusal_test
