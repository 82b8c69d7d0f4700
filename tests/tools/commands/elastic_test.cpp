// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle elastic` as called by a user.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/claim.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::Answer;

class CrackleElastic : public testing::ProgramCall {
  protected:
    CrackleElastic() : ProgramCall("elastic") { testing::write_small_case(scratch_ / "", {}); }
};

TEST_F(CrackleElastic, AnswersInJsonWithWhatATestWouldHave) {
    const Answer answer = call("case.toml --json --modes 2");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.err.empty()) << answer.err;
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_EQ(json["angular_frequencies"].size(), 2U);
    EXPECT_LT(json["first_slip_stress"].get<double>(), json["first_break_stress"].get<double>());
    EXPECT_LT(json["residual"].get<double>(), 1e-9);
    EXPECT_TRUE(json["stable_time_step_proved"].get<bool>());
    EXPECT_TRUE(agrees("the step a test takes over the exact one",
                       json["time_step"].get<double>() / json["stable_time_step"].get<double>(), 0.8, 1e-12));
    for (const char* key : {"youngs_modulus", "poissons_ratio", "stable_time_step", "first_break_stress"})
        EXPECT_TRUE(json["units"].contains(key) && json[key].is_number()) << key;
    EXPECT_EQ(snapshot().size(), 2U) << "nothing is written without a request";
}

TEST_F(CrackleElastic, SaysPascalWhereTheUnitsAreOfAnArea) {
    testing::SmallCase wanted;
    EXPECT_NE(call("case.toml").out.find("N/m"), std::string::npos);
    wanted.mesh = "voronoi";
    wanted.material =
        "units = \"area\"\ncontact_modulus = 1e7\nstiffness_ratio = 2.5\ntensile_strength = 1.5e4\ncohesion = 5e4";
    wanted.bond = "law = \"coulomb\"";
    testing::write_small_case(scratch_ / "", wanted);
    const Answer figures = call("case.toml"), json = call("case.toml --json -q");
    for (const Answer& answer : {figures, json, testing::Answer(call("case.toml -v"))}) {
        ASSERT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ((answer.out + answer.err).find("N/m"), std::string::npos) << answer.out << answer.err;
    }
    EXPECT_NE(figures.out.find(" MPa, Poisson's ratio"), std::string::npos) << figures.out;
    EXPECT_TRUE(nlohmann::json::parse(json.out)["units"]["first_break_stress"].get<std::string>().starts_with("Pa,"));
}

TEST_F(CrackleElastic, IsOfTheSpecimenWithoutItsConfiningPressureAndSaysSo) {
    testing::SmallCase wanted;
    wanted.kind = "compression";
    testing::write_small_case(scratch_ / "", wanted);
    const auto free = nlohmann::json::parse(call("case.toml --json -q").out);
    wanted.kind = "biaxial";
    wanted.output += "\n[confinement]\npressure = 1e4";
    testing::write_small_case(scratch_ / "", wanted);
    const Answer confined = call("case.toml --json");
    ASSERT_EQ(confined.code, 0) << confined.err;
    EXPECT_NE(confined.err.find("without confining pressure"), std::string::npos) << confined.err;
    for (const char* key : {"youngs_modulus", "poissons_ratio", "first_break_stress"})
        EXPECT_EQ(nlohmann::json::parse(confined.out)[key], free[key]) << key;
}

TEST_F(CrackleElastic, NeverReplacesItsOwnInput) {
    for (const std::string input : {"case.toml", "rock.dat"})
        expect_refused("case.toml -q --force --bonds " + input, input + ": found an input of the same command");
}

TEST_F(CrackleElastic, WritesBondForcesOfHalfTheStrainHalfAsLarge) {
    ASSERT_EQ(call("case.toml -q --strain 1e-4 --bonds full.csv").code, 0);
    ASSERT_EQ(call("case.toml -q --strain 5e-5 --bonds half.csv").code, 0);
    const auto sum = [&](const char* file) {
        std::istringstream in(read(file));
        std::string line;
        std::getline(in, line);
        double total = 0.0;
        for (int rows = 0; std::getline(in, line); ++rows) {
            std::istringstream fields(line);
            std::string field;
            for (int column = 0; column <= 5 && std::getline(fields, field, ','); ++column) {
            }
            total += std::abs(std::stod(field));
        }
        return total;
    };
    EXPECT_GT(sum("full.csv"), 0.0);
    EXPECT_TRUE(agrees("sum of the bonds' normal forces", sum("full.csv"), 2.0 * sum("half.csv"), 1e-12));
}

TEST_F(CrackleElastic, RefusesWhatItCannotUse) {
    write("mine.csv", "1,2\n");
    expect_refused("", "found no CASE.toml");
    expect_refused("absent.toml", "absent.toml");
    expect_refused("case.toml -q --strain 0 --bonds full.csv", "--strain: found 0, expected a number > 0");
    expect_refused("case.toml -q --modes -1", "--modes: found -1");
    expect_refused("case.toml -q --modes 100000", "request fewer modes");
    expect_refused("case.toml -q --bonds mine.csv", "mine.csv: found an existing file");
}

}  // namespace
}  // namespace crackle
