// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a test stopped at any moment, by Ctrl-C or by SIGKILL, and resumed by the command that the program prints,
// leaves exactly the files of an uninterrupted one. Each run of the tests tries a few moments of each kind; slow tests
// try many (tests/tools/CMakeLists.txt).

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ostream>
#include <random>
#include <thread>

#include "tests/support/folder_contents.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using testing::Answer;
using testing::contents;
using testing::expect_same;

#ifdef __SANITIZE_ADDRESS__  // twenty times slower: the moments lie as far apart in fewer circles
constexpr int circles = 40;
#else
constexpr int circles = 150;
#endif

/// The case has its own packing, so that making the specimen takes some of the time. Frames and checkpoints are as
/// frequent as possible, so that a kill occurs during them.
std::string case_of(const std::string& specimen) {
    std::string text =
        fmt::format("[packing]\ncount = {}\n", circles) +
        "radius_min = 0.013\nradius_max = 0.026\nmean_overlap = 7.74e-5\n"
        "[material]\ndensity = 2500\nnormal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27\n"
        "damping_ratio = 0.2\n";
    if (specimen == "voronoi") text += "[mesh]\nkind = \"voronoi\"\nthick = 1.0e-3\n[bond]\nthick = 1.08e-3\n";
    return text + fmt::format(
                      "[loading]\nkind = \"tension\"\naxial_strain_rate = {}\nmax_axial_strain = 0.005\n"
                      "[output]\ncurve_rows = 2000\nframes = 200\ncheckpoint_interval = 0.03\n",
                      specimen == "voronoi" ? 0.05 : 0.01);
}

struct Series {
    const char* specimen;
    int kills;  ///< number of moments of each kind
};

void PrintTo(const Series& series, std::ostream* out) { *out << series.specimen << ", " << series.kills << " kills"; }

class Resume : public testing::ProgramCall, public ::testing::WithParamInterface<Series> {
  protected:
    Resume() : ProgramCall("test") {}

    void SetUp() override {
        const Clock::time_point begun = Clock::now();
        for (const std::string name : {"whole", "cut", "forced"}) {
            fs::create_directory(folder_ / name);
            write(name + "/case.toml", case_of(GetParam().specimen));
        }
        const Answer answer = call_in("whole", "case.toml -o out -q");
        ASSERT_EQ(answer.code, 0) << answer.err;
        seconds_ = std::chrono::duration<double>(Clock::now() - begun).count();
        whole_ = contents(folder_ / "whole/out");
        fmt::print("  uninterrupted: {:.2f} s, {} files\n", seconds_, whole_.size());
        ASSERT_GT(whole_.size(), 20U) << "frames are written during the test";
    }

    Answer call_in(const std::string& place, const std::string& words) const {
        const int status = std::system(fmt::format("cd '{}' && '{}' test {} > ../out.txt 2> ../err.txt",
                                                   (folder_ / place).string(), CRACKLE_PROGRAM, words)
                                           .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("out.txt"), read("err.txt")};
    }

    /// Starts the program in cut/ without waiting for it to end.
    pid_t start(const std::vector<const char*>& words) const {
        const pid_t child = fork();
        if (child != 0) return child;
        const int nothing = open("/dev/null", O_WRONLY);
        dup2(nothing, STDOUT_FILENO);
        dup2(nothing, STDERR_FILENO);
        if (chdir((folder_ / "cut").c_str()) != 0) _exit(126);
        std::vector<char*> all{const_cast<char*>("crackle"), const_cast<char*>("test")};
        for (const char* word : words) all.push_back(const_cast<char*>(word));
        all.push_back(nullptr);
        execv(CRACKLE_PROGRAM, all.data());
        _exit(127);
    }

    /// Sends `signal` to the process after `seconds`, unless it has already ended. @return its exit code or -signal
    static int stop(pid_t child, int signal, double seconds) {
        const auto until = Clock::now() + std::chrono::duration<double>(seconds);
        int status = 0;
        while (Clock::now() < until) {
            if (waitpid(child, &status, WNOHANG) == child) return ended(status);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
        }
        kill(child, signal);
        waitpid(child, &status, 0);
        return ended(status);
    }

    static int ended(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }

    /// Resumes as a user would after an interrupt, and checks the message if there is nothing to resume.
    std::string go_on() const {
        const Answer resumed = call_in("cut", "--resume out -q");
        if (resumed.code == 0) return "resumed";
        EXPECT_EQ(resumed.code, 2) << resumed.err;
        const bool begun = fs::exists(folder_ / "cut/out");
        EXPECT_NE(resumed.err.find(begun ? "run the test again" : "found no such folder"), std::string::npos)
            << resumed.err;
        const Answer again = call_in("cut", "case.toml -o out -q");
        EXPECT_EQ(again.code, 0) << again.err;
        return "begun again";
    }

    void expect_the_whole(const std::string& what) const {
        expect_same(contents(folder_ / "cut/out"), whole_, what);
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "cut"), {}), 2)
            << what << ": the case and its results";
    }

    void clear() const { fs::remove_all(folder_ / "cut/out"); }

    std::map<std::string, std::string> whole_;
    double seconds_ = 0.0;
};

void try_moments(int kills, const std::function<std::string(double)>& at, int signal) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(signal));
    for (int k = 0; k < kills; ++k) {
        // One moment in each part of the run and slightly beyond, so that all parts are covered.
        const double within = static_cast<double>(generator() >> 11) * 0x1p-53;
        const double share = 1.05 * (k + within) / kills;
        fmt::print("  signal {} at {:.3f} of the run: {}\n", signal, share, at(share));
        if (::testing::Test::HasFailure()) return;
    }
}

TEST_P(Resume, AfterAKillAtAnyMomentEndsWithTheBytesOfAnUninterruptedTest) {
    try_moments(
        GetParam().kills,
        [&](double share) {
            clear();
            const int code = stop(start({"case.toml", "-o", "out", "-q"}), SIGKILL, share * seconds_);
            EXPECT_TRUE(code == -SIGKILL || code == 0) << code;
            const std::string way = go_on();
            expect_the_whole(fmt::format("killed at {:.3f}", share));
            return way;
        },
        SIGKILL);
}

TEST_P(Resume, AfterCtrlCAtAnyMomentEndsWithTheBytesOfAnUninterruptedTest) {
    try_moments(
        GetParam().kills,
        [&](double share) {
            clear();
            const int code = stop(start({"case.toml", "-o", "out", "-q"}), SIGINT, share * seconds_);
            // Before the program handles signals, the signal ends it in the usual way.
            EXPECT_TRUE(code == 130 || code == 0 || code == -SIGINT) << code;
            if (code == 130 && fs::exists(folder_ / "cut/out")) {
                const auto summary = nlohmann::json::parse(read("cut/out/summary.json"));
                EXPECT_TRUE(summary["interrupted"].get<bool>());
                EXPECT_TRUE(exists("cut/out/checkpoint"));
            }
            const std::string way = go_on();
            expect_the_whole(fmt::format("interrupted at {:.3f}", share));
            return way;
        },
        SIGINT);
}

TEST_P(Resume, AfterOneKillUponTheOtherEndsWithTheBytesOfAnUninterruptedTest) {
    std::mt19937_64 generator(7);
    int code = stop(start({"case.toml", "-o", "out", "-q"}), SIGKILL, 0.6 * seconds_);
    int times = 0;
    for (; code == -SIGKILL && times < GetParam().kills; ++times) {
        const double seconds = seconds_ * (0.05 + 0.3 * static_cast<double>(generator() >> 11) * 0x1p-53);
        const bool there = exists("cut/out/checkpoint");
        code =
            stop(there ? start({"--resume", "out", "-q"}) : start({"case.toml", "-o", "out", "-q"}), SIGKILL, seconds);
    }
    const std::string way = go_on();
    fmt::print("  {} kills, then {}\n", times, way);
    expect_the_whole("killed again and again");
}

TEST_P(Resume, ATestThatWentOnLeavesNoSummaryOfWhereItWasInterrupted) {
    const pid_t first = start({"case.toml", "-o", "out", "-q"});
    while (!exists("cut/out/checkpoint") && waitpid(first, nullptr, WNOHANG) == 0) {
    }
    const int code = stop(first, SIGINT, 0.0);
    if (code != 130 || !exists("cut/out")) GTEST_SKIP() << "it ended before the signal, or its loading had not begun";
    ASSERT_TRUE(exists("cut/out/summary.json"));
    const auto before = fs::file_size(folder_ / "cut/out/curve.csv");
    const pid_t child = start({"--resume", "out", "-q"});
    int status = 0;
    while (fs::file_size(folder_ / "cut/out/curve.csv") <= before && waitpid(child, &status, WNOHANG) == 0) {
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    if (exists("cut/out/summary.json")) {
        EXPECT_FALSE(nlohmann::json::parse(read("cut/out/summary.json"))["interrupted"].get<bool>());
    }
    EXPECT_EQ(go_on(), "resumed");
    expect_the_whole("interrupted, gone on and killed");
}

/// A time window of a few milliseconds, found by waiting for a file that still has a temporary name.
const std::string temporary = "temporary";

TEST_P(Resume, AfterAKillWhileAFileIsWrittenEndsWithTheBytesOfAnUninterruptedTest) {
    const auto is_there = [](const fs::path& awaited) {
        if (awaited.filename() != temporary) return access(awaited.c_str(), F_OK) == 0;
        std::error_code vanished;
        fs::directory_iterator entries(awaited.parent_path(), vanished);
        return !vanished && std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
            return entry.path().extension() == ".crackle_tmp";
        });
    };
    for (const std::string& file :
         std::vector<std::string>{temporary, "case.toml", "curve.csv", "checkpoint", "frames/" + temporary,
                                  "frames/frames.pvd", "summary.json"}) {
        clear();
        const pid_t child = start({"case.toml", "-o", "out", "-q"});
        int status = 0, seen = 0;
        const fs::path awaited = folder_ / "cut/out" / file;
        while (seen == 0 && waitpid(child, &status, WNOHANG) == 0) seen = is_there(awaited) ? 1 : 0;
        if (seen != 0) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
        }
        const std::string way = go_on();
        fmt::print("  killed when {} was there{}: {}\n", file, seen != 0 ? "" : " (not met)", way);
        expect_the_whole("killed at " + file);
    }
}

/// Results that are being replaced must be complete at any moment: the old ones or, after resuming, the new ones.
TEST_P(Resume, OfAForcedTestKeepsTheEarlierResultsUntilTheNewOnesHaveTakenTheirPlace) {
    // Earlier results of another case, and the results of the new case from an uninterrupted --force.
    write("earlier.toml", case_of(GetParam().specimen));
    replace("earlier.toml", "frames = 200", "frames = 30");
    ASSERT_EQ(call_in("forced", "../earlier.toml -o out -q").code, 0);
    const auto earlier = contents(folder_ / "forced/out");
    const std::string earlier_case = read("forced/out/case.toml");
    fs::copy(folder_ / "forced/out", folder_ / "earlier", fs::copy_options::recursive);
    ASSERT_EQ(call_in("forced", "case.toml -o out -q --force").code, 0);
    const auto forced = contents(folder_ / "forced/out");

    const auto identity = [](const fs::path& file) {
        struct stat found {};
        return stat(file.c_str(), &found) == 0 ? found.st_ino : 0;
    };
    for (const char* stage : {"out.new/checkpoint", "out.new/summary.json", "out/case.toml", "out/curve.csv",
                              "out/frames/particles_00000.vtp", "out/checkpoint"}) {
        clear();
        fs::remove_all(folder_ / "cut/out.new");
        fs::copy(folder_ / "earlier", folder_ / "cut/out", fs::copy_options::recursive);
        const fs::path awaited = folder_ / "cut" / stage;
        const auto before = identity(awaited);
        const pid_t child = start({"case.toml", "-o", "out", "-q", "--force"});
        int status = 0;
        bool seen = false;
        while (!seen && waitpid(child, &status, WNOHANG) == 0) {
            const auto now = identity(awaited);
            seen = now != 0 && now != before;
        }
        if (seen) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
        }
        const Answer resumed = call_in("cut", "--resume out");
        EXPECT_EQ(resumed.code, 0) << stage << ": " << resumed.err;
        const bool replaced = read("cut/out/case.toml") != earlier_case;
        fmt::print("  killed when {} was new{}: {}\n", stage, seen ? "" : " (not met)",
                   replaced ? "the new results are in place" : "the earlier ones are as they were");
        if (!replaced) {
            expect_same(contents(folder_ / "cut/out"), earlier, std::string(stage) + ", earlier results");
            EXPECT_NE(resumed.err.find("out.new"), std::string::npos)
                << "the message names the folder of the new results: " << resumed.err;
            ASSERT_EQ(call_in("cut", "--resume out.new -q").code, 0);
        }
        expect_same(contents(folder_ / "cut/out"), forced, stage);
        // At the very end, the program removes its empty folder.
        EXPECT_TRUE(!exists("cut/out.new") || fs::is_empty(folder_ / "cut/out.new")) << stage;
    }
}

std::string specimen_of(const ::testing::TestParamInfo<Series>& series) { return series.param.specimen; }

INSTANTIATE_TEST_SUITE_P(AFew, Resume, ::testing::Values(Series{"circles", 2}, Series{"voronoi", 2}), specimen_of);
INSTANTIATE_TEST_SUITE_P(Many, Resume, ::testing::Values(Series{"circles", 20}, Series{"voronoi", 20}), specimen_of);

}  // namespace
}  // namespace crackle
