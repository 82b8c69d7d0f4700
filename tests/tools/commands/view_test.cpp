// SPDX-License-Identifier: GPL-3.0-or-later
// `crackle view` and the pages it fills: what moves on the page is what the files hold, to the page's own quanta.

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

/// Numbers that differ by at most `most`; prints the largest difference.
void expect_near(const std::string& what, const std::vector<double>& expected, const std::vector<double>& got,
                 double most) {
    ASSERT_EQ(expected.size(), got.size()) << what;
    double worst = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) worst = std::max(worst, std::abs(expected[k] - got[k]));
    fmt::print("  {}: {} values, differ by at most {:.3g}, allowed {:.3g}\n", what, got.size(), worst, most);
    EXPECT_LE(worst, most) << what;
}

constexpr double growth = 0x1p-7, force_growth = 0x1p-6;  // as tools/page/page_data.hpp describes

/// Numbers of which each differs by at most half a step of the page's scale at that value; prints the largest
/// difference as a share of what is allowed.
void expect_as_finely_as_told(const std::string& what, const std::vector<double>& expected,
                              const std::vector<double>& got, double quantum, double with_growth) {
    ASSERT_EQ(expected.size(), got.size()) << what;
    double worst = 0.0;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        // Within half a step of n the scale's slope is at most cosh(g/2) + sinh(g/2) < 1 + g times that at n.
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
    // Half a quantum, and the centres in single precision.
    const double most = 0.5 * quantum * (1.0 + 1e-6) + 0x1p-24 * std::max(largest(x), largest(y));
    expect_near("x", expected_x, got_x, most);
    expect_near("y", expected_y, got_y, most);
    expect_near("angle", angle, got_angle, 0.5 * 0x1p-18 * (1.0 + 1e-6));
    EXPECT_LE(quantum_of(shown, "vx"), 0x1p-20 * largest(expected_vx) * (1.0 + 1e-9));
    expect_as_finely_as_told("velocity", expected_vx, got_vx, quantum_of(shown, "vx"), growth);
    EXPECT_EQ(shown.test()["velocities"], "mean");
}

TEST_F(ViewCommand, ATurningPolygonIsCountedInWholeTurns) {
    // A bare square, spinning at 40 rad/s: 8 turns in 1.2566 s, a frame every sixteenth of a turn.
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
    // Positions and velocities are half a step apart; the deck's first kick is a full one, which without forces is
    // none.
    const double expected = 40.0 * time, got = shown.row("angle", last)[0];
    fmt::print("  angle: expected {:.6f} rad ({:.3f} turns), got {:.6f}\n", expected,
               expected / (2.0 * std::numbers::pi), got);
    EXPECT_GT(got, 49.0);
    EXPECT_NEAR(got, expected, 1e-5);
    // Also where whole turns lie between the frames that are shown.
    const PageContents few = page("run --frames 4");
    ASSERT_EQ(few.test()["frames"].size(), 4U);
    EXPECT_NEAR(few.row("angle", 3)[0], 40.0 * few.test()["frames"][3]["time"].get<double>(), 1e-5);
    EXPECT_NEAR(shown.row("rate", last)[0], 40.0, 0.02 + 0.5 * growth * (1.0 + growth) * 40.0);
}

TEST_F(ViewCommand, StressOfASqueezedDecksDiscIsItsForceOverItsDiameter) {
    // A disc of radius 1 between two walls 1.98 apart: overlap 0.01 each, force 1e6, no other load.
    std::filesystem::create_directories(folder_ / "deck");
    write("deck/in_gm.dat",
          "1 0 0\n1e-5 0 0\n1\n2.5 1e8 0.25e8 0 0 0\n-0.99 0.99 -10 10 0\n1 0 0\n1 1 1\n0 0 0\n1 1\n0 0 0\n");
    write("deck/in_bc.dat", "0 0 10 10 10\n0\n0\n");
    ASSERT_EQ(crackle("run -q deck -o run").code, 0) << read(err_);
    const PageContents shown = page("run");
    // -1/A Σ f·x: two forces of 1e6 that act in the middle of the overlap, 0.995 from the centre.
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
        // Half a quantum, and corners in single precision.
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

TEST_F(ViewCommand, SeveralRunsStandSideBySide) {
    const std::string deck = shipped_deck("clump").string();
    const PageContents shown = page(fmt::format("'{0}/in_gm.dat' '{0}'", deck));
    EXPECT_EQ(shown.manifest["tests"].size(), 2U);
    EXPECT_EQ(shown.test(1)["name"], "in_gm.dat (2)") << "a deck that has not run: the same file again";
}

TEST_F(ViewCommand, RefusesWhatItCannotShow) {
    std::filesystem::create_directories(folder_ / "empty");
    write("note.txt", "not a page\n");
    write("broken.dat", "1 0 0\nzero\n");
    const std::string deck = quoted(shipped_deck("clump") / "in_gm.dat");
    expect_refused("", "found nothing to look at");
    expect_refused("nowhere", "nowhere: found no such file or folder");
    expect_refused("empty", "empty: found neither summary.json nor output.dat nor in_gm.dat");
    expect_refused("broken.dat", "broken.dat:2: dt: found 'zero'");
    expect_refused(deck + " -o note.txt", "not a page of crackle");
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
          damaged.insert(damaged.find(' ', damaged.find(" 4.98") + 1), "e250"));  // finite, but nowhere
    expect_refused("run", "run: output.dat:2 to output.dat:");
    write("run/output.dat", whole.substr(0, second_frame + 30));  // a killed run
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
