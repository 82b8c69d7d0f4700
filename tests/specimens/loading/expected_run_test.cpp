// SPDX-License-Identifier: GPL-3.0-or-later
// How long a test will take is known before it begins, and one without an end in sight is refused by the key that makes
// it so.

#include "specimens/loading/expected_run.hpp"

#include <gtest/gtest.h>

#include "solver/base/errors.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::agrees;
using testing::SmallCase;

class ExpectedRun : public ::testing::Test {
  protected:
    TestCase small_case(const SmallCase& wanted = {}) const {
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    /// The message of a test that is refused, without a folder of its own left behind.
    std::string refusal(const TestCase& test) const {
        TestOptions options;
        options.folder = scratch_ / "out";
        try {
            run_test(test, options);
        } catch (const InputError& error) {
            fmt::print("  {}\n", error.what());
            EXPECT_FALSE(fs::exists(scratch_ / "out/curve.csv"));
            return error.what();
        }
        return "went through";
    }
    void expect_refused(const TestCase& test, const std::string& key) const {
        const std::string message = refusal(test);
        EXPECT_NE(message.find("max_axial_strain"), std::string::npos) << message;
        EXPECT_NE(message.find("--long"), std::string::npos) << message;
        EXPECT_NE(message.find(key), std::string::npos) << message;
    }
    testing::ScratchFolder scratch_;
};

TEST_F(ExpectedRun, IsTheStrainOverRateAndStep) {
    const VirtualTest test = prepare_test(small_case());
    const RunEstimate run = expected_run(test, 0.005, 1000.0);
    const double expected = 0.005 / 0.02 / test.world.stepping.time_step;
    EXPECT_TRUE(agrees("steps to a strain of 0.005", run.steps, expected, 1e-12));
    EXPECT_TRUE(agrees("seconds at 1000 steps/s", run.seconds, expected / 1000.0, 1e-12));
    EXPECT_NO_THROW(refuse_endless(test, run));
}

TEST_F(ExpectedRun, WithoutAnEndInSightIsRefusedByTheKeyThatMakesItSo) {
    SmallCase tiny_step;
    tiny_step.numerics = "time_step = 1e-18";
    expect_refused(small_case(tiny_step), "numerics.time_step = 1e-18 s, where");
    SmallCase slow;
    slow.rate = 1e-12;
    expect_refused(small_case(slow), "loading.axial_strain_rate = 1e-12 1/s");
    TestCase slippery = small_case();
    slippery.loading.axial_strain_rate.reset();
    slippery.loading.rate_tolerance = 0.01;
    slippery.material.friction_angle = 1e-12;
    expect_refused(slippery, "look at friction angles and strengths");
}

TEST_F(ExpectedRun, IsNoReasonToRefuseWhereThatIsAskedFor) {
    SmallCase slow;
    slow.rate = 1e-12;
    TestOptions options;
    options.folder = scratch_ / "out";
    options.endless = true;
    TestHooks hooks;
    bool loading = false;
    hooks.detail = [&](const std::string& line) {
        loading = loading || line.find(" steps to max_axial_strain") != std::string::npos;
    };
    hooks.interrupted = [&] { return loading; };
    EXPECT_TRUE(run_test(small_case(slow), options, hooks).interrupted);
}

TEST_F(ExpectedRun, OfASmallSpecimenTakesNoMoreThreadsThanAreOfUse) {
    TestOptions options;
    options.folder = scratch_ / "out";
    options.threads = 16;
    options.most_threads = 4;
    options.fewest_bodies_a_thread = 40;  // of 79 bodies
    std::string notices;
    TestHooks hooks;
    hooks.stage = [&](const std::string& line) { notices += line + '\n'; };
    const TestOutcome outcome = run_test(small_case(), options, hooks);
    EXPECT_EQ(outcome.summary.number("threads"), 1.0) << outcome.summary.text_of("bodies");
    EXPECT_NE(notices.find("notice: 1 of 16 threads are used"), std::string::npos) << notices;
}

}  // namespace
}  // namespace crackle
