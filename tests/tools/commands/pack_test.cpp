// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle pack` as called by a user: what it writes, and its messages for invalid input.

#include <gtest/gtest.h>

#include "solver/demseg/geometry.hpp"
#include "tests/support/program_call.hpp"

namespace crackle {
namespace {

using testing::Answer;

class CracklePack : public testing::ProgramCall {
  protected:
    CracklePack() : ProgramCall("pack") {}
    const std::string sizes_ = " --radius-min 0.01 --radius-max 0.02", target_ = " --mean-overlap 4e-5";
};

TEST_F(CracklePack, WritesTheCountAskedForAndItsFigures) {
    const Answer answer = call("--count 60" + sizes_ + target_ + " --seed 3 -o new/folder/rock.dat");
    ASSERT_EQ(answer.code, 0) << answer.err;
    EXPECT_TRUE(answer.err.empty()) << "quiet in a pipe: " << answer.err;
    const Scene scene = read_geometry(folder_ / "new/folder/rock.dat");
    EXPECT_EQ(scene.circles.size(), 60U);
    for (const char* figure :
         {"circles          60, radii", "box  ", "void ratio", "mean overlap", "coordination", "floating", "stress",
          "anisotropy", "unbalanced", "written          new/folder/rock.dat"}) {
        EXPECT_NE(answer.out.find(figure), std::string::npos) << figure << "\n" << answer.out;
    }
}

TEST_F(CracklePack, SameSeedSameBytesWhateverTheThreads) {
    ASSERT_EQ(call("--count 60" + sizes_ + target_ + " -o one.dat").code, 0);
    ASSERT_EQ(call("--count 60" + sizes_ + target_ + " --threads 3 -o three.dat").code, 0);
    ASSERT_EQ(call("--count 60" + sizes_ + target_ + " --seed 2 -o other.dat").code, 0);
    EXPECT_TRUE(read("one.dat") == read("three.dat"));
    EXPECT_FALSE(read("one.dat") == read("other.dat"));
}

TEST_F(CracklePack, TakesASieveCurveAVoidRatioAndAMaterial) {
    write("curve.csv", "size,passing_by_mass\n0.02,0\n0.03,0.4\n0.04,1\n");
    const Answer answer = call(
        "--width 0.3 --height 0.6 --sieve curve.csv --void-ratio 0.19 --density 2700 --normal-stiffness 2e7 -o "
        "rock.dat");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Scene scene = read_geometry(folder_ / "rock.dat");
    EXPECT_EQ(scene.domain.x2 - scene.domain.x1, 0.3);
    EXPECT_EQ(scene.materials[0].density, 2700.0);
    EXPECT_EQ(scene.materials[0].normal_stiffness, 2e7);
    EXPECT_NE(answer.out.find("void ratio       0.19"), std::string::npos) << answer.out;
}

TEST_F(CracklePack, NeverReplacesItsOwnInput) {
    write("curve.csv", "size,passing_by_mass\n0.02,0\n0.03,0.4\n0.04,1\n");
    expect_refused("--count 60 --sieve curve.csv" + target_ + " --force -o ./curve.csv",
                   "curve.csv: found an input of the same command");
}

TEST_F(CracklePack, LeavesAnExistingFileAlone) {
    write("mine.dat", "precious\n");
    const std::string words = "--count 60" + sizes_ + target_ + " -o mine.dat";
    expect_refused(words, "--force");
    expect_refused("--count 0" + sizes_ + target_ + " --force -o mine.dat", "count: found 0");
    EXPECT_EQ(call(words + " --force").code, 0);
    EXPECT_EQ(read_geometry(folder_ / "mine.dat").circles.size(), 60U);
}

TEST_F(CracklePack, RefusesBadInputInOneMessage) {
    const std::string count = "--count 60";
    expect_refused(sizes_ + target_, "expected either width and height or a count");
    expect_refused(count + target_, "sizes: found no option");
    expect_refused(count + sizes_, "target of the packing: found neither");
    expect_refused(count + sizes_ + target_ + " --void-ratio 0.2", "found both");
    expect_refused("--count many" + sizes_ + target_, "many");
    expect_refused("--count -5" + sizes_ + target_, "count: found -5");
    expect_refused(count + " --radius-min -0.01 --radius-max 0.02" + target_, "radius_min: found -0.01");
    expect_refused(count + " --radius-min nan --radius-max 0.02" + target_, "radius_min: found nan");
    expect_refused(count + " --radius-min 0.03 --radius-max 0.02" + target_, "radius_max: found 0.02");
    expect_refused(count + sizes_ + " --mean-overlap 1", "mean_overlap: found 1 m");
    expect_refused(count + sizes_ + " --void-ratio 0.6", "void_ratio: found 0.6, expected");
    expect_refused("--width 0.05 --height 0.05" + sizes_ + target_,
                   "expected room for at least two of the largest circles");
    expect_refused(count + sizes_ + target_ + " --threads 0", "threads");
    expect_refused(count + sizes_ + target_ + " --seed -1", "seed: found -1");
    expect_refused(count + sizes_ + target_ + " --colour red", "--colour");
    expect_refused(count + sizes_ + target_ + " -o /proc/nowhere/rock.dat", "/proc/nowhere");
    expect_refused(count + sizes_ + target_ + " -o " + std::string(300, 'x'), "");
    expect_refused(count + " --sieve absent.csv" + target_, "absent.csv: cannot be read");
    expect_refused(count + " --sieve absent.csv" + sizes_ + target_, "expected --sieve alone");
    expect_refused(count + " --lognormal-median 0.01" + target_, "expected both");
}

}  // namespace
}  // namespace crackle
