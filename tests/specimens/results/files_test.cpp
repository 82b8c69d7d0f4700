// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the folder of a test: it is complete, has the same bytes for any interruptions and threads, and never destroys
// earlier results.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/base/system_failure.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/frames/frame.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/recordings/recording.hpp"
#include "specimens/results/output_folder.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/little_room.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::contents;
using testing::expect_same;
using testing::refusal;
using testing::ScratchFolder;
using testing::SmallCase;
using testing::write_small_case;

class TestFolder : public ::testing::Test {
  protected:
    TestOptions options(const std::string& name) const {
        TestOptions wanted;
        wanted.folder = scratch_ / name;
        wanted.command = "crackle test";
        return wanted;
    }
    ResolvedCase small_case(const SmallCase& wanted = {}) const {
        return read_case(write_small_case(scratch_ / "", wanted));
    }
    /// Cases that together use every law, unit, factor, way of ending and file.
    static std::vector<SmallCase> stated_rocks() {
        const std::string minerals =
            "[minerals]\nseed = 4\n[[mineral]]\nname = \"quartz\"\narea_share = 0.4\ncontact_modulus = 3e7\n"
            "[[mineral]]\nname = \"mica\"\nfriction_angle = 15.0\nresidual_friction_angle = 10.0\n"
            "[[mineral_pair]]\nbetween = [\"quartz\", \"mica\"]\nfriction_angle = 12.0\n";
        SmallCase pulled;  // cells in area units, with random strengths and minerals, held by grips
        pulled.mesh = "voronoi";
        pulled.rate = 0.005;
        pulled.material =
            "units = \"area\"\ncontact_modulus = 1e7\nstiffness_ratio = 2.5\n"
            "tensile_strength = 1.5e4\ncohesion = 5e4\nresidual_friction_angle = 20.0";
        pulled.bond = "law = \"coulomb\"\nstrength_distribution = \"weibull\"\nstrength_cv = 0.3\nstrength_seed = 5";
        pulled.minerals = minerals;
        pulled.loading = "platens = \"glued\"\ngrip = 0.1";
        pulled.output += "\nslips = true";
        SmallCase squeezed = pulled;
        squeezed.kind = "compression";
        squeezed.rate = 0.1;
        squeezed.max_strain = 0.015;
        squeezed.loading = "platens = \"frictional\"\nplaten_friction_angle = 10.0";
        squeezed.bond =
            "law = \"coulomb\"\nstrength_distribution = \"lognormal\"\nstrength_cv = 0.3\nstrength_seed = 6";
        SmallCase discs = squeezed;  // bonds across gaps, strengths relative to the back-tension
        discs.rate = 0.06;
        discs.mesh = "";
        discs.material = "";
        discs.minerals = "";
        discs.bond =
            "law = \"coulomb\"\nrange = 0.05\ntensile_factor = 1.0\ncohesion_factor = 2.0\n"
            "strength_distribution = \"normal\"\nstrength_cv = 0.2\nstrength_seed = 7";
        SmallCase sliding;  // back-tension bonds with recorded slips
        sliding.kind = "compression";
        sliding.mesh = "voronoi";
        sliding.rate = 0.1;
        sliding.max_strain = 0.03;
        sliding.output += "\nslips = true";
        SmallCase jointed = squeezed;  // slides along its trace after a few hundred steps
        jointed.rate = 0.03;
        jointed.minerals =
            "[[trace]]\npoints = [0.0, 0.1, 0.2355, 0.32]\nfriction_angle = 20.0\ncohesion = 1e4\n"
            "tensile_strength = 1e3\ndilation_angle = 5.0\n[[trace]]\npoints = [0.05, 0.3, 0.15, 0.35]";
        return {pulled, squeezed, discs, sliding, jointed};
    }
    /// Stops at the given number of calls during loading; the loop calls every 64 steps.
    static TestHooks stopping_at(int questions) {
        TestHooks hooks;
        const auto loading = std::make_shared<bool>(false);
        // Linear solutions also report stages; counting starts after the last line before loading.
        hooks.detail = [loading](const std::string& line) {
            *loading = *loading || line.find(" steps to max_axial_strain") != std::string::npos;
        };
        hooks.stage = [loading](const std::string& line) {
            *loading = *loading || line.starts_with("resumed at step ");
        };
        hooks.interrupted = [loading, left = questions]() mutable { return *loading && --left < 0; };
        return hooks;
    }

    /// Interrupts a test repeatedly, after `longer` more calls each time, then compares it with an uninterrupted test.
    void expect_same_resumed(const ResolvedCase& test, int longer, const std::string& what) {
        TestOptions straight = options("straight"), broken = options("broken");
        straight.force = broken.force = true;
        const TestOutcome whole = run_test(test, straight);
        EXPECT_GT(*whole.summary.damage.bonds_broken, 0);

        TestOutcome outcome = run_test(test, broken, stopping_at(1));
        int interrupts = 0;
        while (outcome.interrupted) {
            ++interrupts;
            EXPECT_EQ(outcome.summary.about.ended_by, "interrupt");
            broken.folder = outcome.folder;
            outcome = resume_test(broken, stopping_at(1 + longer * interrupts));
        }
        fmt::print("  {}: {} interrupts in {} steps, {} bonds broken\n", what, interrupts,
                   *whole.summary.numerics.steps, *whole.summary.damage.bonds_broken);
        EXPECT_GE(interrupts, 5);
        expect_same(contents(outcome.folder), contents(scratch_ / "straight"), what);
        fs::remove_all(outcome.folder);
        fs::remove_all(scratch_ / "straight");
    }

    ScratchFolder scratch_;
};

TEST_F(TestFolder, HoldsWhatReadersLookFor) {
    const TestOutcome outcome = run_test(small_case(), options("out"));
    const Recording recording = read_test_recording(scratch_ / "out", 3);
    const TestResults& results = recording.results;
    EXPECT_TRUE(*results.summary.about.failed);
    ASSERT_EQ(recording.frames.size(), 3u);
    std::vector<std::string> roles;
    for (const FrameHead& head : recording.frames) roles.insert(roles.end(), head.roles.begin(), head.roles.end());
    EXPECT_EQ(roles, (std::vector<std::string>{"start", "peak", "end"}));
    EXPECT_EQ(recording.cells.size(), 79u) << "77 discs and two platens";
    EXPECT_EQ(recording.bonds.size(), static_cast<std::size_t>(*results.summary.specimen.bonds_initial));
    for (const RecordedBond& bond : recording.bonds) {
        const auto gap = [&](std::int32_t cell) {
            const RecordedCell& disc = recording.cells[static_cast<std::size_t>(cell)];
            return disc.radius > 0.0 ? std::abs(norm(bond.place - disc.centre) - disc.radius) : 0.0;
        };
        EXPECT_LT(std::max(gap(bond.i), gap(bond.j)), testing::rock_overlap) << "bonds act where surfaces meet";
    }
    const std::string curve = read_file(scratch_ / "out/curve.csv");
    EXPECT_EQ(static_cast<std::ptrdiff_t>(results.curve.rows()), std::count(curve.begin(), curve.end(), '\n') - 1);
    EXPECT_EQ(results.events.rows(), static_cast<std::size_t>(*results.summary.damage.bonds_broken));
    const std::vector<double>& stress = *results.curve.find("axial_stress");
    EXPECT_EQ(*std::max_element(stress.begin(), stress.end()), *results.summary.strength.largest_stress)
        << "the same number in both files";
    const std::vector<double>& ids = *results.events.find("body_i");
    EXPECT_GT(*std::min_element(ids.begin(), ids.end()), 100.0) << "ids of the input";
    // Values and presence of results are checked by tests/recount.
    EXPECT_EQ(outcome.summary.about.title, "case");
    EXPECT_EQ(outcome.summary.run.command, options("out").command);
    const std::string text = read_file(scratch_ / "out/case.toml");
    EXPECT_NE(text.find("crackle " + *outcome.summary.run.version), std::string::npos) << text;
    std::vector<std::string> columns;
    for (const auto& [name, unit] : *outcome.summary.columns) columns.push_back(name);
    EXPECT_EQ(columns, results.curve.names) << "each column of the curve has its unit, in their order";
    EXPECT_NE(
        curve.find("axial_strain,axial_stress,stress_top,stress_bottom,lateral_strain,bonds_broken,kinetic_energy,"
                   "strain_energy,time,"
                   "step,interfaces_lost,points_sliding,dashpot_loss,friction_loss,fracture_loss,platen_work,"
                   "energy_error,gauge_strain,bonds_slid\n"),
        std::string::npos);
    EXPECT_NE(read_file(scratch_ / "out/case.toml").find("rock.dat"), std::string::npos) << "inputs and their hashes";
}

TEST_F(TestFolder, FramesAreReadInTheOrderOfTheirRows) {
    SmallCase wanted;
    wanted.output = "curve_rows = 2000\nframes = 50";
    run_test(small_case(wanted), options("out"));
    const Recording recording = read_test_recording(scratch_ / "out", 100);
    ASSERT_GT(recording.frames.size(), 10u);
    for (std::size_t k = 1; k < recording.frames.size(); ++k)
        EXPECT_GT(recording.frames[k].time, recording.frames[k - 1].time);
}

TEST_F(TestFolder, ForcedTestOfCirclesLeavesNoPolygonsOfTheOneBefore) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    run_test(small_case(wanted), options("out"));
    EXPECT_TRUE(fs::exists(scratch_ / "out/specimen_polygons.dat"));
    wanted.mesh = "";
    TestOptions forced = options("out");
    forced.force = true;
    run_test(small_case(wanted), forced);
    EXPECT_TRUE(fs::exists(scratch_ / "out/specimen_circles.dat"));
    EXPECT_FALSE(fs::exists(scratch_ / "out/specimen_polygons.dat"))
        << "the recount would treat these files as the specimen";
}

TEST_F(TestFolder, EndsBeforeFailureWithAPeakSoFar) {
    SmallCase wanted;
    wanted.max_strain = 2e-4;
    const TestOutcome outcome = run_test(small_case(wanted), options("out"));
    EXPECT_FALSE(*outcome.summary.about.failed);
    const TestResults results = read_test_recording(scratch_ / "out", 3).results;
    const std::vector<double>& stress = *results.curve.find("axial_stress");
    EXPECT_EQ(*outcome.summary.strength.peak_stress_so_far, *std::ranges::max_element(stress));
    EXPECT_FALSE(outcome.summary.strength.peak_stress.stated());
    EXPECT_EQ(outcome.summary.about.ended_by, "max_axial_strain");
}

TEST_F(TestFolder, ResolvedCaseRunsToTheSameCurve) {
    run_test(small_case(), options("out"));
    run_test(read_case(scratch_ / "out/case.toml"), options("again"));
    EXPECT_EQ(read_file(scratch_ / "out/curve.csv"), read_file(scratch_ / "again/curve.csv"));
}

TEST_F(TestFolder, HasTheSameBytesForAnyNumberOfThreads) {
    SmallCase wanted;
    wanted.mesh = "voronoi";
    wanted.rate = 0.05;
    std::vector<SmallCase> rocks = stated_rocks();
    rocks.push_back(wanted);
    for (const SmallCase& rock : rocks) {
        const ResolvedCase test = small_case(rock);
        TestOptions single = options("one");
        single.force = true;
        const TestOutcome first = run_test(test, single);
        EXPECT_GT(*first.summary.damage.bonds_broken, 0);
        const auto one = contents(scratch_ / "one");
        for (const int threads : {2, 3, 7}) {
            TestOptions several = options("several");
            several.threads = threads;
            several.force = true;
            run_test(test, several);
            expect_same(contents(scratch_ / "several"), one, fmt::format("{} threads", threads));
        }
    }
}

TEST_F(TestFolder, ResumedEndsWithTheBytesOfAnUninterruptedTest) {
    for (const char* mesh : {"", "voronoi", "voronoi demseg", " by tolerance", "voronoi by tolerance"}) {
        SmallCase wanted;
        const bool by_tolerance = std::string(mesh).ends_with("tolerance");
        wanted.kind = *mesh == 'v' ? "tension" : "compression";
        wanted.mesh = *mesh == 'v' ? "voronoi" : "";
        if (std::string(mesh).ends_with("demseg")) wanted.numerics = "contact_law = \"demseg\"";
        wanted.max_strain = 7e-3;
        const ResolvedCase test = by_tolerance
                                      ? CaseFiles(write_small_case(scratch_ / "", wanted))
                                            .with(std::vector<CaseSetting>{{"loading.rate_tolerance", 0.005, "test:1"}})
                                      : small_case(wanted);
        expect_same_resumed(test, by_tolerance ? 0 : 1, fmt::format("resumed {}", mesh));
    }
}

TEST_F(TestFolder, OfAStatedRockEndsResumedWithTheBytesOfAnUninterruptedTest) {
    for (const SmallCase& rock : stated_rocks()) expect_same_resumed(small_case(rock), 1, rock.kind + " " + rock.mesh);
}

/// The time since when an unbonded contact has touched is stored only in the checkpoint.
TEST_F(TestFolder, ResumedKnowsHowOldItsContactsAre) {
    SmallCase wanted;
    wanted.kind = "compression";
    wanted.mesh = "delaunay";
    wanted.rate = 0.2;
    wanted.max_strain = 0.012;
    wanted.loading = "stop_at_share_of_peak = 0.05";
    wanted.output = "curve_rows = 2000\nframes = 20";
    const ResolvedCase test = small_case(wanted);
    run_test(test, options("straight"));
    TestOutcome outcome = run_test(test, options("broken"), stopping_at(2));
    std::set<double> interrupts;  // s
    while (outcome.interrupted) {
        interrupts.insert(*outcome.summary.numerics.simulated_time);
        outcome = resume_test(options("broken"), stopping_at(4));
    }
    expect_same(contents(scratch_ / "broken"), contents(scratch_ / "straight"), "resumed");
    int old = 0;  // number of contacts that existed at an interrupt
    for (const auto& entry : fs::directory_iterator(scratch_ / "straight/frames")) {
        if (!entry.path().filename().string().starts_with("contacts_")) continue;
        const PolyData data = read_polydata(entry.path());
        const double time = data.field_values.at("time");
        for (std::size_t k = 0; k < data.cells.size(); ++k) {
            const auto next = interrupts.upper_bound(time - data.cell_data.at("age")[k]);
            const bool loose = data.cell_data.at("state")[k] == static_cast<double>(ContactState::loose);
            old += loose && next != interrupts.end() && *next < time;
        }
    }
    fmt::print("  {} interrupts, {} times a contact from before one\n", interrupts.size(), old);
    EXPECT_GT(old, 0);
}

TEST_F(TestFolder, ResumingTakesAwayWhatCameAfterTheCheckpoint) {
    const ResolvedCase test = small_case();
    run_test(test, options("straight"));
    run_test(test, options("broken"), stopping_at(4));
    // The files have rows after the checkpoint, as after a kill.
    std::ofstream(scratch_ / "broken/curve.csv", std::ios::app) << "1,2,3\n";
    std::ofstream(scratch_ / "broken/events.csv", std::ios::app) << "1,2,3\n";
    for (const char* picture : {"particles_99999.vtp", "contacts_99999.vtp", "cracks_99999.vtp"})
        std::ofstream(scratch_ / "broken/frames" / picture) << "later\n";
    EXPECT_FALSE(resume_test(options("broken")).interrupted);
    expect_same(contents(scratch_ / "broken"), contents(scratch_ / "straight"), "resumed after a kill");
    EXPECT_TRUE(resume_test(options("broken")).was_finished);
}

TEST_F(TestFolder, ResumingRefusesWhatDoesNotFit) {
    const auto refused = [&](const std::string& says) {
        const std::string message = refusal([&] { resume_test(options("out")); });
        EXPECT_NE(message.find(says), std::string::npos) << message;
    };
    refused("out: found no such folder");
    run_test(small_case(), options("out"), stopping_at(3));
    const std::string checkpoint = read_file(scratch_ / "out/checkpoint");
    const auto put = [&](const std::string& bytes) {
        std::ofstream(scratch_ / "out/checkpoint", std::ios::binary) << bytes;
    };
    put(checkpoint.substr(0, checkpoint.size() / 2));
    refused("truncated or damaged checkpoint");
    std::string flipped = checkpoint;
    flipped[checkpoint.size() / 2] = static_cast<char>(flipped[checkpoint.size() / 2] ^ 1);
    put(flipped);
    refused("truncated or damaged checkpoint");
    put("crackle test checkpoint 999\n");
    refused("found checkpoint version 999");
    put("hello");
    refused("found other data");
    put(checkpoint);
    std::ofstream(scratch_ / "out/case.toml", std::ios::app) << "# edited\n";
    refused("found a case that differs from the one of the checkpoint");
    fs::remove(scratch_ / "out/checkpoint");
    refused("found no checkpoint");
}

TEST_F(TestFolder, KeepsEarlierResultsUntilNewOnesAreComplete) {
    SmallCase wanted;
    run_test(small_case(wanted), options("out"));
    std::ofstream(scratch_ / "out/notes.txt") << "mine\n";
    const auto earlier = contents(scratch_ / "out");

    EXPECT_NE(refusal([&] { run_test(small_case(wanted), options("out")); }).find("--force"), std::string::npos);
    expect_same(contents(scratch_ / "out"), earlier, "after a refusal");

    TestOptions forced = options("out");
    forced.force = true;
    wanted.max_strain = 4e-3;
    const TestOutcome stopped = run_test(small_case(wanted), forced, stopping_at(3));
    EXPECT_TRUE(stopped.interrupted);
    EXPECT_EQ(stopped.folder, scratch_ / "out.new");
    expect_same(contents(scratch_ / "out"), earlier, "after an interrupt");

    EXPECT_NE(refusal([&] {
                  run_test(small_case(wanted), forced);
              }).find("resume it with `crackle test --resume " + (scratch_ / "out.new").string() + "`"),
              std::string::npos);
    expect_same(contents(scratch_ / "out"), earlier, "beside an unfinished test");
    forced.begins_again = true;
    EXPECT_TRUE(run_test(small_case(wanted), forced, stopping_at(3)).interrupted);
    // Resumed and stopped again: the results are still beside the earlier ones.
    const TestOutcome again = resume_test(options("out.new"), stopping_at(3));
    EXPECT_TRUE(again.interrupted);
    EXPECT_EQ(again.folder, scratch_ / "out.new");
    expect_same(contents(scratch_ / "out"), earlier, "after an interrupt of the resumed one");

    const TestOutcome resumed = resume_test(options("out.new/"));
    EXPECT_FALSE(resumed.interrupted);
    EXPECT_EQ(resumed.folder, scratch_ / "out");
    EXPECT_FALSE(fs::exists(scratch_ / "out.new"));
    auto now = contents(scratch_ / "out");
    EXPECT_EQ(now.erase("notes.txt"), 1U) << "foreign files stay";
    TestOptions whole = options("whole");
    run_test(small_case(wanted), whole);
    expect_same(now, contents(scratch_ / "whole"), "resumed in the place of the earlier ones");
}

TEST_F(TestFolder, OfAForcedTestThatOnlyHasToTakeItsPlaceDoesSo) {
    run_test(small_case(), options("out"));
    SmallCase wanted;
    wanted.max_strain = 4e-3;
    run_test(small_case(wanted), options("whole"));
    const auto whole = contents(scratch_ / "whole");
    for (const bool earlier_there : {true, false}) {
        fs::copy(scratch_ / "whole", scratch_ / "out.new", fs::copy_options::recursive);
        std::ofstream(scratch_ / "out.new/replaces-older-results") << "";
        if (!earlier_there) fs::remove_all(scratch_ / "out");
        const TestOutcome outcome = resume_test(options("out.new"));
        EXPECT_EQ(outcome.folder, scratch_ / "out");
        EXPECT_FALSE(fs::exists(scratch_ / "out.new"));
        expect_same(contents(scratch_ / "out"), whole, "moved");
    }
    fs::rename(scratch_ / "out", scratch_ / "out.new");
    std::ofstream(scratch_ / "out.new/replaces-older-results") << "";
    fs::create_directories(scratch_ / "out");
    std::ofstream(scratch_ / "out/curve.csv") << "mine\n";
    EXPECT_NE(refusal([&] { resume_test(options("out.new")); }).find("out: found curve.csv, expected only results"),
              std::string::npos);
    EXPECT_EQ(read_file(scratch_ / "out/curve.csv"), "mine\n");
}

TEST_F(TestFolder, ThatHoldsFilesWithoutAMarkOfATestIsRefusedAndNamesOne) {
    TestOptions mine = options("mine");
    mine.force = true;
    for (const char* name : {"notes.txt", "curve.csv", "summary.json", "checkpoint", "case.toml", "frames/x.png"}) {
        fs::create_directories((scratch_ / "mine" / name).parent_path());
        std::ofstream(scratch_ / "mine" / name) << "{}\n";  // contents() reads summary.json
        const auto before = contents(scratch_ / "mine");
        const std::string first = fs::path(name).begin()->string();
        for (const bool force : {false, true}) {
            mine.force = force;
            EXPECT_NE(refusal([&] { run_test(small_case(), mine); }).find("mine: found " + first + ", expected a new"),
                      std::string::npos)
                << name;
        }
        expect_same(contents(scratch_ / "mine"), before, name);
        fs::remove_all(scratch_ / "mine");
    }
    fs::create_directories(scratch_ / "mine");
    std::ofstream(scratch_ / "mine/0123456789abcdef.crackle_tmp") << "half";
    EXPECT_FALSE(run_test(small_case(), mine).interrupted) << "the test was stopped immediately";
    EXPECT_FALSE(fs::exists(scratch_ / "mine/0123456789abcdef.crackle_tmp"));
}

TEST_F(TestFolder, KeepsNotesAndFiguresOfTheUserWhateverIsForced) {
    run_test(small_case(), options("out"));
    fs::create_directories(scratch_ / "out/figures");
    for (const char* name : {"notes.txt", "figures/curve.pdf", "report.html", "frames/view.pvsm"})
        std::ofstream(scratch_ / "out" / name) << "mine\n";
    TestOptions forced = options("out");
    forced.force = true;
    run_test(small_case(), forced);
    for (const char* name : {"notes.txt", "figures/curve.pdf", "report.html", "frames/view.pvsm"})
        EXPECT_EQ(read_file(scratch_ / "out" / name), "mine\n");
}

TEST_F(TestFolder, WritesThroughNoLinkThatAStrangerHasPutThere) {
    std::ofstream(scratch_ / "stranger") << "mine\n";
    run_test(small_case(), options("out"));
    for (const char* name : {"summary.json", "curve.csv", "case.toml"}) {
        const fs::path link = scratch_ / "out" / (std::string(name) + ".tmp");
        fs::create_symlink(scratch_ / "stranger", link);
    }
    fs::create_directories(scratch_ / "out.new");
    TestOptions forced = options("out");
    forced.force = true;
    run_test(small_case(), forced);
    EXPECT_EQ(read_file(scratch_ / "stranger"), "mine\n");
}

TEST_F(TestFolder, PeakAndFailureDoNotDependOnTheRowsWritten) {
    SmallCase wanted;
    wanted.output = "curve_rows = 10\nframes = 5";
    const auto few = json_of(run_test(small_case(wanted), options("few")).summary);
    wanted.output = "curve_rows = 2000\nframes = 5";
    const auto many = json_of(run_test(small_case(wanted), options("many")).summary);
    for (const char* key :
         {"failed", "peak_stress", "peak_strain", "initial_tangent_modulus", "platen_out_of_balance"}) {
        EXPECT_EQ(few[key], many[key]) << key;
    }
    EXPECT_LT(read_results(scratch_ / "few").curve.rows(), 13U);
    for (const char* folder : {"few", "many"}) {  // the last row is written, however few rows there are
        const TestResults results = read_results(scratch_ / folder);
        EXPECT_EQ(results.curve.find("axial_strain")->back(), many["axial_strain_end"].get<double>()) << folder;
        EXPECT_EQ(results.curve.find("bonds_broken")->back(), many["bonds_broken"].get<double>()) << folder;
    }
    EXPECT_GT(read_results(scratch_ / "many").curve.rows(), 400U);
}

TEST_F(TestFolder, IsRefusedWhereAnInputOrForeignFilesWouldBeReplaced) {
    write_small_case(scratch_ / "", {});
    TestOptions here = options("");
    here.folder = scratch_ / "";
    here.force = true;
    const auto before = contents(scratch_ / "");
    EXPECT_NE(refusal([&] {
                  run_test(read_case(scratch_ / "case.toml"), here);
              }).find(" in this folder, expected a folder for results only"),
              std::string::npos);
    expect_same(contents(scratch_ / ""), before, "an input in the way");

    fs::create_directories(scratch_ / "mine/frames");
    std::ofstream(scratch_ / "mine/frames/holiday.png") << "mine\n";
    TestOptions mine = options("mine");
    mine.force = true;
    EXPECT_NE(refusal([&] { run_test(small_case(), mine); }).find("mine: found frames"), std::string::npos);

    run_test(small_case(), options("out"));
    run_test(small_case(), options("out.new"));
    TestOptions forced = options("out");
    forced.force = true;
    EXPECT_NE(
        refusal([&] { run_test(small_case(), forced); }).find("out.new: found case.toml, expected only new results"),
        std::string::npos);
    fs::remove_all(scratch_ / "out.new");
    std::ofstream(scratch_ / "out/frames/holiday.png") << "mine\n";
    std::ofstream(scratch_ / "out/report.html") << "my own page\n";
    run_test(small_case(), forced);
    EXPECT_EQ(read_file(scratch_ / "out/frames/holiday.png"), "mine\n");
    EXPECT_EQ(read_file(scratch_ / "out/report.html"), "my own page\n");
}

TEST_F(TestFolder, IsRefusedWhileAnotherTestWritesIntoIt) {
    const ResolvedCase test = small_case();
    int asked = 0;
    TestHooks hooks;
    hooks.interrupted = [&] {
        if (asked++ != 3) return false;
        EXPECT_NE(refusal([&] {
                      resume_test(options("out"));
                  }).find(fmt::format("another crackle (process {}) is writing here", ::getpid())),
                  std::string::npos);
        return false;
    };
    EXPECT_FALSE(run_test(test, options("out"), hooks).interrupted);
    EXPECT_GT(asked, 3);
}

TEST_F(TestFolder, OfAnUnstableRunIsNamedInItsMessage) {
    SmallCase wanted;
    wanted.rate = 3000.0;  // the platen moves by more than a particle's size per step
    try {
        run_test(small_case(wanted), options("out"));
        ADD_FAILURE() << "ran to the end";
    } catch (const UnstableRun& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_NE(std::string(error.what()).find("so far is in " + (scratch_ / "out").string()), std::string::npos);
    }
    EXPECT_TRUE(fs::exists(scratch_ / "out/summary.json"));
}

TEST_F(TestFolder, SaysWhereItsNumbersAreNoResults) {
    SmallCase wanted;
    wanted.numerics = "time_step = 1.0e-2\nallow_unstable = true";
    wanted.rate = 1e-4;
    const std::string notices =
        fmt::format("{}", fmt::join(*run_test(small_case(wanted), options("out")).summary.notices, "; "));
    fmt::print("  {}\n", notices);
    EXPECT_NE(notices.find("exceeds the stability limit"), std::string::npos);
    EXPECT_NE(notices.find("energy account does not close"), std::string::npos);
}

TEST_F(TestFolder, IsNotMadeForACaseThatCannotBeTested) {
    SmallCase wanted;
    wanted.numerics = "time_step = 1.0";
    refusal([&] { run_test(small_case(wanted), options("out")); });
    EXPECT_FALSE(fs::exists(scratch_ / "out"));
}

// A network file system keeps a removed file under another name as long as it is open.
TEST_F(TestFolder, OfStagedResultsGoesOnceNothingIsKeptInIt) {
    fs::create_directories(scratch_ / "out");
    for (const char* name : {"curve.csv", "summary.json"}) std::ofstream(scratch_ / "out" / name) << "1\n2\n";
    std::ofstream(scratch_ / "out/case.toml") << resolved_case_mark;
    const fs::path staged = scratch_ / "out.new", kept = staged / ".nfs0001";
    {
        OutputFolder folder = OutputFolder::create(scratch_ / "out", Earlier::replaced, {});
        ASSERT_EQ(folder.path(), staged);
        folder.write("summary.json", "new");
        std::ofstream(kept) << "open";
        folder.finish();
        EXPECT_EQ(read_file(scratch_ / "out/summary.json"), "new");
        EXPECT_TRUE(is_there(kept)) << "a foreign file was removed";
        fs::remove(kept);
    }
    EXPECT_FALSE(is_there(staged));
}

TEST_F(TestFolder, TablesThatTheNewTestLacksGoWithTheOldResults) {
    fs::create_directories(scratch_ / "out");
    for (const char* name : {"curve.csv", "slips.csv", "ae.csv"}) std::ofstream(scratch_ / "out" / name) << "1\n2\n";
    std::ofstream(scratch_ / "out/case.toml") << resolved_case_mark;
    OutputFolder folder = OutputFolder::create(scratch_ / "out", Earlier::replaced, {});
    for (const char* name : {"case.toml", "curve.csv"}) folder.write(name, "new");
    folder.finish();
    EXPECT_EQ(read_file(scratch_ / "out/curve.csv"), "new");
    for (const char* name : {"slips.csv", "ae.csv"}) EXPECT_FALSE(is_there(scratch_ / "out" / name)) << name;
}

TEST_F(TestFolder, FullDiscIsOneErrorThatNamesTheFile) {
    const OutputFolder folder = OutputFolder::create(scratch_ / "out", Earlier::refused, {});
    std::string message;
    try {
        const testing::LittleRoom room(1000);
        folder.write("case.toml", std::string(100000, 'x'));
    } catch (const SystemFailure& failure) {
        message = failure.what();
    }
    EXPECT_NE(message.find("case.toml: cannot be written (File too large)"), std::string::npos) << message;
    EXPECT_TRUE(fs::is_empty(scratch_ / "out"));
}

}  // namespace
}  // namespace crackle
