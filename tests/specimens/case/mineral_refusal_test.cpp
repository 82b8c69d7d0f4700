// SPDX-License-Identifier: GPL-3.0-or-later
// Tests minerals that a case refuses; each message names file, line, key, what was found and what was expected.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "solver/base/errors.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/making/make_specimen.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

struct Refusal {
    const char* name;
    const char* minerals;
    const char* says;
};

/// Message for a small case with the minerals appended.
std::string refusal(const std::string& minerals) {
    const testing::ScratchFolder scratch;
    const auto path = testing::write_small_case(scratch / "", {});
    std::ofstream(path, std::ios::app) << minerals;
    try {
        make_specimen(read_case(path), {});
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return "accepted";
}

class MineralRefusal : public ::testing::TestWithParam<Refusal> {};

TEST_P(MineralRefusal, NamesFileLineKeyFindingAndExpectation) {
    const std::string message = refusal(GetParam().minerals);
    EXPECT_NE(message.find("case.toml:"), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message << "\nexpected: " << GetParam().says;
}

// The small case has 14 lines, so the minerals begin at line 15.
INSTANTIATE_TEST_SUITE_P(
    Cases, MineralRefusal,
    ::testing::Values(
        Refusal{"SharesOverOne",
                "[[mineral]]\nname = \"a\"\narea_share = 0.7\n[[mineral]]\nname = \"b\"\narea_share = 0.6\n",
                ":21: mineral[2].area_share: found 0.6, which makes a sum of 1.3, expected a sum of at most 1"},
        Refusal{"SharesUnderOne", "[[mineral]]\nname = \"a\"\narea_share = 0.7\n",
                ":16: mineral[1]: found shares with a sum of 0.7, expected a sum of 1"},
        Refusal{"TwoRests", "[[mineral]]\nname = \"a\"\n[[mineral]]\nname = \"b\"\n",
                "found 2 minerals without area_share, expected at most one"},
        Refusal{"NoRest", "[[mineral]]\nname = \"a\"\narea_share = 1\n[[mineral]]\nname = \"b\"\n",
                "found a mineral without area_share although the others fill the specimen"},
        Refusal{"NoShare", "[[mineral]]\nname = \"a\"\narea_share = 0\n",
                ":18: mineral[1].area_share: found 0, expected a number > 0 and <= 1"},
        Refusal{"NamedTwice", "[[mineral]]\nname = \"a\"\n[[mineral]]\nname = \"a\"\n",
                ":19: mineral[2].name: found \"a\" a second time"},
        Refusal{"NameLikeANumber", "[[mineral]]\nname = \"12\"\n", ":17: mineral[1].name: found \"12\""},
        Refusal{"NoName", "[[mineral]]\narea_share = 1\n",
                ":16: mineral[1].name: found nothing, expected a text in quotes; add it to [[mineral]]"},
        Refusal{"UnknownKey", "[[mineral]]\nname = \"a\"\nhardness = 7\n",
                ":18: mineral.hardness: found an unknown key, expected one of name"},
        Refusal{"NegativeDensity", "[[mineral]]\nname = \"a\"\ndensity = -1\n",
                ":18: mineral[1].density: found -1, expected a number > 0 in kg/m2"},
        Refusal{"OneTable", "[mineral]\nname = \"a\"\n",
                ":16: mineral: found a table, expected a list of tables; write [[mineral]] above each"},
        Refusal{"Dashpot", "[[mineral]]\nname = \"a\"\nnormal_damping = 3\n",
                ":18: mineral[1].normal_damping: found a dashpot, while [material] has no dashpots"},
        Refusal{"NegativeSeed", "[minerals]\nseed = -1\n[[mineral]]\nname = \"a\"\n",
                ":17: minerals.seed: found -1, expected a whole number >= 0"},
        Refusal{"AssignWord", "[minerals]\nassign = \"best\"\n[[mineral]]\nname = \"a\"\n",
                ":17: minerals.assign: found \"best\", expected \"random\" or"},
        Refusal{"NoMinerals", "[minerals]\nseed = 1\n", ":16: minerals: found no [[mineral]]"},
        Refusal{"LabelsUnused", "[minerals]\nlabels = \"x\"\n[[mineral]]\nname = \"a\"\n",
                ":17: minerals.labels needs assign = \"labels\"; add that, or remove the key"},
        Refusal{"LabelsMissing", "[minerals]\nassign = \"labels\"\n[[mineral]]\nname = \"a\"\n",
                ":16: minerals.labels: found nothing, expected a file name"},
        Refusal{"ColourMissing", "[minerals]\nassign = \"image\"\nimage = \"x\"\n[[mineral]]\nname = \"a\"\n",
                ":19: mineral[1].colour: found nothing, expected \"#rrggbb\""},
        Refusal{"ColourWord", "[[mineral]]\nname = \"a\"\ncolour = \"red\"\n",
                ":18: mineral[1].colour: found \"red\", expected \"#rrggbb\""},
        Refusal{"ColourTwice",
                "[[mineral]]\nname = \"a\"\ncolour = \"#AA0000\"\narea_share = 0.5\n[[mineral]]\nname = \"b\"\ncolour "
                "= \"#aa0000\"\n",
                ":22: mineral[2].colour: found \"#aa0000\", which a has"},
        Refusal{"PairUnknown",
                "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\", \"b\"]\nfriction_angle = 1\n",
                ":19: mineral_pair[1].between: found \"b\", expected names of minerals: a"},
        Refusal{"ResidualAboveFriction",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\nfriction_angle = 15\n"
                "residual_friction_angle = 20\n",
                ":21: mineral[1].residual_friction_angle: found 20 deg, expected at most the friction_angle of "
                "mineral[1], 15 deg"},
        Refusal{"StrengthBeyondTheApex",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\nfriction_angle = 45\n"
                "tensile_strength = 30\ncohesion = 20\n",
                ":21: mineral[1].tensile_strength: found 30 N, expected at most cohesion/tan(friction_angle) of "
                "mineral[1], 20 N"},
        Refusal{"NoStrengthAtAll",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\ntensile_strength = 0\ncohesion = 20\n",
                ":20: mineral[1].tensile_strength: found 0, expected a number > 0 in N or Pa"},
        Refusal{"PairBeyondTheApex",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\nfriction_angle = 45\n"
                "tensile_strength = 10\ncohesion = 20\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\n"
                "tensile_strength = 30\n",
                ":25: mineral_pair[1].tensile_strength: found 30 N, expected at most "
                "cohesion/tan(friction_angle) of mineral_pair[1], 20 N"},
        Refusal{"PairRougherWhenBroken",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\nfriction_angle = 30\n"
                "tensile_strength = 10\ncohesion = 20\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\n"
                "residual_friction_angle = 31\n",
                ":25: mineral_pair[1].residual_friction_angle: found 31 deg, expected at most the friction_angle of "
                "mineral_pair[1], 30 deg"},
        Refusal{"NothingInShear",
                "[bond]\nlaw = \"coulomb\"\n[[mineral]]\nname = \"a\"\n[[mineral_pair]]\n"
                "between = [\"a\", \"a\"]\nshear_stiffness = 0\n",
                ":22: mineral_pair[1].shear_stiffness: found 0 N/m, expected a number > 0 with coulomb bonds"},
        Refusal{"StrengthByBackTension", "[[mineral]]\nname = \"a\"\ncohesion = 20\n",
                ":18: mineral[1].cohesion needs bond.law = \"coulomb\""},
        Refusal{"StrengthOfAPairByBackTension",
                "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\ntensile_strength = 20\n",
                ":20: mineral_pair[1].tensile_strength needs bond.law = \"coulomb\""},
        Refusal{"StrengthBesideAFactor",
                "[bond]\nlaw = \"coulomb\"\ntensile_factor = 1\ncohesion_factor = 1\n[[mineral]]\nname = \"a\"\n"
                "cohesion = 20\n",
                ":22: mineral[1].cohesion cannot be given here: bond.cohesion_factor determines this strength for all "
                "bonds"},
        Refusal{"ModulusOfAPoint", "[[mineral]]\nname = \"a\"\ncontact_modulus = 1e9\n",
                ":18: mineral[1].contact_modulus needs units = \"area\"; add that, or remove the key"},
        Refusal{"PairOfOne", "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\"]\n",
                ":19: mineral_pair[1].between: found an array, expected two texts in square brackets"},
        Refusal{"PairTwice",
                "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\nfriction_angle = 1\n"
                "[[mineral_pair]]\nbetween = [\"a\", \"a\"]\nfriction_angle = 1\n",
                ":22: mineral_pair[2].between: found a and a a second time"},
        Refusal{"PairOfNames", "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\n",
                ":18: mineral_pair[1]: found only the names, expected at least one of normal_stiffness"},
        Refusal{"PairDensity", "[[mineral]]\nname = \"a\"\n[[mineral_pair]]\nbetween = [\"a\", \"a\"]\ndensity = 1\n",
                ":20: mineral_pair.density: found an unknown key, expected one of between"}),
    [](const auto& refused) { return refused.param.name; });

}  // namespace
}  // namespace crackle
