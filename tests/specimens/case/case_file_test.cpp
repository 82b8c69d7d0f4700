// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that cases are read completely, or refused with file, line, key, what was found and what was expected.

#include "specimens/case/case_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "solver/base/errors.hpp"
#include "specimens/case/parameters.hpp"
#include "specimens/case/toml_shape.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using testing::ScratchFolder;

constexpr const char* good_case =
    "[packing]\n"
    "count = 50\n"
    "radius_min = 0.01\n"
    "radius_max = 0.02\n"
    "mean_overlap = 1e-4\n"
    "[material]\n"
    "density = 2500\n"
    "normal_stiffness = 1e7\n"
    "shear_stiffness = 2.5e6\n"
    "friction_angle = 27\n"
    "damping_ratio = 0.2\n"
    "[loading]\n"
    "kind = \"tension\"\n"
    "axial_strain_rate = 0.01\n"
    "max_axial_strain = 0.02\n";

class CaseFile : public ::testing::Test {
  protected:
    ResolvedCase read(const std::string& text, const std::string& name = "case.toml") const {
        std::ofstream(scratch_ / name) << text;
        return read_case(scratch_ / name);
    }
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            return error.what();
        }
        return "read without complaint";
    }
    static std::string with(const std::string& old_text, const std::string& new_text) {
        std::string text = good_case;
        const std::size_t at = text.find(old_text);
        EXPECT_NE(at, std::string::npos) << old_text;
        return text.replace(at, old_text.size(), new_text);
    }

    ScratchFolder scratch_;
};

TEST_F(CaseFile, ReadsWhatIsWrittenAndFillsInDefaults) {
    const ResolvedCase test = read(good_case);
    EXPECT_EQ(std::get<parts::CircleCount>(test.packing()->box).count, 50);
    EXPECT_EQ(test.material.density, 2500.0) << "a whole number is a number";
    EXPECT_EQ(test.loading.kind, LoadingKind::tension);
    EXPECT_EQ(test.loading.platens, PlatenKind::glued) << "glued platens are stronger than the rock";
    EXPECT_EQ(test.loading.grip, default_grip);
    EXPECT_EQ(test.loading.strength_drop, 0.1);
    EXPECT_EQ(test.loading.stop_at_share_of_peak, 0.5);
    EXPECT_EQ(test.packing()->seed, 1);
    EXPECT_FALSE(test.mesh.has_value());
    EXPECT_FALSE(test.output.out_of_plane_thickness.has_value());
    EXPECT_EQ(test.output.curve_rows, 2000);
    EXPECT_EQ(test.output.checkpoint_interval, 60.0);
    EXPECT_FALSE(test.numerics.time_step.has_value());
    EXPECT_EQ(test.title, "case") << "the file's name";
}

TEST_F(CaseFile, ResolvedCaseReadsBackToTheSameResolvedCase) {
    const ResolvedCase test = read(with("density = 2500", "density = 2500.1234567890123"));
    std::ostringstream once, twice;
    write_resolved_case(once, test, scratch_ / "out");
    write_resolved_case(twice, read(once.str(), "resolved.toml"), scratch_ / "out");
    EXPECT_EQ(once.str(), twice.str());
    EXPECT_NE(once.str().find("density = 2500.123456789012"), std::string::npos) << once.str();
}

TEST_F(CaseFile, EveryKeyHasASentenceAndEveryDefaultIsInItsRange) {
    for (const Parameter& p : case_parameters()) {
        EXPECT_FALSE(p.sentence.empty()) << p.full_key();
        if (p.kind != ValueKind::integer && p.kind != ValueKind::real) continue;
        if (!p.default_value) continue;
        const double value = p.kind == ValueKind::real ? std::get<double>(*p.default_value)
                                                       : static_cast<double>(std::get<std::int64_t>(*p.default_value));
        EXPECT_TRUE(p.accepts(value)) << p.full_key() << " = " << value;
    }
}

TEST_F(CaseFile, IncludedFileHoldsWhereTheCaseIsSilent) {
    std::ofstream(scratch_ / "rock.toml") << good_case;
    const ResolvedCase test = read("include = \"rock.toml\"\n[loading]\nkind = \"compression\"\n");
    EXPECT_EQ(test.loading.kind, LoadingKind::compression) << "the case's own";
    EXPECT_EQ(*test.loading.axial_strain_rate(), 0.01) << "the included file's";
    EXPECT_EQ(test.case_files.size(), 2u);
    EXPECT_NE(refusal("include = \"rocks.toml\"\n").find(":1: include: found no file"), std::string::npos);
}

TEST_F(CaseFile, ATextIsACaseLikeAFile) {
    const ResolvedCase test = read_case(CaseText{"mine", good_case});
    EXPECT_EQ(test.material.density, 2500.0);
    EXPECT_EQ(test.title, "mine");
    EXPECT_TRUE(test.case_files.empty()) << "no file of its own";
    EXPECT_EQ(test.places.written()->at("material.density"), "mine:7: material.density");
    std::ofstream(scratch_ / "rock.toml") << good_case;
    const std::string include = fmt::format("include = \"{}\"\n", (scratch_ / "rock.toml").string());
    EXPECT_EQ(read_case(CaseText{"mine", include}).case_files.size(), 1U);
    const auto says = [](const CaseText& text) {
        try {
            read_case(text);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(says({"mine", "[packing]\ncount = \"many\"\n"}).substr(0, 45),
              "mine:2: packing.count: found \"many\" (a text),");
}

TEST_F(CaseFile, TablesInJsonAreTheSameCase) {
    const std::string json = R"({"packing": {"count": 50, "radius_min": 0.01, "radius_max": 0.02, "mean_overlap": 1e-4},
        "material": {"density": 2500, "normal_stiffness": 1e7, "shear_stiffness": 2.5e6, "friction_angle": 27,
        "damping_ratio": 0.2}, "loading": {"kind": "tension", "axial_strain_rate": 0.01, "max_axial_strain": 0.02}})";
    const auto resolved = [](const CaseText& text) {
        std::ostringstream out;
        write_resolved_case(out, read_case(text), ".");
        return out.str();
    };
    EXPECT_EQ(resolved({"mine", json, true}), resolved({"mine", good_case}));
    const auto says = [](const char* text) {
        try {
            read_case(CaseText{"mine", text, true});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(says("{\"packing\": {\"count\": 0.5}}").substr(0, 30), "mine: packing.count: found 0.5");
    EXPECT_EQ(says("{\"packing\": {\"count\": null}}"),
              "mine: packing.count: found null, expected a value; leave it out");
    EXPECT_EQ(says("{\"loading\": {\"unload_at_strain\": [1, null]}}"),
              "mine: loading.unload_at_strain[2]: found null, expected a value; leave it out");
    EXPECT_EQ(says("{\"packing\": 3}"),
              "mine: packing: found a whole number, expected a table of keys; write [packing] above them");
    EXPECT_EQ(says("{\"packing\": [{}]}"),
              "mine: packing: found an array, expected a table of keys; write [packing] above them");
    EXPECT_EQ(says("{\"title\": {}}"), "mine: title: found a table, expected a text in quotes");
    EXPECT_EQ(says("[1]"), "mine: found array, expected tables of keys");
    EXPECT_EQ(says("{"), "mine: found no JSON, expected tables of keys");
}

TEST_F(CaseFile, IncludesNestButNotInARing) {
    std::ofstream(scratch_ / "rock.toml") << good_case;
    std::ofstream(scratch_ / "faster.toml") << "include = \"rock.toml\"\n[loading]\naxial_strain_rate = 0.5\n";
    const ResolvedCase test = read("include = \"faster.toml\"\n[packing]\nseed = 8\n");
    EXPECT_EQ(*test.loading.axial_strain_rate(), 0.5) << "the nearer file's";
    EXPECT_EQ(test.case_files.size(), 3u);
    std::ofstream(scratch_ / "rock.toml") << "include = \"faster.toml\"\n";
    EXPECT_NE(refusal("include = \"faster.toml\"\n").find("expected no cycle"), std::string::npos);
}

TEST_F(CaseFile, OwnWayOfSayingItStandsOverTheIncludedFiles) {
    std::ofstream(scratch_ / "rock.toml") << good_case;
    const ResolvedCase test = read("include = \"rock.toml\"\n[loading]\nrate_tolerance = 0.01\n");
    EXPECT_EQ(*test.loading.rate_tolerance(), 0.01);
    EXPECT_EQ(test.loading.axial_strain_rate(), nullptr) << "the included file's";
    EXPECT_FALSE(test.places.gives(CaseKey::loading_axial_strain_rate));
    EXPECT_NE(refusal("include = \"rock.toml\"\n[loading]\nrate_tolerance = 0.01\naxial_strain_rate = 1\n")
                  .find("expected one of them"),
              std::string::npos)
        << "both in one file";
}

TEST_F(CaseFile, EveryOtherWayIsAKeyThatCanBeAbsent) {
    for (const Alternatives& ways : case_alternatives()) {
        for (const auto& way : ways) {
            for (const std::string& full_key : way) {
                const auto& all = case_parameters();
                const auto p =
                    std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.full_key() == full_key; });
                ASSERT_NE(p, all.end()) << full_key;
                EXPECT_TRUE(p->forget) << full_key;
            }
        }
    }
}

TEST_F(CaseFile, PathsAreRelativeToTheFileThatWritesThem) {
    std::filesystem::create_directories(scratch_ / "shared");
    std::ofstream(scratch_ / "shared/rock.toml") << "[particles]\nfile = \"../in_gm.dat\"\n";
    const ResolvedCase test = read(
        "include = \"shared/rock.toml\"\n[loading]\nkind = \"tension\"\naxial_strain_rate = 1\nmax_axial_strain = "
        "0.1\n");
    EXPECT_EQ(std::get<parts::ParticleFile>(test.source).path, scratch_ / "in_gm.dat");
}

struct Refusal {
    const char* name;
    const char* old_text;
    const char* new_text;
    const char* says;
};

class CaseRefusal : public CaseFile, public ::testing::WithParamInterface<Refusal> {};

TEST_P(CaseRefusal, NamesFileLineKeyFindingAndExpectation) {
    const std::string message = refusal(with(GetParam().old_text, GetParam().new_text));
    EXPECT_NE(message.find("case.toml:"), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message << "\nexpected: " << GetParam().says;
}

INSTANTIATE_TEST_SUITE_P(
    Cases, CaseRefusal,
    ::testing::Values(
        Refusal{"UnknownKey", "density", "densitee",
                ":7: material.densitee: found an unknown key, expected one of density"},
        Refusal{"UnknownTable", "[material]", "[materials]", ":6: materials: found an unknown key"},
        Refusal{"WrongType", "density = 2500", "density = \"heavy\"",
                ":7: material.density: found \"heavy\" (a text), expected a number > 0 in kg/m2"},
        Refusal{"TableForAValue", "count = 50", "count = {a = 1}", ":2: packing.count: found a table"},
        Refusal{"NegativeRadius", "radius_min = 0.01", "radius_min = -0.01",
                ":3: packing.radius_min: found -0.01, expected a number > 0 in m"},
        Refusal{"NotANumber", "density = 2500", "density = nan",
                ":7: material.density: found nan, expected a number > 0"},
        Refusal{"Infinite", "density = 2500", "density = inf", ":7: material.density: found inf"},
        Refusal{"FractionOfACircle", "count = 50", "count = 50.5",
                ":2: packing.count: found 50.5 (a number), expected a whole number"},
        Refusal{"FrictionWithoutEnd", "friction_angle = 27", "friction_angle = 90",
                ":10: material.friction_angle: found 90"},
        Refusal{"SpringThatPushes", "shear_stiffness = 2.5e6", "shear_stiffness = -1",
                ":9: material.shear_stiffness: found -1"},
        Refusal{"RadiiExchanged", "radius_min = 0.01", "radius_min = 0.05",
                ":3: packing.radius_min: found 0.05 m, expected at most radius_max"},
        Refusal{"Word", "\"tension\"", "\"torsion\"",
                ":13: loading.kind: found \"torsion\", expected \"compression\" or \"tension\""},
        Refusal{"FrictionalPull", "kind = \"tension\"", "kind = \"tension\"\nplatens = \"frictional\"",
                ":14: loading.platens: found \"frictional\", expected \"glued\" or \"bonded\" with kind = \"tension\""},
        Refusal{"DropOfAllStress", "kind = \"tension\"", "kind = \"tension\"\nstrength_drop = 1.0",
                ":14: loading.strength_drop: found 1, expected a number > 0 and < 1"},
        Refusal{"NoDropAtAll", "kind = \"tension\"", "kind = \"tension\"\nstrength_drop = 0.0",
                ":14: loading.strength_drop: found 0, expected a number > 0 and < 1"},
        Refusal{"MissingKey", "kind = \"tension\"\n", "",
                ":12: loading.kind: found nothing, expected \"compression\" or \"tension\" or \"biaxial\" or "
                "\"brazilian\" or \"bending\" or \"scb\" or \"direct_shear\"; add it to "
                "[loading]"},
        Refusal{"MissingMaterial", "density = 2500\n", "", ":6: material.density: found nothing"},
        Refusal{"HalfADashpot", "damping_ratio = 0.2\n", "normal_damping = 10\n",
                ":6: material.shear_damping: found nothing"},
        Refusal{"TwoSpecimens", "[packing]", "[particles]\nfile = \"x\"\n[packing]",
                ":3: packing: found both [particles] and [packing]"},
        Refusal{"TwoTargets", "mean_overlap = 1e-4", "mean_overlap = 1e-4\nvoid_ratio = 0.2",
                ":6: packing.void_ratio cannot be given here: mean_overlap already determines how far the packing is "
                "compressed; remove the key"},
        Refusal{"MeshWithoutBond", "[loading]", "[mesh]\nkind = \"voronoi\"\nthick = 1e-3\n[loading]",
                "bond.thick: found nothing"},
        Refusal{"BondWithinTheGap", "[loading]",
                "[mesh]\nkind = \"voronoi\"\nthick = 1e-3\n[bond]\nthick = 1e-3\n[loading]",
                "bond.thick: found 0.001 m, expected more than mesh.thick = 0.001 m"},
        Refusal{"CellsBesideRadii", "radius_min = 0.01\nradius_max = 0.02",
                "radius_max = 0.02\ncell_diameter = 0.03\ncell_spread = 0.1",
                ":3: packing.radius_max cannot be given here: cell_diameter and cell_spread determine the sizes"},
        Refusal{"MedianOfUniform", "radius_max = 0.02", "radius_max = 0.02\nradius_median = 0.015",
                ":5: packing.radius_median needs sizes = \"lognormal\"; add that, or remove the key"},
        Refusal{"PressureOfAnotherKind", "[loading]", "[confinement]\npressure = 1\n[loading]",
                "confinement.pressure needs loading.kind = \"biaxial\"; add that, or remove the key"},
        Refusal{"CellsWithoutMesh", "radius_min = 0.01\nradius_max = 0.02", "cell_diameter = 0.03\ncell_spread = 0.1",
                ":3: packing.cell_diameter: found no [mesh] table"},
        Refusal{"CellsWithoutSpread", "radius_min = 0.01\nradius_max = 0.02\nmean_overlap = 1e-4",
                "cell_diameter = 0.03\nmean_overlap = 1e-4\n[mesh]\nkind = \"voronoi\"\nthick = 1e-3",
                "packing.cell_spread: found nothing, expected a number > 0 and <= 1; cell_diameter needs"},
        Refusal{"CellsBySieve", "radius_min = 0.01\nradius_max = 0.02\nmean_overlap = 1e-4",
                "sizes = \"sieve\"\ncell_diameter = 0.03\ncell_spread = 0.1\nmean_overlap = 1e-4\n[mesh]\nkind = "
                "\"voronoi\"\nthick = 1e-3",
                "packing.sizes: found \"sieve\", expected \"uniform\" or \"lognormal\""},
        Refusal{"GapOfBackTensionDerived", "[loading]", "[mesh]\nkind = \"voronoi\"\n[bond]\nthick = 1e-3\n[loading]",
                "mesh.thick: found nothing, expected a number > 0 in m; with back_tension, the amount"},
        Refusal{"BondThicknessOfADerivedGap", "[loading]",
                "tensile_strength = 1\ncohesion = 2\n[mesh]\nkind = \"voronoi\"\n[bond]\nlaw = \"coulomb\"\nthick = "
                "1e-3\n[loading]",
                "bond.thick cannot be given here: mesh.thick is not given and is therefore derived"},
        Refusal{"NotToml", "[packing]", "[packing", ":1: not valid TOML"},
        Refusal{"Twice", "count = 50", "count = 50\ncount = 51", ":3: not valid TOML"}),
    [](const auto& refused) { return refused.param.name; });

TEST_F(CaseFile, MayBeginWithAByteOrderMark) { EXPECT_EQ(read(std::string("\xef\xbb\xbf") + good_case).title, "case"); }

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int k = 0; k < times; ++k) all += text;
    return all;
}

// toml++ parses tables recursively: about 50,000 levels use up the stack of the main thread.
TEST_F(CaseFile, OfManyLevelsIsRefusedBeforeItIsParsed) {
    EXPECT_NE(refusal("\n" + repeated("a.", 50'000) + "a = 1\n").find("case.toml:2: found a line of 100005 bytes"),
              std::string::npos);
    const std::string deep = "found more than 100 dots and brackets in one entry";
    EXPECT_NE(refusal("[" + repeated("a.", 101) + "a]\n").find("case.toml:1: " + deep), std::string::npos);
    EXPECT_NE(refusal("a = [\n" + repeated("[\n", 200)).find("case.toml:101: " + deep), std::string::npos)
        << "in lines";
    EXPECT_NE(refusal("a = [" + repeated("{a.a.a.a = [\n", 60)).find(deep), std::string::npos) << "of both kinds";
}

TEST_F(CaseFile, DotsAndBracketsInTextsAndCommentsAreNoLevels) {
    const std::string many = repeated("[{.", 200), three_single(3, '\''), three_double(3, '"');
    for (const std::string& title :
         {"\"" + many + "\"", "'" + many + "'", three_double + "\\\"" + many + "\n#\"" + many + "\"" + three_double,
          three_single + "\n'" + many + "\n" + three_single, "\"\\\\\"  # " + many})
        EXPECT_NO_THROW(read("title = " + title + "\n" + good_case)) << title;
    EXPECT_NO_THROW(check_toml_shape("numbers", repeated("a = 1.5\n", 1000)));
    EXPECT_NE(refusal("title = \"open" + many + "\n" + good_case).find("case.toml:1: not valid TOML"),
              std::string::npos);
}

TEST_F(CaseFile, LettersBeyondAsciiStandInTextsAndCommentsAlone) {
    EXPECT_EQ(read(std::string("title = \"Gr\xc3\xbc\xc3\x9f"
                               "e\"  # \xcb\xba\n") +
                   good_case)
                  .title,
              "Gr\xc3\xbc\xc3\x9f"
              "e");
    EXPECT_NE(refusal("title = \"\"\ndens\xcb\xba = 1\n").find("case.toml:2: found a non-ASCII letter outside quotes"),
              std::string::npos);
}

TEST_F(CaseFile, TextsBeginKeysAndValuesAlone) {
    EXPECT_NE(refusal("title = +\"\xef\xbf\xbf\"\n").find("case.toml:1: found a non-ASCII letter outside quotes"),
              std::string::npos);
    for (const char* text :
         {"a = -2=\"\xca\x8f\"", "a = [1, 2=\"\xca\x8f\"]", "a = 1[\"\xca\x8f\"]", "a = {b = 1 = \"\xca\x8f\"}"})
        EXPECT_THROW(check_toml_shape("places", text), InputError) << text;
    EXPECT_NO_THROW(check_toml_shape(
        "quotes", "'a' = [\r\n 'c', # d\n\t\"e\" ]\n['f']\nh = {'i' = 'j', 'k' = \"\"\"\xca\x8f\"\"\"}"));
}

TEST_F(CaseFile, TextsOfItAreCutInErrors) {
    const std::string kind = repeated("stretching ", 500);
    EXPECT_NE(refusal(with("\"tension\"", "\"" + kind + "\"")).find("found \"" + kind.substr(0, 40) + "\", expected"),
              std::string::npos);
    EXPECT_LT(refusal(repeated("key", 1000) + " = 1\n" + good_case).size(), 1000u);
}

TEST_F(CaseFile, CellsMayBeInsetByNothing) {
    const char* cells = "[mesh]\nkind = \"voronoi\"\nthick = 1e-3\ninset = 0\n[bond]\nthick = 1.1e-3\n[loading]";
    EXPECT_EQ(std::get<parts::MeshGap>(read(with("[loading]", cells)).mesh->gap).inset, 0.0);
}

TEST_F(CaseFile, SizesOfCellsReplaceTheRadiiOfAnIncludedFile) {
    read(good_case, "rock.toml");
    const ResolvedCase cells = read(
        "include = \"rock.toml\"\n[packing]\ncell_diameter = 0.04\ncell_spread = 0.1\n[mesh]\nkind = "
        "\"voronoi\"\nthick = 1e-3\n[bond]\nthick = 1.1e-3\n");
    EXPECT_EQ(std::get<parts::CellDiameters>(cells.packing()->sizes).mean, 0.04);
    read(
        "include = \"rock.toml\"\n[packing]\ncell_diameter = 0.04\ncell_spread = 0.1\n[mesh]\nkind = "
        "\"voronoi\"\nthick = 1e-3\n[bond]\nthick = 1.1e-3\n",
        "cells.toml");
    const ResolvedCase radii = read("include = \"cells.toml\"\n[packing]\nradius_min = 0.01\nradius_max = 0.02\n");
    EXPECT_EQ(std::get<UniformRadii>(radii.packing()->sizes), (UniformRadii{0.01, 0.02}));
}

TEST_F(CaseFile, MissingFileIsNamed) {
    try {
        read_case(scratch_ / "nowhere.toml");
        FAIL() << "read without complaint";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("nowhere.toml: found no such file"), std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace crackle
