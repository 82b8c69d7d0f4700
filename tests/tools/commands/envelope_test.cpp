// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle envelope` as called by a user: what it reads from folders of tests and campaigns, prints, draws and
// refuses.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "specimens/campaign/campaign.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/campaign/ledger.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/sample_results.hpp"

namespace crackle {
namespace {

using namespace testing;
using Json = nlohmann::ordered_json;

constexpr std::array<double, 6> pressures{0.0, 50.0, 100.0, 200.0, 350.0, 500.0};  // N/m

/// Properties of a generated test.
struct MadeUp {
    int seed = 1;
    double pressure = 0.0;           ///< pressure of a biaxial test
    std::optional<double> strength;  ///< N/m, for a test that failed
    std::string kind = {};           ///< if empty, compression, or biaxial if there is a pressure
    std::string case_text = {};      ///< if empty, the case of the rock
    Json further = Json::object();   ///< further keys of summary.json
};

std::string kind_of(const MadeUp& test) {
    return !test.kind.empty() ? test.kind : test.pressure > 0.0 ? "biaxial" : "compression";
}

std::string case_of(const MadeUp& test, const std::string& cohesion = "2000.0") {
    return fmt::format(
        "[packing]\ncount = 60\nradius_min = 1.333e-2\nradius_max = 2.667e-2\nmean_overlap = 7.74e-5\nseed = {}\n"
        "[material]\ndensity = 2500.0\nnormal_stiffness = 1.0e7\nshear_stiffness = 2.5e6\nfriction_angle = 27.0\n"
        "damping_ratio = 0.2\ntensile_strength = 1000.0\ncohesion = {}\n[bond]\nlaw = \"coulomb\"\n"
        "[loading]\nkind = \"{}\"\nmax_axial_strain = 0.0{}\n{}",
        test.seed, cohesion, kind_of(test), 1 + test.seed % 3,
        test.pressure > 0.0 ? fmt::format("[confinement]\npressure = {}\n", test.pressure) : "");
}

double on_line(double s3) { return 1000.0 + 4.0 * s3; }
double on_curve(double s3) { return s3 + std::sqrt(15.0 * 1000.0 * s3 + 1e6); }

class EnvelopeCommand : public ProgramCall {
  protected:
    EnvelopeCommand() : ProgramCall("envelope") {}

    /// Writes a generated test. @return its folder
    std::string sample(const MadeUp& wanted) const {
        const std::string kind = kind_of(wanted);
        const std::string name = fmt::format("{}{}_{:.0f}", kind.front(), wanted.seed, wanted.pressure);
        SampleTest test;
        test.failed = wanted.strength.has_value();
        if (kind == "tension") test.kind = kind;
        write_sample_results(folder_ / name, test);
        Json summary = Json::parse(read(name + "/summary.json"));
        summary["kind"] = kind;
        summary["seed"] = wanted.seed;
        if (wanted.strength) summary["peak_stress"] = *wanted.strength;
        if (wanted.pressure > 0.0) summary["confining_pressure"] = wanted.pressure;
        summary.update(wanted.further);
        write(name + "/summary.json", summary.dump(2));
        write(name + "/case.toml", wanted.case_text.empty() ? case_of(wanted) : wanted.case_text);
        return name;
    }

    /// Writes three packings whose strengths scatter by 5 %, at the first `count` pressures. @return their folders
    template <class Law>
    std::string three_packings(Law&& law, std::size_t count = pressures.size()) const {
        std::string folders;
        for (const int seed : {1, 2, 3})
            for (std::size_t k = 0; k < count; ++k)
                folders += sample({seed, pressures[k], law(pressures[k]) * (1.0 + 0.05 * (seed - 2))}) + " ";
        return folders;
    }

    Json fitted(const std::string& words) const {
        const Answer answer = call(words + " --json");
        EXPECT_EQ(answer.code, 0) << answer.err;
        return answer.code == 0 ? Json::parse(answer.out) : Json::object();
    }
};

bool mentions(const Json& notices, const std::string& words) {
    return std::ranges::any_of(
        notices, [&](const Json& notice) { return notice.get<std::string>().find(words) != std::string::npos; });
}

TEST_F(EnvelopeCommand, FitsTheTestsOfItsFolders) {
    const std::string folders = three_packings(on_line);
    const Json json = fitted(folders);
    EXPECT_EQ(json["unit"], "N/m");
    EXPECT_EQ(json["packings"], 3);
    const Json& line = json["mohr_coulomb"];
    EXPECT_TRUE(agrees("C, N/m", line["strength"]["value"], 1000.0, 1e-12));
    EXPECT_TRUE(agrees("N", line["slope"]["value"], 4.0, 1e-12));
    EXPECT_TRUE(agrees("friction angle, asin 3/5", line["friction_angle"]["value"], 36.86989764584402, 1e-12));
    EXPECT_TRUE(agrees("cohesion, C/(2 sqrt 4)", line["cohesion"]["value"], 250.0, 1e-12));
    EXPECT_TRUE(agrees("scatter of the packings", json["variation"], 0.05, 1e-9));
    EXPECT_LT(line["strength"]["low"].get<double>(), 1000.0);
    EXPECT_GT(line["strength"]["high"].get<double>(), 1000.0);
    ASSERT_EQ(json["strengths"].size(), pressures.size());
    EXPECT_EQ(json["strengths"][3]["tests"], 3);
    EXPECT_TRUE(agrees("mean at 200 N/m", json["strengths"][3]["mean"], 1800.0, 1e-12));
    const Answer table = call(folders);
    EXPECT_NE(table.out.find("friction angle       36.87 ("), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("  0.2      3       1.8"), std::string::npos) << table.out;
    const Json curved = fitted(three_packings(on_curve));
    EXPECT_TRUE(agrees("m", curved["hoek_brown"]["m"]["value"], 15.0, 1e-6));
    EXPECT_TRUE(agrees("C of Hoek and Brown", curved["hoek_brown"]["strength"]["value"], 1000.0, 1e-6));
    EXPECT_TRUE(agrees("their tensile strength", curved["hoek_brown"]["tensile_strength"],
                       500.0 * (std::sqrt(15.0 * 15.0 + 4.0) - 15.0), 1e-6));
}

TEST_F(EnvelopeCommand, SaysWhatItsNumbersAreWorth) {
    const std::string sound = three_packings(on_curve);
    std::string pulled;
    for (const int seed : {1, 2, 3}) pulled += sample({seed, 0.0, 50.0 + seed, "tension"}) + " ";
    const Json whole = fitted(sound + pulled);
    EXPECT_TRUE(whole["notices"].empty()) << whole["notices"];
    EXPECT_TRUE(agrees("mean of the tensions", whole["tension"]["mean"], 52.0, 1e-12));
    EXPECT_TRUE(agrees("their deviation", whole["tension"]["deviation"], 1.0, 1e-12));
    const double half = 4.302653 / std::sqrt(3.0);  // t for two degrees of freedom
    EXPECT_TRUE(agrees("lower end of their interval", whole["tension"]["low"], 52.0 - half, 1e-6));
    EXPECT_TRUE(agrees("upper end", whole["tension"]["high"], 52.0 + half, 1e-6));
    EXPECT_TRUE(agrees("strength over tension", whole["tension"]["strength_ratio"], 1000.0 / 52.0, 1e-6));
    EXPECT_TRUE(agrees("8.62 + 0.7 m", whole["tension"]["strength_ratio_by_m"], 19.12, 1e-6));

    const Json untensioned = fitted(sound);
    EXPECT_TRUE(untensioned["tension"].is_null());
    EXPECT_TRUE(mentions(untensioned["notices"], "no tension"));
    std::string strong;
    for (const int seed : {1, 2, 3}) strong += sample({seed, 0.0, 200.0, "tension"}) + " ";
    EXPECT_TRUE(mentions(fitted(sound + strong)["notices"], "times that of Hoek and Martin"));

    EXPECT_TRUE(
        mentions(fitted(three_packings(on_curve, 4))["notices"], "4 confinements; Hoek and Brown require at least 5"));
    const auto far = [](double s3) { return 0.9 * on_curve(s3); };  // 500 of 900
    EXPECT_TRUE(mentions(fitted(three_packings(far))["notices"],
                         "the largest confining pressure is 0.56 times the unconfined"));
    const auto steps = [](double s3) { return s3 > 90.0 ? 2500.0 : 1000.0; };
    const Json missed = fitted(three_packings(steps));
    EXPECT_TRUE(mentions(missed["notices"], "Mohr-Coulomb deviates from the mean strengths")) << missed["notices"];
    EXPECT_TRUE(mentions(missed["notices"], "Hoek-Brown deviates from the mean strengths"));
    const auto steep = [](double s3) { return s3 + std::sqrt(80.0 * 1000.0 * s3 + 1e6); };
    EXPECT_TRUE(mentions(fitted(three_packings(steep))["notices"], "lies between 4 and 35 for intact rocks"));
}

TEST_F(EnvelopeCommand, TakesTestsThatHardenByAnotherStress) {
    std::string folders, unfailed;
    for (const int seed : {1, 2, 3})
        for (const double pressure : pressures) {
            MadeUp test{seed, pressure, std::nullopt};
            // Under the highest pressure, the stress still grows at the end.
            test.further = {{"largest_stress", on_line(pressure) * (1.0 + 0.05 * (seed - 2))},
                            {"strain_at_largest_stress", pressure == pressures.back() ? 0.0199 : 0.01},
                            {"axial_strain_end", 0.02}};
            folders += sample(test) + " ";
        }
    expect_refused(folders,
                   "did not fail before loading.max_axial_strain (for specimens that harden, use --figure "
                   "largest_stress or --strain");
    const Json largest = fitted(folders + "--figure largest_stress");
    EXPECT_EQ(largest["measure"]["figure"], "largest_stress");
    EXPECT_TRUE(mentions(largest["notices"], "3 of 18 largest stresses are those at the end of loading"))
        << largest["notices"];
    EXPECT_TRUE(agrees("N", largest["mohr_coulomb"]["slope"]["value"], 4.0, 1e-9));
    EXPECT_NE(call(folders + "--figure largest_stress").out.find("largest stresses of 3 packings in kN/m"),
              std::string::npos);
    // All generated tests have the same curve, so its stress at a strain is the same at every pressure.
    const Json at_strain = fitted(folders + "--strain 5e-4");
    EXPECT_EQ(at_strain["measure"]["strain"], 5e-4);
    EXPECT_TRUE(within("N", at_strain["mohr_coulomb"]["slope"]["value"], 0.0, 1e-6));
    expect_refused(folders + "--strain 0.5", "does not reach a strain of 0.5");
    expect_refused(folders + "--figure youngs_modulus",
                   "expected an axial stress of summary.json: peak_stress, largest");
    expect_refused(folders + "--figure largest_stress --strain 0.1", "--figure: found with --strain");
    expect_refused(folders + "--strain 2", "--strain: found 2, expected a number > 0 and < 1");
}

TEST_F(EnvelopeCommand, LeavesOutWhatHasNoStrengthAndNamesIt) {
    const std::string folders = three_packings(on_line);
    const std::string unfailed = sample({4, 100.0, std::nullopt});
    const std::string held = sample({5, 0.0, 80.0, "tension", "", {{"failed_at", "grip"}}});
    const std::string split = sample({6, 0.0, 9000.0, "brazilian"});
    const Json json = fitted(folders + unfailed + " " + held + " " + split);
    EXPECT_EQ(json["packings"], 3);
    EXPECT_TRUE(mentions(json["notices"],
                         "left out: " + split + ": is a test of kind brazilian, whose peak is not a strength"));
    EXPECT_TRUE(mentions(json["notices"], "left out: " + unfailed + ": did not fail before loading.max_axial_strain"));
    EXPECT_TRUE(mentions(json["notices"], "left out: " + held + ": separated at the grip"));
    EXPECT_TRUE(json["tension"].is_null());
}

TEST_F(EnvelopeCommand, SaysWhatItLacks) {
    expect_refused("", "found no folder of results");
    expect_refused("nowhere", "nowhere: found no such folder");
    std::filesystem::create_directory(folder_ / "empty");
    expect_refused("empty", "summary.json: file not found");
    expect_refused(sample({1, 0.0, 1000.0}) + " " + sample({2, 0.0, 1010.0}), "found 1 confinement and 2 packings");
    std::string one_packing;
    for (const double pressure : pressures) one_packing += sample({1, pressure, on_line(pressure)}) + " ";
    expect_refused(one_packing, "found 6 confinements and 1 packing, ");
    const std::string unfailed = sample({2, 100.0, std::nullopt});
    expect_refused(one_packing + unfailed, "left out: " + unfailed + ": did not fail before loading.max_axial_strain");
    expect_refused(one_packing + "c1_0", "c1_0: found a second compression of packing 1 under 0 N/m");
}

TEST_F(EnvelopeCommand, RefusesTestsThatAreNotOfOneRock) {
    const std::string folders = three_packings(on_line);
    MadeUp other{4, 100.0, 1400.0};
    other.case_text = case_of(other, "2100.0");
    expect_refused(folders + sample(other), "material.cohesion: found 2100, expected 2000 as in c1_0");
    MadeUp area{5, 100.0, 1400.0};
    area.further = {{"material_units", "area"}};
    expect_refused(folders + sample(area), "found stresses in Pa, expected N/m as in c1_0");
    MadeUp without_case{6, 100.0, 1400.0};
    const std::string bare = sample(without_case);
    std::filesystem::remove(folder_ / bare / "case.toml");
    expect_refused(folders + bare, bare + "/case.toml");
}

/// If a case does not state the gap between cells, it depends on the number of cells, which changes with the seed.
TEST_F(EnvelopeCommand, TakesGapsThatWereDerivedForNoDifference) {
    const auto meshed = [&](int seed, double pressure, double thick) {
        MadeUp test{seed, pressure, on_line(pressure)};
        test.case_text = case_of(test) + fmt::format("[mesh]\nkind = \"voronoi\"\nthick = {}\n", thick);
        test.further = {{"initial_width", 0.5}, {"initial_height", 1.0}, {"particles", 200 + seed}};
        return sample(test) + " ";
    };
    std::string folders;
    for (const int seed : {1, 2})
        for (const double pressure : {0.0, 100.0, 200.0})
            folders += meshed(seed, pressure, 0.02 * std::sqrt(0.5 / (200.0 + seed)));
    EXPECT_EQ(fitted(folders)["packings"], 2);
    expect_refused(folders + meshed(3, 100.0, 1e-3), "mesh.thick: found 0.001, expected no value, as in c1_0");
}

/// A campaign's ledger like those of `crackle campaign`, with results set by the test.
class EnvelopeOfCampaign : public EnvelopeCommand {
  protected:
    std::string campaign(const std::string& more = "", int packings = 3) const {
        MadeUp free{1, 0.0, 0.0}, pressed{1, 10.0, 0.0};
        write("free.toml", case_of(free));
        write("pressed.toml", case_of(pressed));
        write("plan.toml", fmt::format("[[test]]\ncase = \"free.toml\"\n[[test]]\ncase = \"pressed.toml\"\n"
                                       "[[axis]]\nkey = \"confinement.pressure\"\nvalues = [50, 100.0, 200.0, 350.0]\n"
                                       "tests = [\"pressed\"]\n{}[packings]\ncount = {}\n",
                                       more, packings));
        const Plan plan = read_plan(folder_ / "plan.toml");
        std::filesystem::create_directories(folder_ / "out");
        CampaignLedger ledger = CampaignLedger::open(ledger_file(folder_ / "out"));
        FileHashes files;
        std::vector<std::string> identities;
        for (const PlanRow& row : plan.rows) identities.push_back(identity_of(plan.test_of(row), files));
        ledger.set_plan(plan, identities);
        for (std::size_t k = 0; k + 1 < plan.rows.size(); ++k) {  // the last test has not been run
            const ResolvedCase test = plan.test_of(plan.rows[k]);
            const double pressure = test.pressure();
            RowResult result;
            result.identity = identities[k];
            result.state = k + 2 == plan.rows.size() ? row_unstable : row_done;
            if (result.state == row_done) {
                result.figures = {{"kind", name_of(test.loading.kind)}, {"material_units", "point"}, {"failed", 1.0}};
                result.figures.emplace_back(
                    "peak_stress", on_line(pressure) * (1.0 + 0.05 * (static_cast<double>(plan.rows[k].seed) - 2.0)));
                if (pressure > 0.0) result.figures.emplace_back("confining_pressure", pressure);
            }
            ledger.record(result, "here");
        }
        return "out";
    }
};

TEST_F(EnvelopeOfCampaign, FitsTheTestsOfItsLedgerAndOfFoldersBesideIt) {
    const Json json = fitted(campaign());
    EXPECT_EQ(json["packings"], 3);
    ASSERT_EQ(json["strengths"].size(), 5U);
    EXPECT_EQ(json["strengths"][2]["tests"], 3);
    EXPECT_EQ(json["strengths"][4]["tests"], 2);
    EXPECT_TRUE(agrees("mean at 100 N/m", json["strengths"][2]["mean"], 1400.0, 1e-12));
    EXPECT_TRUE(mentions(json["notices"], "left out: out, pressed, confinement.pressure = 350: not run yet"));
    EXPECT_TRUE(mentions(json["notices"], "left out: out, pressed, confinement.pressure = 200: gone wrong (unstable)"));
    const Json both = fitted("out " + sample({4, 100.0, 1500.0}));
    EXPECT_EQ(both["packings"], 4);
    EXPECT_EQ(both["strengths"][2]["tests"], 4);
    expect_refused("out " + sample({2, 100.0, 1400.0}), "found a second compression of packing 2 under 100 N/m");
    MadeUp other{5, 100.0, 1400.0};
    other.case_text = case_of(other, "1900.0");
    expect_refused("out " + sample(other), "material.cohesion: found 1900, expected 2000 as in out");
}

TEST_F(EnvelopeOfCampaign, OfAnAxisOverTheRockIsRefused) {
    // Reading a ledger leaves SQLite's own files beside it.
    for (const char* axis : {"values = [20.0, 27.0]", "values = [20.0]\ntests = [\"free\"]"}) {
        const Answer answer = call(campaign(fmt::format("[[axis]]\nkey = \"material.friction_angle\"\n{}\n", axis)));
        EXPECT_EQ(answer.code, 2) << axis;
        EXPECT_NE(answer.err.find("material.friction_angle: found 27, expected 20 as in out"), std::string::npos)
            << answer.err;
        std::filesystem::remove_all(folder_ / "out");
    }
    EXPECT_EQ(fitted(campaign(
                  "[[axis]]\nkey = \"material.friction_angle\"\nvalues = [27]\ntests = [\"free\"]\n"))["packings"],
              3);
}

/// A line of an SVG: its points in pt, and its colour.
struct SvgLine {
    std::string style;
    std::vector<std::pair<double, double>> points;
};

std::vector<SvgLine> svg_lines(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<SvgLine> lines;
    for (const pugi::xpath_node& node : document.select_nodes("//*[local-name()='path']")) {
        SvgLine line;
        const char* style = node.node().attribute("style").value();
        line.style = *style != '\0' ? style : node.node().attribute("stroke").value();
        std::vector<double> numbers;
        for (const char* at = node.node().attribute("d").value(); *at != '\0';) {
            char* end = nullptr;
            const double value = std::strtod(at, &end);
            if (end == at)
                ++at;
            else
                numbers.push_back(value), at = end;
        }
        for (std::size_t k = 0; k + 1 < numbers.size(); k += 2) line.points.emplace_back(numbers[k], numbers[k + 1]);
        lines.push_back(line);
    }
    return lines;
}

TEST_F(EnvelopeCommand, DrawsRoundCirclesThatBothEnvelopesTouch) {
    const std::string folders = three_packings(on_line);
    const Answer answer = call(folders + "-o envelope.svg");
    ASSERT_EQ(answer.code, 0) << answer.err;
    std::vector<SvgLine> circles;
    std::optional<SvgLine> line;  // the last dashed line
    for (const SvgLine& one : svg_lines(read("envelope.svg"))) {
        if (one.points.size() >= 2 && one.style.find("dasharray") != std::string::npos) line = one;
        if (one.points.size() != 201) continue;
        const auto& p = one.points;
        const double cx = 0.5 * (p.front().first + p.back().first), cy = p.front().second;
        const double radius = 0.5 * (p.front().first - p.back().first);
        const bool round = radius > 0.0 && std::ranges::all_of(p, [&](const auto& at) {
                               return std::abs(std::hypot(at.first - cx, at.second - cy) - radius) < 2e-2;
                           });
        if (round) circles.push_back(one);
    }
    ASSERT_EQ(circles.size(), pressures.size());
    ASSERT_TRUE(line);
    const auto [x1, y1] = line->points.front();
    const auto [x2, y2] = line->points.back();
    // With equal scales tan φ = (N - 1)/(2 sqrt N) = 3/4, and the line touches each circle of its own law.
    EXPECT_TRUE(agrees("slope of the line", (y1 - y2) / (x2 - x1), 0.75, 1e-3));
    for (const SvgLine& circle : circles) {
        const double cx = 0.5 * (circle.points.front().first + circle.points.back().first);
        const double cy = circle.points.front().second;
        const double radius = 0.5 * (circle.points.front().first - circle.points.back().first);
        const double distance = std::abs((x2 - x1) * (cy - y1) - (cx - x1) * (y2 - y1)) / std::hypot(x2 - x1, y2 - y1);
        EXPECT_TRUE(within("distance of the line from the centre, pt", distance, radius, 0.05));
    }
    expect_refused(folders + "-o envelope.svg", "envelope.svg");
    expect_refused(folders + "-o envelope.bmp", "expected svg, pdf or png");
    EXPECT_EQ(call(folders + "-o envelope.png --columns 1 --dpi 40").code, 0);
    EXPECT_EQ(call(folders + "-o envelope.svg --force --title Rock").code, 0);
}

}  // namespace
}  // namespace crackle
