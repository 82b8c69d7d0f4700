// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle view` and its pages: what moves on the page must be what the files contain, to within the page's
// resolution.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "specimens/frames/frame.hpp"
#include "specimens/frames/read_frames.hpp"
#include "specimens/recordings/recording.hpp"
#include "tests/support/page_contents.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using namespace testing;

class ViewCommand : public ProgramCall {
  protected:
    ViewCommand() : ProgramCall("view") {}
    PageContents page(const std::string& words) const {
        const Answer answer = call(words + " -o page.html");
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(answer.out, "page.html\n");
        return PageContents(folder_ / "page.html");
    }
    static std::string quoted(const std::filesystem::path& path) { return fmt::format("'{}'", path.string()); }
    Answer crackle(const std::string& words) const {
        const int code = std::system(
            fmt::format("cd '{}' && '{}' {} > out.txt 2> err.txt", folder_.string(), CRACKLE_PROGRAM, words).c_str());
        return {WEXITSTATUS(code), read(out_), read(err_)};
    }
};

/// Expects numbers that differ by at most `most`; prints the largest difference.
void expect_near(const std::string& what, const std::vector<double>& expected, const std::vector<double>& got,
                 double most) {
    ASSERT_EQ(expected.size(), got.size()) << what;
    double worst = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) worst = std::max(worst, std::abs(expected[k] - got[k]));
    fmt::print("  {}: {} values, differ by at most {:.3g}, allowed {:.3g}\n", what, got.size(), worst, most);
    EXPECT_LE(worst, most) << what;
}

constexpr double growth = 0x1p-7, force_growth = 0x1p-6;  // as tools/page/page_data.hpp describes

/// Expects numbers that each differ by at most half a step of the page's scale at that value; prints the largest ratio
/// of difference to allowed difference.
void expect_as_finely_as_told(const std::string& what, const std::vector<double>& expected,
                              const std::vector<double>& got, double quantum, double with_growth) {
    ASSERT_EQ(expected.size(), got.size()) << what;
    double worst = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        // Within half a step of n, the slope of the scale is at most cosh(g/2) + sinh(g/2) < 1 + g times that at n.
        const double allowed = 0.5 * (1.0 + with_growth) * std::hypot(quantum, with_growth * expected[k]);
        worst = std::max(worst, std::abs(expected[k] - got[k]) / allowed);
    }
    fmt::print("  {}: {} values, differ by at most {:.3g} of what is allowed\n", what, got.size(), worst);
    EXPECT_LE(worst, 1.0) << what;
}

/// Largest quantum of the blocks in which the array is not all zero.
double quantum_of(const PageContents& shown, const std::string& name) {
    double most = 0.0;
    for (std::size_t g = 0; g < shown.test()["groups"].size(); ++g) {
        const PageContents::Table table = shown.coded(name, g);
        if (table.growth > 0.0) most = std::max(most, table.quantum);
    }
    return most;
}

double largest(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

TEST_F(ViewCommand, ShowsAParticleFileAsItIs) {
    const std::filesystem::path deck = shipped_deck("embankment") / "in_gm.dat";
    const PageContents shown = page(quoted(deck));
    const Scene scene = read_geometry(deck);
    std::size_t circles = 0, corners = 0;
    for (const Body& body : scene.bodies) {
        circles += body.circle_count;
        corners += body.vertex_count;
    }
    const std::vector<double> radius = shown.plain("cells.radius");
    EXPECT_EQ(static_cast<std::size_t>(std::count_if(radius.begin(), radius.end(), [](double r) { return r > 0.0; })),
              circles);
    EXPECT_EQ(shown.plain("outline.x").size(), corners);
    EXPECT_EQ(shown.test()["kind"], "particles");
    EXPECT_EQ(shown.test()["walls"],
              nlohmann::json({scene.domain.x1, scene.domain.x2, scene.domain.y1, scene.domain.y2}));
    EXPECT_EQ(shown.manifest["view"], "view");
    EXPECT_EQ(shown.test()["frames"].size(), 1U);
    EXPECT_EQ(largest(shown.row("ux", 0)), 0.0);
}

TEST_F(ViewCommand, MakesTheCirclesThatAParticleFileLeavesToChance) {
    const std::string file = quoted(shipped_deck("repose") / "in_gm.dat");
    const std::vector<double> first = page(file).plain("cells.x");
    EXPECT_EQ(first.size(), 582U);
    EXPECT_EQ(page(file + " --seed 1").plain("cells.x"), first);
    EXPECT_NE(page(file + " --seed 2").plain("cells.x"), first);
}

TEST_F(ViewCommand, ADecksBodiesAreWhereItsOutputsSay) {
    ASSERT_EQ(crackle(fmt::format("run -q '{}' -o run --steps 2000", shipped_deck("clump").string())).code, 0);
    const PageContents shown = page("run");
    const std::vector<testing::DeckFrame> frames = testing::read_frames(folder_ / "run" / "output.dat");
    ASSERT_EQ(shown.test()["frames"].size(), frames.size());
    const std::vector<double> x = shown.plain("cells.x"), y = shown.plain("cells.y");
    const double quantum = shown.coded("ux", 0).quantum;
    std::vector<double> expected_x, expected_y, got_x, got_y, expected_vx, got_vx, angle, got_angle;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const std::vector<double> ux = shown.row("ux", f), uy = shown.row("uy", f), turned = shown.row("angle", f),
                                  vx = shown.row("vx", f);
        for (std::size_t k = 0; k < x.size(); ++k) {
            const std::vector<double>&now = frames[f].rows[k], &start = frames[0].rows[k];
            expected_x.push_back(now[2]);
            expected_y.push_back(now[3]);
            got_x.push_back(x[k] + ux[k]);
            got_y.push_back(y[k] + uy[k]);
            angle.push_back(now[4] - start[4]);
            got_angle.push_back(turned[k]);
            if (f == 0) continue;
            expected_vx.push_back((now[2] - frames[f - 1].rows[k][2]) / (frames[f].time - frames[f - 1].time));
            got_vx.push_back(vx[k]);
        }
        EXPECT_EQ(shown.test()["frames"][f]["step"], frames[f].step);
    }
    // Half a quantum, plus single precision of the centres.
    const double most = 0.5 * quantum * (1.0 + 1e-6) + 0x1p-24 * std::max(largest(x), largest(y));
    expect_near("x", expected_x, got_x, most);
    expect_near("y", expected_y, got_y, most);
    expect_near("angle", angle, got_angle, 0.5 * 0x1p-18 * (1.0 + 1e-6));
    EXPECT_LE(quantum_of(shown, "vx"), 0x1p-20 * largest(expected_vx) * (1.0 + 1e-9));
    expect_as_finely_as_told("velocity", expected_vx, got_vx, quantum_of(shown, "vx"), growth);
    EXPECT_EQ(shown.test()["velocities"], "mean");
}

TEST_F(ViewCommand, ATurningPolygonIsCountedInWholeTurns) {
    // A single square spinning at 40 rad/s: 8 turns in 1.2566 s, a frame every sixteenth of a turn.
    std::filesystem::create_directories(folder_ / "deck");
    write(
        "deck/in_gm.dat",
        "1 0 0\n1e-4 0 0\n1\n2.5 1e8 0.25e8 0 0 0\n-10 10 -10 10 0\n0 1 0\n1 1 4\n0 0 40\n1 -1 -1\n1 -1\n2 1 -1\n1 1\n"
        "3 1 1\n-1 1\n4 -1 1\n-1 -1\n");
    write("deck/in_bc.dat", "0 0 12566 98 100\n0\n0\n");
    ASSERT_EQ(crackle("run -q deck -o run").code, 0) << read(err_);
    const PageContents shown = page("run");
    const std::size_t last = shown.test()["frames"].size() - 1;
    const double time = shown.test()["frames"][last]["time"];
    // Positions and velocities are half a step apart. The deck's first kick is a full one, which has no effect without
    // forces.
    const double expected = 40.0 * time, got = shown.row("angle", last)[0];
    fmt::print("  angle: expected {:.6f} rad ({:.3f} turns), got {:.6f}\n", expected,
               expected / (2.0 * std::numbers::pi), got);
    EXPECT_GT(got, 49.0);
    EXPECT_NEAR(got, expected, 1e-5);
    // This must hold even if there are whole turns between the frames shown.
    const PageContents few = page("run --frames 4");
    ASSERT_EQ(few.test()["frames"].size(), 4U);
    EXPECT_NEAR(few.row("angle", 3)[0], 40.0 * few.test()["frames"][3]["time"].get<double>(), 1e-5);
    EXPECT_NEAR(shown.row("rate", last)[0], 40.0, 0.02 + 0.5 * growth * (1.0 + growth) * 40.0);
}

TEST_F(ViewCommand, ADecksBondsAndBreaksAreThoseOfItsOutputs) {
    // The guide's chain, pulled at ten times the speed, so that its bonds break at different times.
    std::filesystem::create_directories(folder_ / "deck");
    for (const char* name : {"in_gm.dat", "in_cf0.dat"})
        std::filesystem::copy_file(shipped_deck("chain_pulled") / name, folder_ / "deck" / name);
    write("deck/in_bc.dat", "3 0 2000 100 100\n2\n1 20\n2\n1 1 0 1 0 1 0\n20 1 4.2 1 0 1 0\n");
    ASSERT_EQ(crackle("run -q deck -o run --steps 4000").code, 0) << read(err_);
    const PageContents shown = page("run");
    const std::vector<testing::DeckFrame> frames = testing::read_frames(folder_ / "run" / "cont2.dat");
    const testing::Rows counts = testing::read_rows(folder_ / "run" / "bonds.dat");
    const std::vector<double> i = shown.plain("bonds.i"), j = shown.plain("bonds.j"), id = shown.plain("cells.id");
    ASSERT_EQ(i.size(), 19U);
    for (std::size_t bond = 0; bond < i.size(); ++bond) {
        const double a = id[static_cast<std::size_t>(i[bond])], b = id[static_cast<std::size_t>(j[bond])];
        EXPECT_EQ(std::abs(a - b), 1.0) << "neighbours of the chain";
    }
    ASSERT_EQ(shown.test()["frames"].size(), frames.size());
    std::size_t broken = 0, in_contact_without = 0;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const std::vector<double> state = shown.row("state", f), force = shown.row("fn", f);
        std::vector<double> expected_force, got_force;
        std::size_t bonded = 0;
        for (const std::vector<double>& row : frames[f].rows) {
            if (row[7] == 0.0) ++in_contact_without;
            if (row[7] == 0.0) continue;
            ++bonded;
            for (std::size_t bond = 0; bond < i.size(); ++bond) {
                const double a = id[static_cast<std::size_t>(i[bond])], b = id[static_cast<std::size_t>(j[bond])];
                if (std::minmax(row[0], row[1]) != std::minmax(a, b)) continue;
                EXPECT_EQ(state[bond], static_cast<double>(BondState::intact)) << "frame " << f << ", bond " << bond;
                expected_force.push_back(row[5]);
                got_force.push_back(force[bond]);
            }
        }
        broken = static_cast<std::size_t>(std::ranges::count(state, static_cast<double>(BondState::broken)));
        EXPECT_EQ(bonded + broken, 19U) << "frame " << f;
        const testing::Rows now = testing::rows_of(counts, 0, frames[f].step);
        ASSERT_EQ(now.size(), 1U);
        EXPECT_EQ(static_cast<double>(broken), now[0][2]) << "frame " << f;
        if (bonded > 0)
            expect_as_finely_as_told("normal forces", expected_force, got_force, quantum_of(shown, "fn"), force_growth);
    }
    fmt::print("  {} bonds broken, {} contacts without a bond\n", broken, in_contact_without);
    EXPECT_GT(broken, 2U);
    const std::vector<double> body = shown.plain("events.body_i"), time = shown.plain("events.time");
    EXPECT_EQ(body.size(), broken);
    EXPECT_EQ(shown.plain("events.shear").size(), broken);
    EXPECT_TRUE(std::ranges::is_sorted(time));
    EXPECT_FALSE(shown.test()["arrays"].contains("events.axial_strain")) << "a deck has no strains";
    EXPECT_FALSE(shown.test()["arrays"].contains("curve.axial_strain"));
}

TEST_F(ViewCommand, APolygonsBondsAreToldApartByTheirPlaces) {
    // Two squares face to face with four bonds of equal back-tension by symmetry; the upper one is tilted until those
    // at one end are broken.
    std::filesystem::create_directories(folder_ / "deck");
    write("deck/in_gm.dat",
          "1 0 0\n1e-4 0 0\n1\n2.5 1e8 0 0 0 0\n-10 10 -10 10 0.1\n0 2 0\n"
          "1 1 4\n0 0 0\n1 -1 -2.03125\n1 -2.03125\n2 1 -2.03125\n1 -0.03125\n3 1 -0.03125\n-1 -0.03125\n"
          "4 -1 -0.03125\n-1 -2.03125\n"
          "2 1 4\n0 0 0\n1 -1 0.03125\n1 0.03125\n2 1 0.03125\n1 2.03125\n3 1 2.03125\n-1 2.03125\n"
          "4 -1 2.03125\n-1 0.03125\n");
    write("deck/in_bc.dat", "3 0 100 50 100\n1\n2\n2\n1 1 0 1 0 1 0\n2 1 0 1 0 1 0.06\n");
    ASSERT_EQ(crackle("run -q deck -o run").code, 0) << read(err_);
    const PageContents shown = page("run");
    const std::vector<double> x = shown.plain("bonds.x"), state = shown.row("state", 2);
    ASSERT_EQ(x.size(), 4U);
    ASSERT_EQ(testing::read_frames(folder_ / "run" / "cont2.dat").back().rows.size(), 2U) << "two are left";
    for (std::size_t bond = 0; bond < x.size(); ++bond) {
        // Rotating counter-clockwise, the upper square lifts its right end.
        EXPECT_EQ(state[bond], static_cast<double>(x[bond] > 0.0 ? BondState::broken : BondState::intact))
            << "bond at x = " << x[bond];
    }
    EXPECT_EQ(shown.plain("events.x").size(), 2U);
    for (const double place : shown.plain("events.x")) EXPECT_GT(place, 0.0);
}

TEST_F(ViewCommand, StressOfASqueezedDecksDiscIsItsForceOverItsDiameter) {
    // A disc of radius 1 between two walls at a distance of 1.98: overlap 0.01 each, force 1e6, no other load.
    std::filesystem::create_directories(folder_ / "deck");
    write("deck/in_gm.dat",
          "1 0 0\n1e-5 0 0\n1\n2.5 1e8 0.25e8 0 0 0\n-0.99 0.99 -10 10 0\n1 0 0\n1 1 1\n0 0 0\n1 1\n0 0 0\n");
    write("deck/in_bc.dat", "0 0 10 10 10\n0\n0\n");
    ASSERT_EQ(crackle("run -q deck -o run").code, 0) << read(err_);
    const PageContents shown = page("run");
    // -1/A Σ f·x for two forces of 1e6 that act in the middle of the overlap, 0.995 from the centre.
    const double expected = 2.0 * 1e6 * 0.995 / std::numbers::pi, got = shown.row("sxx", 0)[0];
    fmt::print("  stress: expected {:.1f}, got {:.1f}\n", expected, got);
    EXPECT_NEAR(got, expected, 0.5 * growth * (1.0 + growth) * expected);
    EXPECT_EQ(shown.row("syy", 0)[0], 0.0);
    const std::vector<double> other = shown.coded("contacts.j", 0).rows[0];
    EXPECT_EQ(std::vector<double>(other.begin(), other.begin() + 2), (std::vector<double>{-1.0, -2.0}));
}

TEST_F(ViewCommand, ATestsCellsAndForcesAreThoseOfItsFrames) {
    for (const std::string mesh : {"", "voronoi"}) {
        const std::string out = "out" + mesh;
        write_small_case(folder_, {.mesh = mesh, .output = "curve_rows = 2000\nframes = 40"});
        ASSERT_EQ(crackle(fmt::format("test case.toml -o {} -q", out)).code, 0) << read(err_);
        const PageContents shown = page(out);
        const auto& frames = shown.test()["frames"];
        ASSERT_GT(frames.size(), 10U);
        std::vector<double> expected_x, got_x, expected_force, got_force, expected_stress, got_stress;
        for (std::size_t f = 0; f < frames.size(); ++f) {
            const std::string name = frames[f]["file"];
            const PolyData particles = read_polydata(folder_ / out / name);
            const std::vector<double>&displacement = particles.cell_data.at("displacement"),
                  &stress = particles.cell_data.at("stress_yy");
            const std::vector<double> ux = shown.row("ux", f), fn = shown.row("fn", f), syy = shown.row("syy", f);
            for (std::size_t k = 0; k < particles.cells.size(); ++k) expected_x.push_back(displacement[3 * k]);
            got_x.insert(got_x.end(), ux.begin(), ux.end());
            expected_stress.insert(expected_stress.end(), stress.begin(), stress.end());
            got_stress.insert(got_stress.end(), syy.begin(), syy.end());
            std::string contacts = name;
            contacts.replace(contacts.find("particles"), 9, "contacts");
            const PolyData lines = read_polydata(folder_ / out / contacts);
            const std::vector<double>& normal = lines.cell_data.at("normal_force");
            expected_force.insert(expected_force.end(), normal.begin(),
                                  normal.begin() + static_cast<std::ptrdiff_t>(fn.size()));
            got_force.insert(got_force.end(), fn.begin(), fn.end());
        }
        // Half a quantum, plus single precision of the corners.
        expect_near(mesh + " displacement", expected_x, got_x,
                    0.5 * shown.coded("ux", 0).quantum * (1.0 + 1e-6) + 0x1p-24 * largest(shown.plain("cells.x")));
        expect_as_finely_as_told(mesh + " normal force", expected_force, got_force, quantum_of(shown, "fn"),
                                 force_growth);
        expect_as_finely_as_told(mesh + " stress", expected_stress, got_stress, quantum_of(shown, "syy"), growth);
        EXPECT_EQ(shown.plain("bonds.i").size(), shown.test()["summary"]["bonds_initial"]);
        EXPECT_EQ(frames.front()["roles"], nlohmann::json({"start"}));
        EXPECT_EQ(frames.back()["roles"].back(), "end");
    }
}

TEST_F(ViewCommand, AnOutputStandsForItsRun) {
    ASSERT_EQ(crackle(fmt::format("run -q '{}' -o run --steps 500", shipped_deck("clump").string())).code, 0);
    const PageContents whole = page("run");
    for (const char* name : {"output.dat", "cont2.dat", "energy.dat"}) {
        const PageContents shown = page(fmt::format("run/{}", name));
        EXPECT_EQ(shown.manifest, whole.manifest) << name;
    }
    const Answer answer = call("run/output.dat");
    EXPECT_EQ(answer.out, "run/view.html\n") << answer.err;
    EXPECT_EQ(page("run/new_in_gm.dat").test()["kind"], "particles") << "a particle file";
    std::filesystem::create_directories(folder_ / "kept");
    std::filesystem::rename(folder_ / "run" / "output.dat", folder_ / "kept" / "stage1.dat");
    expect_refused("kept/stage1.dat",
                   "kept/stage1.dat: found rows that `crackle run` wrote, expected a particle file or");
    write_small_case(folder_, {});
    ASSERT_EQ(crackle("test case.toml -o out -q").code, 0) << read(err_);
    EXPECT_EQ(page("out/curve.csv").manifest, page("out").manifest);
}

TEST_F(ViewCommand, NamesTheUnitsThatADeckDoesNotState) {
    const std::string deck = quoted(shipped_deck("clump") / "in_gm.dat");
    EXPECT_FALSE(page(deck).manifest.contains("units"));
    const nlohmann::json cgs = page(deck + " --units cgs").manifest["units"];
    EXPECT_EQ(cgs["force"], "dyn");
    EXPECT_EQ(cgs["stress"], "dyn/cm");
    EXPECT_EQ(cgs["prefixes"], false);
    EXPECT_EQ(page(deck + " --units si").manifest["units"]["prefixes"], true);
    expect_refused(deck + " --units feet", "view: --units: found 'feet', expected one of si, cgs, mm-g-s");
    write_small_case(folder_, {});
    ASSERT_EQ(crackle("test case.toml -o out -q").code, 0) << read(err_);
    expect_refused("out --units cgs", "view: --units: found out, a test, which is in SI units");
}

TEST_F(ViewCommand, SeveralRunsStandSideBySide) {
    const std::string deck = shipped_deck("clump").string();
    const PageContents shown = page(fmt::format("'{0}/in_gm.dat' '{0}'", deck));
    EXPECT_EQ(shown.manifest["tests"].size(), 2U);
    EXPECT_EQ(shown.test(1)["name"], "in_gm.dat (2)") << "a deck that has not run: the same file";
}

TEST_F(ViewCommand, RefusesWhatItCannotShow) {
    std::filesystem::create_directories(folder_ / "empty");
    write("note.txt", "not a page\n");
    write("broken.dat", "1 0 0\nzero\n");
    const std::string deck = quoted(shipped_deck("clump") / "in_gm.dat");
    expect_refused("", "found no input");
    expect_refused("nowhere", "nowhere: found no such file or folder");
    expect_refused("empty", "empty: found neither summary.json nor output.dat nor in_gm.dat");
    expect_refused("broken.dat", "broken.dat:2: dt: found 'zero'");
    expect_refused(deck + " -o note.txt", "not a page written by crackle");
    expect_refused(deck + " -o no/such/page.html", "cannot be written");
}

TEST_F(ViewCommand, NamesFileAndLineOfADamagedOutput) {
    ASSERT_EQ(crackle(fmt::format("run -q '{}' -o run --steps 2000", shipped_deck("clump").string())).code, 0);
    const std::string whole = read("run/output.dat");
    const std::size_t second_frame = whole.find("\n100 ");
    ASSERT_NE(second_frame, std::string::npos);
    const auto line =
        std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(second_frame) + 1, '\n') + 2;
    std::string damaged = whole;
    const std::size_t body = damaged.find('\n', second_frame + 1) + 1;
    write("run/output.dat", damaged.insert(body, 1, 'x'));
    expect_refused("run", fmt::format("run/output.dat:{}: body: found 'x", line));
    damaged = whole;
    write("run/output.dat",
          damaged.insert(damaged.find(' ', damaged.find(" 4.98") + 1), "e250"));  // finite, but far outside
    expect_refused("run", "run: output.dat:2 to output.dat:");
    write("run/output.dat", whole.substr(0, second_frame + 30));  // as left by a killed run
    EXPECT_EQ(page("run").test()["frames"].size(), 1U);
}

TEST(ChosenFrames, AreEvenAndKeepTheFirstTheLastAndThoseNamed) {
    EXPECT_EQ(chosen_frames(5, 10, {}), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(chosen_frames(101, 5, {}), (std::vector<std::size_t>{0, 25, 50, 75, 100}));
    EXPECT_EQ(chosen_frames(101, 4, {37}), (std::vector<std::size_t>{0, 37, 50, 100}));
    EXPECT_EQ(chosen_frames(101, 0, {37}), (std::vector<std::size_t>{0, 37, 100}));
    EXPECT_EQ(chosen_frames(1, 500, {0}), (std::vector<std::size_t>{0}));
    EXPECT_TRUE(chosen_frames(0, 500, {}).empty());
}

}  // namespace
}  // namespace crackle
