// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that an option without effect for the given input is an error, even if the input file is missing.

#include <gtest/gtest.h>

#include "tests/support/deck_files.hpp"
#include "tests/support/program_call.hpp"
#include "tests/support/sample_results.hpp"
#include "tests/support/small_plan.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

using namespace testing;

class UnusedOptions : public ProgramCall {
  protected:
    UnusedOptions() : ProgramCall("") {}

    void expect_without_effect(const std::string& words, const std::string& option, const std::string& input) const {
        expect_refused(words, fmt::format("{}: found with {}, but has no effect there; leave it out", option, input));
    }
    void expect_lonely(const std::string& words, const std::string& option, const std::string& others) const {
        expect_refused(words, fmt::format("{0}: found without {1}, but has no effect alone; leave it out, or add {1}",
                                          option, others));
    }
};

TEST_F(UnusedOptions, OfFiguresAndPagesOfTests) {
    write_sample_results(folder_ / "squeezed", SampleTest{});
    const std::string tests = "folders of tests";
    expect_without_effect("report squeezed -o page.html --test tension", "--test", tests);
    expect_without_effect("plot squeezed -o figure.svg --what ae --measured missing.csv", "--measured",
                          "a figure without curves");
    expect_without_effect("plot squeezed -o figure.svg --figure peak_stress", "--figure", tests);
    expect_without_effect("plot squeezed -o figure.svg --format png", "--format", tests);
    expect_without_effect("plot squeezed -o figure.svg --what curve --at peak", "--at", "a figure without specimens");
    expect_without_effect("plot squeezed -o figure.svg --what ae --magnify 3", "--magnify",
                          "a figure without specimens");
    expect_without_effect("plot --guide six -o figures --what curve", "--what", "--guide");
    expect_refused("plot squeezed -o figure.pdf --dpi 600",
                   "--dpi: found with a vector format, but has no effect there; leave it out, or write a .png");
    expect_refused("plot squeezed -o figure.pdf --what forces", "found no frames with forces of faces");
}

TEST_F(UnusedOptions, OfACampaign) {
    write_small_plan(folder_, 1);
    ASSERT_EQ(call("campaign plan.toml -o out -q").code, 0);
    const std::string campaign = "a campaign's folder";
    expect_without_effect("report out --frames 3", "--frames", campaign);
    expect_refused("plot out -o figure.svg --what specimen",
                   "--what: found 'specimen', expected curve, axes, scatter or all of a campaign");
    expect_without_effect("plot out -o figure.svg --at peak", "--at", campaign);
    expect_without_effect("plot out -o figure.svg --what axes --measured lab.csv", "--measured",
                          "a figure without curves");
    expect_without_effect("plot out -o figure.svg --what curve --figure peak_stress", "--figure", "curves alone");
    expect_without_effect("campaign show out --wrong --csv", "--csv", "--wrong");
    expect_without_effect("campaign show out --tests --figure peak_stress", "--figure", "--tests");
    expect_without_effect("campaign show out --all --figure peak_stress", "--figure", "--all");
    expect_without_effect("campaign plan.toml --keys", "plan.toml", "--keys");
    expect_without_effect("campaign -o out --keys", "--output", "--keys");
}

TEST_F(UnusedOptions, OfTests) {
    write_small_case(folder_, {});
    expect_without_effect("test --check case.toml -o out", "--output", "--check");
    expect_without_effect("test --check case.toml --verify", "--verify", "--check");
    expect_without_effect("test --resume out --profile", "--profile", "--resume");
    expect_without_effect("test --resume out --allow-unstable", "--allow-unstable", "--resume");
    expect_without_effect("test --resume out -o out", "--output", "--resume");
    expect_without_effect("test case.toml --files", "case.toml", "--files");
    expect_without_effect("test --keys --threads 2", "--threads", "--keys");
    expect_lonely("test case.toml -o out --json", "--json", "--check");
    expect_lonely("elastic case.toml --strain 1e-3", "--strain", "--bonds");
    expect_lonely("elastic case.toml --force", "--force", "--bonds");
    expect_without_effect("calibrate --keys --workers 1", "--workers", "--keys");
}

TEST_F(UnusedOptions, OfFilesThatAreNotWritten) {
    write("joints.toml", "[packing]\nwidth = 2.0\nheight = 1.0\n[[trace]]\npoints = [0.0, 0.5, 1.0, 0.5]\n");
    expect_lonely("joints joints.toml --title Traces", "--title", "--output");
    expect_lonely("joints joints.toml --force", "--force", "--output or --traces");
    expect_without_effect("joints joints.toml --seed 3", "--seed", "a case without any [[joint_set]]");
    expect_lonely("envelope one two --columns 1", "--columns", "--output");
    EXPECT_EQ(call("joints joints.toml --traces traces.txt --force").code, 0);
}

TEST_F(UnusedOptions, OfParticlesThatNothingIsLeftOf) {
    write_small_rock(folder_ / "rock.dat");
    expect_without_effect("view rock.dat -o page.html --seed 2", "--seed", "inputs without random circles");
    expect_without_effect("view rock.dat -o page.html --frames 2", "--frames", "particle files");
    const std::string deck = "'" + shipped_deck("circle").string() + "'";
    expect_refused("run " + deck + " -o out --seed 2", "seed: found a seed");
    expect_without_effect("run " + deck + " --continue --force", "--force", "--continue without -o");
}

}  // namespace
}  // namespace crackle
