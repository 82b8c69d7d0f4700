// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what a calibration prints and writes, for an outcome set by hand.

#include "specimens/calibration/outcome_files.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "tests/specimens/calibration/known_rock.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::target_text;

class OutcomeFiles : public testing::KnownRock {
  protected:
    /// One target, one key varied by ratios and one by differences; neither key is determined.
    Rock rock() const {
        return rock_of(target_text("compression", "peak_stress", 100.0, "tolerance = 0.02\nerror = 0.01") +
                           "[[free]]\nkey = \"material.tensile_strength\"\nfrom = 1e6\nto = 10e6\n"
                           "[[free]]\nkey = \"material.residual_friction_angle\"\nfrom = 0\nto = 20\n",
                       4, 4, 8);
    }
    /// Five of eight fresh packings gave a result: mean 104, deviation 10, standard error 10/sqrt(5).
    static CalibrationOutcome outcome() {
        CalibrationOutcome all;
        const std::array fresh{94.0, 94.0, 104.0, 114.0, 114.0};
        const std::array polish{90.0, 100.0, 100.0, 110.0};
        ReachedTarget target;
        target.fresh = mean_of(fresh);
        target.polish = mean_of(polish);
        target.off = 0.04;
        target.limit = 0.123;
        target.without_peak = 2;
        target.verdict = TargetVerdict::reached_within_error;
        all.targets = {target};
        all.keys = {{.value = 2e7, .low = 1e6, .high = 1e8, .determined = false},
                    {.value = 5.0, .low = 0.0, .high = 20.0, .determined = false}};
        all.undetermined = {{{1.35, -0.2}, 0.25}};
        return all;
    }
};

TEST_F(OutcomeFiles, TableHasMeanErrorScatterAndWhatIsAllowed) {
    const std::string text = calibration_text(rock(), outcome());
    const std::size_t line = text.find("peak_stress of compression, Pa");
    ASSERT_NE(line, std::string::npos) << text;
    std::istringstream cells(text.substr(line + std::string("peak_stress of compression, Pa").size()));
    std::vector<std::string> words;
    for (std::string word; words.size() < 9 && cells >> word;) words.push_back(word);
    // columns: value, mean, ± error, scatter, difference, tolerance
    const std::vector<std::string> expected{"100", "104", "4.5", "10", "+4.0", "%", "12.3", "%", "reached"};
    EXPECT_EQ(words, expected) << text;
    EXPECT_NE(text.find("5 of 8 fresh packings have all targets' figures"), std::string::npos) << text;
    EXPECT_NE(text.find("2 of 8 fresh packings have no peak"), std::string::npos) << text;
    // 200 packings in each group: (10/1)² for each mean to be known to half the tolerance, times 2 for the error of a
    // difference.
    EXPECT_NE(text.find("leaves an error of ±12.30 %, more than the tolerance of 2.00 %; 200 of each"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("material.tensile_strength times 1.35, material.residual_friction_angle -4 shifts"),
              std::string::npos)
        << text;
    CalibrationOutcome whole = outcome();
    whole.targets[0].fresh = mean_of(std::array{94.0, 94.0, 94.0, 104.0, 104.0, 114.0, 114.0, 114.0});
    EXPECT_EQ(calibration_text(rock(), whole).find("have all targets' figures"), std::string::npos);
}

TEST_F(OutcomeFiles, JsonHasTheSameNumbersByTheirNames) {
    const auto json = calibration_json(rock(), outcome());
    const auto& target = json["targets"][0];
    EXPECT_EQ(target["tolerance"], 0.02);
    EXPECT_EQ(target["error"], 0.01);
    EXPECT_EQ(target["off"], 0.04);
    EXPECT_EQ(target["limit"], 0.123);
    EXPECT_EQ(target["fresh"]["packings"], 5);
    EXPECT_TRUE(agrees("mean", target["fresh"]["mean"], 104.0, 1e-12));
    EXPECT_TRUE(agrees("deviation", target["fresh"]["deviation"], 10.0, 1e-12));
    EXPECT_TRUE(agrees("its error", target["fresh"]["standard_error"], 10.0 / std::sqrt(5.0), 1e-12));
    const double half = 2.776445 * 10.0 / std::sqrt(5.0);  // t for four degrees of freedom
    EXPECT_TRUE(agrees("lower end", target["fresh"]["interval"][0], 104.0 - half, 1e-6));
    EXPECT_TRUE(agrees("upper end", target["fresh"]["interval"][1], 104.0 + half, 1e-6));
    EXPECT_TRUE(agrees("polish", target["polish"]["mean"], 100.0, 1e-12));
    const auto& step = json["undetermined"][0]["step"];
    EXPECT_EQ(step["material.tensile_strength"]["times"], 1.35);
    EXPECT_TRUE(agrees("degrees", step["material.residual_friction_angle"]["plus"], -4.0, 1e-12));
    EXPECT_EQ(json["undetermined"][0]["change"], 0.25);
}

}  // namespace
}  // namespace crackle
