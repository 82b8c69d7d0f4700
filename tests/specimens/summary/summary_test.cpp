// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a summary is unchanged after writing and reading.

#include "specimens/summary/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "solver/base/errors.hpp"
#include "specimens/summary/summary_file.hpp"
#include "specimens/summary/summary_keys.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

TEST(Summary, StatesWhatIsAssignedAndNullWhereItIsNotKnown) {
    Summary s;
    EXPECT_EQ(text_of(s), "{}");
    s.about.kind = LoadingKind::tension;
    s.about.ended_by = std::nullopt;
    s.strength.peak_stress = 2.0;
    s.strength.peak_stress.converted = 4.0;
    s.strength.peak_strain = std::numeric_limits<double>::quiet_NaN();
    s.numerics.axial_strain_rate_range = std::vector<double>{1.0, std::numeric_limits<double>::infinity()};
    s.damage.largest_crack = LargestCrack{.bonds = 3, .height = 0.5};
    s.notices = std::vector<std::string>{"so"};
    s.files.begin_table().emplace_back("curve.csv", FileFigures{7, "0f"});
    EXPECT_EQ(text_of(s), R"({"kind":"tension","ended_by":null,"peak_stress":2.0,"peak_stress_pa":4.0,)"
                          R"("peak_strain":null,"largest_crack":{"bonds":3,"height":0.5},)"
                          R"("axial_strain_rate_range":[1.0,null],"notices":["so"],)"
                          R"("files":{"curve.csv":{"bytes":7,"xxh3":"0f"}}})");
    EXPECT_EQ(text_of(parse_summary(text_of(s))), text_of(s));
}

TEST(Summary, TakesNoValueOfAnotherType) {
    const Summary s = parse_summary(R"({"kind": "torsion", "failed": "yes", "steps": 7.5, 
        "peak_strain": "large", "validity": {"claim": "it holds"}, "emission": [1], "notices": ["so", 3],
        "threads": 1e300, "axial_strain_rate_range": [null, 2], "beauty": 1, "membrane": {"points": null}})");
    EXPECT_TRUE(s.about.kind.stated() && !s.about.kind);
    EXPECT_TRUE(s.about.failed.stated() && !s.about.failed);
    EXPECT_TRUE(s.numerics.steps.stated() && !s.numerics.steps);
    EXPECT_TRUE(std::isnan(s.numerics.axial_strain_rate_range->at(0)));
    EXPECT_TRUE(s.strength.peak_strain.stated() && !s.strength.peak_strain);
    EXPECT_TRUE(s.validity.validity.stated() && !s.validity.validity);
    EXPECT_TRUE(s.emission.stated() && !s.emission);
    EXPECT_EQ(s.notices, (std::vector<std::string>{"so", ""}));
    EXPECT_TRUE(s.run.threads.stated() && !s.run.threads);
    EXPECT_TRUE(s.confinement.membrane && s.confinement.membrane->points.stated());
    EXPECT_FALSE(s.strength.peak_stress.stated());
    for (const char* broken : {"", "[]", "3", "{\"steps\": "})
        EXPECT_EQ(text_of(parse_summary(broken)), "{}") << broken;
    EXPECT_NE(testing::refusal([] {
                  read_summary("s.json", R"({"kind": "torsion"})");
              }).find("s.json: kind: found \"torsion\", expected a kind of test"),
              std::string::npos);
}

TEST(Summary, ListsUnitsOfWhatItStatesInTheSenseOfTheTest) {
    Summary s;
    s.about.title = "no unit";
    s.strength.largest_stress = 1.0;
    s.numerics.axial_strain_rate = 2.0;
    s.numerics.axial_strain_rate.sense = 1;
    Table<std::string> expected;
    expected.emplace_back("largest_stress",
                          "N/m, largest axial stress of the whole test, positive in the direction of loading");
    expected.emplace_back("largest_stress_pa", "Pa, the same value divided by out_of_plane_thickness");
    expected.emplace_back(
        "axial_strain_rate",
        "1/s, axial strain rate given in the case; the mean rate if a callback took control of the platen speed");
    state_units(s);
    EXPECT_EQ(s.units, expected);
    EXPECT_EQ(s.strength.largest_stress.converted, 1.0);
    s.about.material_units = StiffnessUnits::area;
    expected[0].second = "Pa, largest axial stress of the whole test, positive in the direction of loading";
    expected[1].second = "Pa, the same value, which is already in Pa";
    state_units(s);
    EXPECT_EQ(s.units, expected);
    s.about.material_units = StiffnessUnits::point;
    s.out_of_plane_thickness = 0.5;
    state_units(s);
    EXPECT_EQ(s.strength.largest_stress.converted, 2.0);
}

/// Each result has a meaning or, if its name is sufficient, a unit.
TEST(Summary, NamesEachKeyAndItsTables) {
    for (const SummaryKey& key : summary_keys()) EXPECT_TRUE(!key.meaning.empty() || !key.unit.empty()) << key.name;
    const auto count = [](const char* name) { return std::ranges::count(summary_keys(), name, &SummaryKey::name); };
    for (const char* name : {"peak_stress", "crack_rose.*.length", "numerical_errors.*.stated", "files.*.bytes",
                             "numerical_errors.companions.*.steps", "joints[].at_peak.slip", "profile.phases[].share"})
        EXPECT_EQ(count(name), 1) << name;
    EXPECT_EQ(count("stable_time_step"), 3) << "one for each direction";
    EXPECT_EQ(count("crack_rose.tension_to_peak"), 0);
}

}  // namespace
}  // namespace crackle
