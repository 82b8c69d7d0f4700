// SPDX-License-Identifier: GPL-3.0-or-later
// Tests values of summary.json for events, notches, membranes, clocks and profiles set by hand, which whole tests
// rarely produce.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "solver/world/profile.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/results/make_summary.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using testing::agrees;
using testing::within;
using Json = nlohmann::ordered_json;

class SummaryFigures : public ::testing::Test {
  protected:
    VirtualTest prepared(const testing::SmallCase& wanted = {}) const {
        return prepare_test(read_case(testing::write_small_case(scratch_ / "", wanted)));
    }
    static Json summary_of(const VirtualTest& test) {
        return json_of(make_summary(test.description, test.setup, test.state, test.world, {}));
    }
    testing::ScratchFolder scratch_;
};

/// A source that opens in all directions (1), slips (0) or closes in all directions (-1), with the scalar moment of the
/// given magnitude.
AcousticEvent event_of(double magnitude, int sense) {
    AcousticEvent event;
    const double moment = std::pow(10.0, 1.5 * (magnitude + 6.0));
    if (sense == 0)
        event.moment.xy = event.moment.yx = moment;
    else
        event.moment.xx = event.moment.yy = sense * moment;
    return event;
}

// In bins of 0.1, the largest is -6.4 to -6.3, so Mc = -6.35 + 0.2. Above it, 25 magnitudes exceed it by 0.1 and 25 by
// 0.5. For the rule of least distance: above -6.37 (excesses of 0.17 for 10 of 60, 0.32 and 0.72 for 25 each) the law's
// fraction at 0.32 is 0.500, where the first ten end at 0.167. Above -6.2, its fraction at the first magnitude is
// 0.349, and that of the data is 0.
TEST_F(SummaryFigures, OfMagnitudesHaveBothRulesForTheirCompleteness) {
    testing::SmallCase wanted;
    wanted.output += "\nemission = true";
    VirtualTest test = prepared(wanted);
    std::vector<AcousticEvent>& events = test.state.emission.events;
    for (int k = 0; k < 60; ++k) events.push_back(event_of(-6.37, 1));
    for (int k = 0; k < 10; ++k) events.push_back(event_of(-6.2, -1));
    for (int k = 0; k < 25; ++k) {
        events.push_back(event_of(-6.05, 0));
        events.push_back(event_of(-5.65, 0));
    }
    events.resize(events.size() + 2);  // events without a moment
    const Json summary = summary_of(test);
    const Json& b = summary["b_value"];
    EXPECT_TRUE(agrees("Mc by curvature", b["completeness"], -6.15, 1e-12));
    EXPECT_EQ(b["events"], 50);
    const double mean = 0.3, aki = std::log10(std::numbers::e) / mean, value = aki * 49.0 / 50.0;
    EXPECT_TRUE(agrees("b", b["b"], value, 1e-12));
    // Each magnitude differs from the mean by 0.2.
    EXPECT_TRUE(agrees("its error", b["error"], std::log(10.0) * value * value * std::sqrt(50.0 * 0.04 / (50.0 * 49.0)),
                       1e-12));
    // Quantiles of χ² with 100 degrees of freedom, by tables: 74.2219 and 129.5612.
    EXPECT_TRUE(agrees("lower end of its interval", b["interval"][0], aki * 74.2219 / 100.0, 1e-6));
    EXPECT_TRUE(agrees("upper end", b["interval"][1], aki * 129.5612 / 100.0, 1e-6));
    EXPECT_EQ(b["few"], true);
    EXPECT_EQ(b["straight"], false) << "two magnitudes do not determine a line";
    const Json& other = b["least_distance"];
    EXPECT_TRUE(agrees("Mc by the least distance", other["completeness"], -6.37, 1e-12));
    EXPECT_EQ(other["events"], 60) << "only those above, not that magnitude itself";
    const double excess = (10 * 0.17 + 25 * 0.32 + 25 * 0.72) / 60.0;
    EXPECT_TRUE(agrees("b above it", other["b"], std::log10(std::numbers::e) / excess * 59.0 / 60.0, 1e-12));

    const Json& emission = summary["emission"];
    EXPECT_EQ(emission["events"], 122);
    EXPECT_EQ(emission["without_moment"], 2);
    EXPECT_TRUE(agrees("opening, of those that have a moment", emission["opening"], 0.5, 1e-15));
    EXPECT_TRUE(agrees("closing", emission["closing"], 10.0 / 120.0, 1e-15));
    EXPECT_TRUE(agrees("shear", emission["shear"], 50.0 / 120.0, 1e-15));
    EXPECT_TRUE(agrees("largest magnitude", emission["largest_magnitude"], -5.65, 1e-12));
    EXPECT_EQ(emission["speed_from"], "moduli");
    test.state.emission.rule.mean_field = true;
    EXPECT_EQ(summary_of(test)["emission"]["speed_from"], "mean field");
}

TEST_F(SummaryFigures, OfFewMagnitudesHaveNoB) {
    testing::SmallCase wanted;
    wanted.output += "\nemission = true";
    VirtualTest test = prepared(wanted);
    for (int k = 0; k < 49; ++k) test.state.emission.events.push_back(event_of(-6.0 + 0.01 * k, 1));
    const Json b = summary_of(test)["b_value"];
    EXPECT_EQ(b["events"], 49);
    for (const char* none : {"b", "error", "completeness", "straight"}) EXPECT_TRUE(b[none].is_null()) << none;
    EXPECT_TRUE(b["least_distance"]["b"].is_null() && b["least_distance"]["completeness"].is_null());
}

/// Two rows, the second at the peak so far: 3 MN/m at a strain of 1e-3.
void put_peak(VirtualTest& test) {
    test.state.rows.assign(2, CurveRow{});
    CurveRow& row = test.state.rows[1];
    row.axial_strain = 1e-3;
    row.axial_stress = 3e6;
    row.lateral_strain = 2e-4;
    row.platen_work = 5.0;
    row.time = 0.1;
    test.state.failure.peak_row = test.state.failure.largest_row = 1;
    test.state.failure.peak_stress = test.state.failure.largest_stress = 3e6;
    test.state.failure.peak_strain = test.state.failure.strain_at_largest = 1e-3;
}

TEST_F(SummaryFigures, OfANotchedBeamAreByHand) {
    VirtualTest test = prepared();
    put_peak(test);
    test.setup.apparatus.kind = LoadingKind::bending;
    test.setup.apparatus.uniaxial = false;
    test.setup.specimen.notch = 0.05;
    test.setup.specimen.area = 0.04;
    test.setup.specimen.particles = 100;  // each has a size of 0.02 m
    test.setup.apparatus.stress_intensity = 0.5;
    test.setup.apparatus.section = 0.25;
    test.setup.apparatus.length = 0.8;
    test.state.youngs_modulus = 4e9;
    const Json summary = summary_of(test);
    EXPECT_EQ(summary["notch"], 0.05);
    EXPECT_TRUE(agrees("notch over particle", summary["notch_over_particle"], 2.5, 1e-12));
    EXPECT_TRUE(agrees("K_I of the peak so far", summary["fracture_toughness_so_far"], 1.5e6, 1e-12));
    EXPECT_TRUE(agrees("force at the peak so far, N", summary["peak_force_so_far"], 0.75e6, 1e-12));
    EXPECT_EQ(summary["nominal_modulus"], 4e9) << "the linear solution has the section and length of the test";
    EXPECT_TRUE(summary["youngs_modulus"].is_null());
    test.state.failure.failed = true;
    test.state.failure.largest_stress = 4e6;  // the beam carried more after a first break at the notch
    EXPECT_TRUE(agrees("fracture toughness", summary_of(test)["fracture_toughness"], 2e6, 1e-12));
}

// The spring adds its stiffness times the rise, which is the lateral strain times the height.
TEST_F(SummaryFigures, OfASprungShearBoxAreByHand) {
    VirtualTest test = prepared();
    put_peak(test);
    test.state.rows.push_back(test.state.rows[1]);
    test.state.rows[2].lateral_strain = 5e-4;
    test.setup.apparatus.kind = LoadingKind::direct_shear;
    test.setup.apparatus.uniaxial = false;
    test.setup.apparatus.normal_force = 2e5;
    test.setup.apparatus.normal_spring = 1e9;
    test.setup.specimen.width = 0.5;
    test.setup.specimen.height = 0.2;
    const Json summary = summary_of(test);
    EXPECT_TRUE(agrees("normal stress", summary["normal_stress"], 4e5, 1e-12));
    EXPECT_TRUE(agrees("at the peak so far", summary["normal_stress_at_peak_so_far"], (2e5 + 1e9 * 4e-5) / 0.5, 1e-12));
    EXPECT_TRUE(agrees("at the end", summary["normal_stress_end"], (2e5 + 1e9 * 1e-4) / 0.5, 1e-12));
    EXPECT_TRUE(agrees("rise, m", summary["dilation_end"], 1e-4, 1e-12));
}

TEST_F(SummaryFigures, OfTheGuidesLawStateWhatItLoses) {
    VirtualTest test = prepared();
    put_peak(test);
    EXPECT_FALSE(summary_of(test).contains("energy_lost_to_contact_law"));
    test.world.settings.segment_law = SegmentLaw::demseg;
    test.world.account.law_loss = 0.2;
    EXPECT_TRUE(agrees("of the platens' work", summary_of(test)["energy_lost_to_contact_law"], 0.04, 1e-12));
}

TEST_F(SummaryFigures, OfAMembraneAreTheMembranes) {
    testing::SmallCase wanted;
    wanted.kind = "biaxial";
    wanted.output += "\n[confinement]\npressure = 500.0";
    VirtualTest test = prepared(wanted);
    test.world.membrane.wrapped = 7;
    test.world.membrane.open = 3;
    test.world.membrane.work = -0.25;
    test.world.membrane.jumped = -1e-6;
    const Json summary = summary_of(test);
    const Json& membrane = summary["membrane"];
    EXPECT_EQ(membrane["points"], test.world.membrane.points.size());
    EXPECT_EQ(membrane["wrapped"], 7);
    EXPECT_EQ(membrane["open"], 3);
    EXPECT_EQ(membrane["area_jumps"], -1e-6);
    EXPECT_EQ(membrane["work"], -0.25);
    EXPECT_EQ(summary["confining_side"], "membrane");
}

TEST_F(SummaryFigures, OfTheRunAreThoseOfItsClocksAndItsWorld) {
    VirtualTest test = prepared();
    test.setup.specimen.particles = 300;
    test.world.stepping.steps = 5000;
    test.world.list.builds = 17;
    TestTiming timing;
    timing.wall_seconds = 2.5;
    timing.step_seconds = 1.25;
    timing.threads = 3;
    const Json summary = json_of(make_summary(test.description, test.setup, test.state, test.world, timing));
    EXPECT_EQ(summary["list_builds"], 17);
    EXPECT_EQ(summary["wall_seconds"], 2.5);
    EXPECT_EQ(summary["step_seconds"], 1.25);
    EXPECT_EQ(summary["threads"], 3);
    EXPECT_TRUE(agrees("particle steps a second", summary["particle_steps_per_second"], 300 * 5000 / 1.25, 1e-15));
#ifdef __clang__
    const std::string version = fmt::format("{}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
    const std::string version = fmt::format("{}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
    const std::string compiler = summary["compiler"];
    EXPECT_NE(compiler.find(version), std::string::npos) << compiler << ", expected " << version;
}

TEST_F(SummaryFigures, HaveTheirUnitsBesideThem) {
    VirtualTest test = prepared();
    put_peak(test);
    test.description.output.out_of_plane_thickness = 0.5;
    const Json by_point = summary_of(test);
    const Json& units = by_point["units"];
    EXPECT_TRUE(units["peak_stress_so_far"].get<std::string>().starts_with("N/m, ")) << units["peak_stress_so_far"];
    EXPECT_EQ(by_point["peak_stress_so_far_pa"], 6e6) << "3 MN/m over half a metre";
    EXPECT_TRUE(units["peak_stress_so_far_pa"].get<std::string>().starts_with("Pa, "))
        << units["peak_stress_so_far_pa"];
    EXPECT_TRUE(units["peak_strain_so_far"].get<std::string>().starts_with("-, ")) << units["peak_strain_so_far"];
    EXPECT_TRUE(units["time_step"].get<std::string>().starts_with("s")) << units["time_step"];
    EXPECT_TRUE(units["particle_steps_per_second"].get<std::string>().starts_with("1/s, "));
    const Json& columns = by_point["columns"];
    EXPECT_TRUE(columns["axial_stress"].get<std::string>().starts_with("N/m, ")) << columns["axial_stress"];
    EXPECT_TRUE(columns["axial_strain"].get<std::string>().starts_with("-, ")) << columns["axial_strain"];
    EXPECT_TRUE(columns["kinetic_energy"].get<std::string>().starts_with("J")) << columns["kinetic_energy"];
    std::size_t numbers = 0;
    for (const auto& [key, value] : by_point.items()) {
        if (!value.is_number()) continue;
        ++numbers;
        EXPECT_TRUE(units.contains(key)) << key << ": found no unit";
    }
    EXPECT_GT(numbers, 40U);
    for (const auto& [key, unit] : units.items())
        EXPECT_TRUE(by_point.contains(key)) << key << ": unit of a figure that does not exist";

    test.description.material.units = StiffnessUnits::area;
    const Json by_area = summary_of(test);
    EXPECT_TRUE(by_area["units"]["peak_stress_so_far"].get<std::string>().starts_with("Pa, "));
    EXPECT_TRUE(by_area["columns"]["axial_stress"].get<std::string>().starts_with("Pa, "));
    EXPECT_EQ(by_area["peak_stress_so_far_pa"], 3e6) << "in area units, it is already in Pa";
}

// A specimen of 2 m by 1 m: 50 particles have a size of 0.2 m, 10 across the length; 800 have 0.05 m, 40 across.
TEST_F(SummaryFigures, OfValidityAreTheClaimsOfTheKind) {
    VirtualTest test = prepared();
    test.setup.specimen.width = 2.0;
    test.setup.specimen.height = 1.0;
    test.setup.specimen.particles = 50;
    const Json narrow = summary_of(test);
    ASSERT_EQ(narrow["validity"].size(), 2U);
    EXPECT_EQ(narrow["validity"][0]["claim"], "the specimen is at least 20 particles wide");
    EXPECT_EQ(narrow["validity"][0]["holds"], false);
    EXPECT_EQ(narrow["validity"][0]["found"], "10 particles");
    EXPECT_EQ(narrow["validity"][1]["claim"], "the specimen broke between its grips");
    EXPECT_TRUE(narrow["validity"][1]["holds"].is_null()) << narrow["validity"][1];
    EXPECT_EQ(narrow["validity"][1]["found"], "no bond has broken");
    EXPECT_EQ(narrow["valid"], false) << "whatever is not known yet";
    test.setup.specimen.particles = 800;
    const Json wide = summary_of(test);
    EXPECT_EQ(wide["validity"][0]["holds"], true);
    EXPECT_EQ(wide["validity"][0]["found"], "40 particles");
    EXPECT_TRUE(wide["valid"].is_null()) << "not all claims are known";
}

TEST_F(SummaryFigures, OfAProfileAreItsClocks) {
    Profile clocks;
    VirtualTest test = prepared();
    test.setup.specimen.particles = 100;
    test.world.stepping.steps = 50;
    TestTiming timing;
    timing.step_seconds = 10.25;
    EXPECT_FALSE(
        json_of(make_summary(test.description, test.setup, test.state, test.world, timing)).contains("profile"));
    clocks.force_passes = 60;
    clocks.point_steps = 20000;
    clocks.geometry_sampled = {0.25, 4};
    clocks.of(Phase::force) = {4.0, 120};
    clocks.of(Phase::integrate) = {2.5, 50};
    clocks.of(Phase::set_the_rate) = {0.5, 7};
    test.world.workers.profile = &clocks;
    const Json profile = json_of(make_summary(test.description, test.setup, test.state, test.world, timing))["profile"];
    EXPECT_EQ(profile["step_seconds"], 10.0) << "without the time of samples";
    EXPECT_EQ(profile["steps"], 50);
    EXPECT_EQ(profile["force_passes"], 60);
    EXPECT_TRUE(agrees("listed points a particle", profile["points_per_particle"], 4.0, 1e-15));
    EXPECT_TRUE(agrees("force a listed point, ns", profile["force_ns_per_point"], 4e9 / 20000, 1e-15));
    std::map<std::string, Json> phases;
    for (const Json& row : profile["phases"]) phases[row["phase"]] = row;
    const auto expect = [&](const char* phase, double seconds, int calls) {
        SCOPED_TRACE(phase);
        ASSERT_TRUE(phases.contains(phase));
        const Json& row = phases[phase];
        EXPECT_TRUE(agrees("seconds", row["seconds"], seconds, 1e-15));
        EXPECT_TRUE(agrees("share", row["share"], seconds / 10.0, 1e-15));
        EXPECT_EQ(row["calls"], calls);
        EXPECT_TRUE(agrees("ns a particle and step", row["ns_per_particle_step"], seconds * 1e9 / (100 * 50), 1e-15));
        EXPECT_FALSE(row["meaning"].get<std::string>().empty());
    };
    expect("force", 4.0, 120);
    expect("  narrow_phase", 0.25 / 4 * 60, 4);  // mean time of a sample times the number of passes
    expect("integrate", 2.5, 50);
    expect("rate", 0.5, 7);
    expect("rest", 10.0 - 4.0 - 2.5 - 0.5, 0);
    EXPECT_EQ(phases.size(), 13U) << "phases, the geometry's part of one, and the rest";
}

}  // namespace
}  // namespace crackle
