// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle test` as called by a user: exit codes, messages for invalid input, Ctrl-C and resuming.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "solver/files/read_file.hpp"
#include "solver/machine/processors_lent.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/interrupted_call.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::Answer;
using testing::interrupted_call;
using testing::SmallCase;
using testing::write_small_case;

class CrackleTest : public testing::ProgramCall {
  protected:
    CrackleTest() : ProgramCall("test") { write_small_case(folder_, {}); }

    /// Sends Ctrl-C as soon as standard error contains a text. @return code -1 if a signal ended the program, or if it
    /// did not start
    Answer interrupted_at(const std::string& text, std::vector<std::string> words) const {
        int errors[2];
        if (pipe(errors) != 0) return {};
        const pid_t child = fork();
        if (child == 0) {
            words.insert(words.begin(), {CRACKLE_PROGRAM, "test"});
            std::vector<char*> arguments;
            for (std::string& word : words) arguments.push_back(word.data());
            arguments.push_back(nullptr);
            if (chdir(folder_.c_str()) != 0 || dup2(errors[1], STDERR_FILENO) < 0) _exit(127);
            execv(CRACKLE_PROGRAM, arguments.data());
            _exit(127);
        }
        close(errors[1]);
        Answer answer;
        char letter = 0;
        while (answer.err.find(text) == std::string::npos && ::read(errors[0], &letter, 1) == 1) answer.err += letter;
        if (child > 0) kill(child, SIGINT);
        while (::read(errors[0], &letter, 1) == 1) answer.err += letter;
        close(errors[0]);
        int status = 0;
        if (waitpid(child, &status, 0) == child && WIFEXITED(status)) answer.code = WEXITSTATUS(status);
        return answer;
    }
};

TEST_F(CrackleTest, RunsQuietlyInAPipeAndPrintsItsFigures) {
    const Answer answer = call("case.toml -o out");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("circles, tension: the specimen failed"), std::string::npos) << answer.out;
    EXPECT_EQ(answer.err.find('\r'), std::string::npos) << "no progress line in a pipe";
    const Answer quiet = call("case.toml -o quiet -q");
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CrackleTest, CheckPrintsWhatToExpectAndWritesNothing) {
    const auto before = snapshot();
    const Answer answer = call("--check case.toml");
    EXPECT_EQ(answer.code, 0) << answer.err;
    for (const char* part : {"small strain   E ", "first slip ", "first break ", "strength       about ", "steps/s",
                             "MB; making the specimen", "warning: the specimen is 6"})
        EXPECT_NE(answer.out.find(part), std::string::npos) << part << " in\n" << answer.out;
    EXPECT_NE(answer.err.find("bonded "), std::string::npos) << "stages: " << answer.err;
    const Answer quiet = call("case.toml --check -q");
    EXPECT_EQ(quiet.code, 0);
    EXPECT_EQ(quiet.err, "") << "only the result";
    EXPECT_NE(quiet.out.find("strength       about "), std::string::npos);
    EXPECT_TRUE(snapshot() == before) << "files were made";
}

TEST_F(CrackleTest, CheckAnswersInJsonWithTheFiguresOfTheTest) {
    const Answer answer = call("--check case.toml --json");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_EQ(answer.err, "");
    const auto check = nlohmann::json::parse(answer.out);
    ASSERT_EQ(call("case.toml -o out -q").code, 0);
    const auto summary = nlohmann::json::parse(read("out/summary.json"));
    for (const char* key : {"youngs_modulus", "poissons_ratio", "gauge_modulus", "particles"})
        EXPECT_EQ(check[key], summary[key]) << key;
    EXPECT_EQ(check["bonds"], summary["bonds_initial"]);
    const double steps = summary["steps"].get<double>() / summary["axial_strain_end"].get<double>() *
                         check["run_to_max_axial_strain"]["strain"].get<double>();
    EXPECT_TRUE(
        testing::agrees("steps to the end", check["run_to_max_axial_strain"]["steps"].get<double>(), steps, 0.05));
    EXPECT_GT(check["steps_per_second"].get<double>(), 0.0);
    EXPECT_GT(check["memory"].get<double>(), 1e6);
    EXPECT_LT(check["first_slip"]["stress"].get<double>(), check["first_break"]["stress"].get<double>());
    const double ratio = check["strength_estimate"]["stress"].get<double>() / summary["peak_stress"].get<double>();
    fmt::print("  strength estimated over strength: {:.3g}\n", ratio);
    EXPECT_LT(std::abs(std::log(ratio)), std::log(3.0));
}

TEST_F(CrackleTest, CheckWarnsOfWhatWillGoWrong) {
    write_small_case(folder_, {.mesh = "voronoi", .loading = "platens = \"bonded\""});
    replace("case.toml", "thick = 1.0e-3", "thick = 1.0e-4");
    replace("case.toml", "thick = 1.08e-3", "thick = 2.5e-4");
    const std::string pulled = call("--check case.toml").out;
    for (const char* part : {"bonds overlap by 0.0001", "fewer than 20", "bonded platens separate at the platen"})
        EXPECT_NE(pulled.find(part), std::string::npos) << part << " in\n" << pulled;
    EXPECT_EQ(pulled.find("presses a corner"), std::string::npos) << pulled;
    write_small_case(folder_, {.kind = "compression", .mesh = "voronoi"});
    replace("case.toml", "thick = 1.0e-3", "thick = 1.0e-5");
    replace("case.toml", "thick = 1.08e-3", "thick = 9e-5");
    const std::string squeezed = call("--check case.toml").out;
    EXPECT_NE(squeezed.find("at the estimated strength, a platen presses a corner in by"), std::string::npos)
        << squeezed;
}

TEST_F(CrackleTest, CheckNeedsACase) {
    expect_refused("--check", "found no CASE.toml");
    expect_refused("--check nowhere.toml", "nowhere.toml: found no such file");
}

TEST_F(CrackleTest, ResolvedCaseStatesTheDerivedGap) {
    write_small_case(folder_, {.mesh = "voronoi", .numerics = "intact = true"});
    replace("case.toml", "damping_ratio = 0.2\n", "damping_ratio = 0.2\ntensile_strength = 1e3\ncohesion = 3e3\n");
    replace("case.toml", "thick = 1.0e-3\n[bond]\nthick = 1.08e-3", "[bond]\nlaw = \"coulomb\"");
    replace("case.toml", "max_axial_strain = 0.005", "max_axial_strain = 1e-4");
    const Answer first = call("case.toml -o first");
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_NE(first.err.find("by default: 0.02 times the mean cell size"), std::string::npos) << first.err;
    EXPECT_NE(read("first/case.toml").find("\nthick = 0.00"), std::string::npos) << read("first/case.toml");
    ASSERT_EQ(call("first/case.toml -o again -q").code, 0);
    EXPECT_EQ(read("first/curve.csv"), read("again/curve.csv"));
}

TEST_F(CrackleTest, HelpShowsExamplesAndKeysShowUnits) {
    EXPECT_NE(call("--help").out.find("examples:"), std::string::npos);
    EXPECT_NE(call("--keys").out.find("axial_strain_rate        a number > 0 and < 1e+06 in 1/s; optional."),
              std::string::npos)
        << call("--keys").out;
}

TEST_F(CrackleTest, RunsPolygonsUnderTheGuidesLawToFailure) {
    SmallCase wanted;
    wanted.mesh = "delaunay";
    std::map<std::string, double> bonds;
    for (const std::string law : {"rounded", "demseg", "demseg_mean"}) {
        wanted.numerics = fmt::format("contact_law = \"{}\"", law);
        write_small_case(folder_, wanted);
        const Answer answer = call("case.toml -o " + law);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_NE(answer.out.find("delaunay, tension: the specimen failed"), std::string::npos) << answer.out;
        std::ifstream in(folder_ / law / "summary.json");
        const auto summary = nlohmann::json::parse(in);
        fmt::print(
            "  {}: {} bonds, mean back-tension {:.4g} N, E {:.4g} N/m, strength {:.4g} N/m, closing error {:.2g}\n",
            law, summary["bonds_initial"].get<int>(), summary["mean_back_tension"].get<double>(),
            summary["youngs_modulus"].get<double>(), summary["peak_stress"].get<double>(),
            summary["energy_closing_error"].get<double>());
        bonds[law] = summary["bonds_initial"].get<double>();
        EXPECT_EQ(summary.contains("energy_lost_to_contact_law"), law != "rounded");
        EXPECT_LT(std::abs(summary["energy_closing_error"].get<double>()), 0.02) << law;
        EXPECT_EQ(summary["particles"].get<std::size_t>() > 50, true);
    }
    EXPECT_EQ(bonds["demseg"], bonds["demseg_mean"]);
    EXPECT_GT(bonds["demseg"], 1.2 * bonds["rounded"]);
    wanted.numerics = "contact_law = \"round\"";
    write_small_case(folder_, wanted);
    expect_refused("case.toml -o out", "expected \"rounded\" or \"demseg\" or \"demseg_mean\"");
}

TEST_F(CrackleTest, MissingCase) { expect_refused("nowhere.toml -o out", "nowhere.toml: found no such file"); }

TEST_F(CrackleTest, MissingParticleFile) {
    fs::remove(folder_ / "rock.dat");
    expect_refused("case.toml -o out -q", "rock.dat");
}

TEST_F(CrackleTest, TruncatedParticleFile) {
    fs::resize_file(folder_ / "rock.dat", fs::file_size(folder_ / "rock.dat") / 2);
    expect_refused("case.toml -o out -q", "rock.dat:");
}

TEST_F(CrackleTest, UnknownKey) {
    replace("case.toml", "damping_ratio", "damping");
    expect_refused("case.toml -o out", "case.toml:4: material.damping: found an unknown key, expected one of density");
}

TEST_F(CrackleTest, WrongType) {
    replace("case.toml", "damping_ratio = 0.2", "damping_ratio = \"some\"");
    expect_refused("case.toml -o out",
                   "case.toml:4: material.damping_ratio: found \"some\" (a text), expected a number >= 0");
}

TEST_F(CrackleTest, NegativeRadius) {
    replace("rock.dat", "0.02", "-0.02");
    expect_refused("case.toml -o out -q", "rock.dat:");
}

TEST_F(CrackleTest, NotANumber) {
    replace("case.toml", "damping_ratio = 0.2", "damping_ratio = nan");
    expect_refused("case.toml -o out", "case.toml:4: material.damping_ratio: found nan");
}

TEST_F(CrackleTest, AbsurdTimeStep) {
    write_small_case(folder_, {.numerics = "time_step = 1e3"});
    expect_refused("case.toml -o out -q", "case.toml:12: numerics.time_step: found 1000 s, expected at most");
}

TEST_F(CrackleTest, ZeroCircles) {
    Scene empty = testing::small_rock_scene();
    empty.bodies.clear();
    empty.circles.clear();
    std::ofstream out(folder_ / "rock.dat");
    write_geometry(out, empty);
    out.close();
    expect_refused("case.toml -o out -q", "rock.dat");
}

TEST_F(CrackleTest, CellDestroyedByTheInset) {
    write_small_case(folder_, {.mesh = "voronoi"});
    replace("case.toml", "thick = 1.0e-3", "thick = 0.9e-1");
    replace("case.toml", "thick = 1.08e-3", "thick = 1.0e-1");
    expect_refused("case.toml -o out -q", "case.toml:7: mesh.thick: ");
}

TEST_F(CrackleTest, UnwritableFolder) {
    std::ofstream(folder_ / "file") << "in the way\n";
    expect_refused("case.toml -o file -q", "file: found a file, expected a folder or nothing");
    expect_refused("case.toml -o file/out -q", "file/out: cannot be written");
    expect_refused("case.toml -o /proc/crackle -q", "/proc/crackle: cannot be written");
    expect_refused("case.toml -o " + std::string(300, 'x'), "name too long");
}

TEST_F(CrackleTest, PackingOutOfReachNamesTheLineOfItsKey) {
    write(
        "pack.toml",
        "[packing]\ncount = 50\nradius_min = 0.01\nradius_max = 0.02\nvoid_ratio = 0.7\n[material]\ndensity = 2500\n"
        "normal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27\ndamping_ratio = 0.2\n[loading]\nkind = "
        "\"tension\"\naxial_strain_rate = 0.1\nmax_axial_strain = 0.01\n");
    expect_refused("pack.toml -o out -q", "pack.toml:5: packing.void_ratio: found 0.7, expected");
}

TEST_F(CrackleTest, FolderWithResults) {
    ASSERT_EQ(call("case.toml -o out -q").code, 0);
    expect_refused("case.toml -o out -q", "--force replaces them, --resume continues them");
    EXPECT_EQ(call("case.toml -o out -q --force").code, 0);
}

TEST_F(CrackleTest, WrongWords) {
    expect_refused("case.toml", "found no -o OUT");
    expect_refused("-o out", "found no CASE.toml");
    expect_refused("case.toml --resume out", "expected only one of the two");
    expect_refused("case.toml -o out --threads 0", "--threads: found 0");
    expect_refused("case.toml -o out --frobnicate", "frobnicate");
}

nlohmann::json read_json(const fs::path& file) { return nlohmann::json::parse(read_file(file)); }

TEST_F(CrackleTest, ProfileAccountsForTheLoopAndChangesNoNumber) {
    const Answer answer = call("case.toml -o profiled --profile");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.out.find("where the time went"), std::string::npos) << answer.out;
    const auto summary = nlohmann::json::parse(read("profiled/summary.json"));
    const auto& profile = summary["profile"];
    double shares = 0.0, seconds = 0.0;
    std::map<std::string, double> calls;
    for (const auto& row : profile["phases"]) {
        const std::string phase = row["phase"];
        calls[phase] = row["calls"];
        if (phase == "  narrow_phase") continue;
        shares += row["share"].get<double>();
        seconds += row["seconds"].get<double>();
    }
    EXPECT_NEAR(shares, 1.0, 1e-9);
    EXPECT_LE(seconds, summary["wall_seconds"].get<double>());
    for (const auto& row : profile["phases"])
        EXPECT_NEAR(row["seconds"].get<double>(), row["share"].get<double>() * seconds, 1e-9 * seconds) << row["phase"];
    const double steps = summary["steps"];
    // The first force pass is made at bonding, and no drift follows the last one.
    EXPECT_EQ(profile["force_passes"].get<double>(), steps);
    EXPECT_GE(calls["force"], steps);
    EXPECT_GE(calls["integrate"], steps);
    EXPECT_GT(calls["observe"], 100.0);
    EXPECT_LT(calls["broad_phase"], 0.1 * steps);
    ASSERT_EQ(call("case.toml -o plain -q").code, 0);
    EXPECT_FALSE(nlohmann::json::parse(read("plain/summary.json")).contains("profile"));
    for (const char* file : {"curve.csv", "events.csv"})
        EXPECT_TRUE(read(std::string("profiled/") + file) == read(std::string("plain/") + file)) << file;
}

TEST_F(CrackleTest, ShowsTheLargerStressAfterThePeakAndMegapascalWhereThereIsAThickness) {
    const std::string rock =
        "[packing]\ncount = 80\nheight_to_width = 2.0\nradius_min = 1.333e-2\nradius_max = 2.667e-2\n"
        "mean_overlap = 7.74e-5\nseed = 3\n"
        "[material]\ndensity = 2500.0\nnormal_stiffness = 1.0e7\nshear_stiffness = 2.5e6\nfriction_angle = 27.0\n"
        "damping_ratio = 0.2\n"
        "[loading]\nkind = \"compression\"\naxial_strain_rate = 0.02\nmax_axial_strain = 0.02\n"
        "stop_at_share_of_peak = 0.3\n";
    std::ofstream(folder_ / "rubble.toml") << rock << "[output]\nframes = 5\nout_of_plane_thickness = 0.05\n";
    const Answer answer = call("rubble.toml -o thick");
    EXPECT_EQ(answer.code, 0) << answer.err;
    const auto summary = read_json(folder_ / "thick/summary.json");
    const auto shown = [&](const char* key) {
        const double stress = summary[key].get<double>();
        return fmt::format("{:.4g} N/m ({:.4g} kPa) at strain ", stress, stress / 0.05 * 1e-3);
    };
    EXPECT_NE(answer.out.find("  strength " + shown("peak_stress")), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("  largest stress " + shown("largest_stress")), std::string::npos) << answer.out;
    EXPECT_NE(answer.out.find("notice: the largest stress, "), std::string::npos) << answer.out;
    EXPECT_EQ(summary["out_of_plane_thickness"], 0.05);

    std::ofstream(folder_ / "rubble.toml") << rock << "strength_drop = 0.6\n[output]\nframes = 5\n";
    const Answer deep = call("rubble.toml -o deep");
    EXPECT_EQ(deep.code, 0) << deep.err;
    const auto largest = read_json(folder_ / "deep/summary.json");
    EXPECT_EQ(largest["peak_stress"], summary["largest_stress"]) << "with a drop that occurs only at the end";
    EXPECT_EQ(deep.out.find("largest stress"), std::string::npos) << deep.out;
    EXPECT_EQ(deep.out.find("MPa"), std::string::npos) << deep.out;
    EXPECT_TRUE(largest["out_of_plane_thickness"].is_null());
}

TEST_F(CrackleTest, VerifyStatesTheErrorOfTheStrength) {
    EXPECT_EQ(call("case.toml -o out --verify").code, 0);
    const auto summary = read_json(folder_ / "out/summary.json");
    const auto& stress = summary["numerical_errors"]["peak_stress"];
    for (const char* part : {"time_step", "rate", "damping", "resolution", "stated"})
        EXPECT_TRUE(stress[part].is_number()) << part;
    EXPECT_GE(stress["stated"].get<double>(), 3.0 * stress["rate"].get<double>());
    // Spacing of rows in strain over the peak strain; a step may be longer.
    const double spacing = 0.005 / 2000 / summary["peak_strain"].get<double>();
    const double resolution = summary["numerical_errors"]["peak_strain"]["resolution"].get<double>();
    EXPECT_GE(resolution, 0.99 * spacing);
    EXPECT_LE(resolution, 2.0 * spacing);
    EXPECT_TRUE(summary["peak_converged"].is_boolean());
    EXPECT_EQ(summary["numerical_errors"]["companions"].size(), 4U);
    for (const auto& [name, companion] : summary["numerical_errors"]["companions"].items())
        EXPECT_EQ(companion["ended_by"], "failure") << name;
}

TEST_F(CrackleTest, VerifyOfATestThatHasNotFailedJudgesNoPeak) {
    write_small_case(folder_, {.max_strain = 1e-4});
    const Answer answer = call("case.toml -o out --verify");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(read_json(folder_ / "out/summary.json")["peak_converged"].is_null());
    EXPECT_NE(answer.out.find("has not failed; the numerical errors refer to its largest stress"), std::string::npos);
    EXPECT_EQ(answer.out.find("branches"), std::string::npos) << answer.out;
}

TEST_F(CrackleTest, VerifyOfAFinishedTestAddsTheErrorsAndTouchesNothingElse) {
    ASSERT_EQ(call("case.toml -o out -q").code, 0);
    const auto before = read_json(folder_ / "out/summary.json");
    const std::string curve = read_file(folder_ / "out/curve.csv");
    EXPECT_NE(call("--resume out").out.find("nothing is left to do"), std::string::npos);
    EXPECT_EQ(call("--resume out --verify -q").code, 0);
    auto after = read_json(folder_ / "out/summary.json");
    EXPECT_EQ(after["numerical_errors"]["companions"].size(), 4U);
    EXPECT_EQ(read_file(folder_ / "out/curve.csv"), curve);
    for (const char* key : {"peak_stress", "steps", "wall_seconds", "step_seconds", "particle_steps_per_second",
                            "frame_peak", "command", "youngs_modulus"})
        EXPECT_EQ(after[key], before[key]) << key;
    EXPECT_NE(call("--resume out --verify").out.find("nothing is left to do"), std::string::npos);
    fs::remove(folder_ / "out/summary.json");
    EXPECT_EQ(call("--resume out -q").code, 0) << "a lost summary is written again";
    EXPECT_EQ(read_json(folder_ / "out/summary.json")["peak_stress"], before["peak_stress"]);
}

TEST_F(CrackleTest, CtrlCAmongTheCompanionsKeepsTheFinishedTest) {
    write_small_case(folder_, {.rate = 1e-3, .max_strain = 0.005});
    const Answer answer = interrupted_at("verifying", {"case.toml", "-o", "out", "--verify"});
    EXPECT_EQ(answer.code, 130);
    EXPECT_NE(answer.err.find("the test is complete"), std::string::npos) << answer.err;
    const auto summary = read_json(folder_ / "out/summary.json");
    EXPECT_TRUE(summary["failed"].get<bool>());
    EXPECT_FALSE(summary["interrupted"].get<bool>());
    EXPECT_TRUE(summary["peak_converged"].is_null());
}

TEST_F(CrackleTest, CtrlCWhileTheStepOfALargeSpecimenIsSoughtIsHeardBeforeItIsFound) {
    write_small_case(folder_, {.rate = 1e-3, .max_strain = 0.005});
    testing::write_small_rock(folder_ / "rock.dat", 50, 100);
    const Answer answer = interrupted_at("read ", {"case.toml", "-o", "out"});
    EXPECT_EQ(answer.code, 130);
    EXPECT_NE(answer.err.find("interrupted before loading began; nothing was written"), std::string::npos)
        << answer.err;
    EXPECT_EQ(answer.err.find("bonded "), std::string::npos) << answer.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(CrackleTest, LoadingFarFasterThanTheRuleIsSaid) {
    write_small_case(folder_, {.rate = 1.0});
    const Answer fast = call("case.toml -o fast");
    EXPECT_NE(fast.out.find("times the initial rate of rate_tolerance = 0.01"), std::string::npos) << fast.out;
    write_small_case(folder_, {.rate = 1e-3});
    EXPECT_EQ(call("case.toml -o slow").out.find("times the initial rate"), std::string::npos);
}

TEST_F(CrackleTest, BondsDeeperThanTheirFacesAreSaid) {
    write_small_case(folder_, {.mesh = "voronoi"});
    EXPECT_EQ(call("case.toml -o right").out.find("without a common face"), std::string::npos);
    replace("case.toml", "thick = 1.08e-3", "thick = 1.08e-2");
    EXPECT_NE(call("case.toml -o wrong").out.find("without a common face"), std::string::npos);
}

TEST_F(CrackleTest, SignalsToEndEndCleanlyAndResumeEndsWithTheSameCurve) {
    // Slow enough that the signal arrives during loading on any machine.
    write_small_case(folder_, {.rate = 2e-4, .max_strain = 0.005});
    EXPECT_EQ(call("case.toml -o whole -q").code, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        fs::remove_all(folder_ / "out");
        const auto loading_has_begun = [&] { return exists("out/checkpoint"); };
        ASSERT_EQ(interrupted_call(folder_, {"test", "case.toml", "-o", "out", "-q"}, signal, loading_has_begun), 130);
        const auto summary = nlohmann::json::parse(read_file(folder_ / "out/summary.json"));
        EXPECT_TRUE(summary["interrupted"].get<bool>());
        EXPECT_FALSE(summary["failed"].get<bool>());

        EXPECT_EQ(call("--resume out -q").code, 0);
        for (const char* file : {"curve.csv", "events.csv"})
            EXPECT_TRUE(read_file(folder_ / "out" / file) == read_file(folder_ / "whole" / file)) << file;
    }
}

TEST_F(CrackleTest, DamageOfCyclesInWhichNothingBreaksIsNothing) {
    write_small_case(folder_, {.kind = "compression",
                               .max_strain = 2e-4,
                               .loading = "unload_at_strain = [2e-5, 1e-4, 1e-4]",
                               .numerics = "intact = true"});
    replace("case.toml", "axial_strain_rate = 0.02\n", "");
    const Answer answer = call("case.toml -o out -q");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const auto summary = read_json(folder_ / "out/summary.json");
    ASSERT_EQ(summary["cycles"].size(), 3U);
    for (const auto& cycle : summary["cycles"]) {
        EXPECT_EQ(cycle["damage"], 0.0);
        EXPECT_EQ(cycle["permanent_strain"], 0.0);
        EXPECT_EQ(cycle["modulus"], summary["youngs_modulus"]);
        EXPECT_EQ(cycle["modulus_error"], 0.0);
    }
}

TEST_F(CrackleTest, UsesNoMoreThreadsThanThereAreProcessors) {
    write_small_case(folder_, {.max_strain = 1e-4});
    const Answer answer = call("case.toml -o out --threads 1000");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_NE(answer.err.find("of 1000 threads are used"), std::string::npos) << answer.err;
    EXPECT_LE(read_json(folder_ / "out/summary.json")["threads"].get<int>(), processors_lent());
}

}  // namespace
}  // namespace crackle
