// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the duration of a test is known before it begins, and that a test without a foreseeable end is refused
// with the key that causes this.

#include "specimens/loading/expected_run.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/stepping/controls.hpp"
#include "solver/stepping/step.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/kinds/test_kind.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::agrees;
using testing::SmallCase;

class ExpectedRun : public ::testing::Test {
  protected:
    ResolvedCase small_case(const SmallCase& wanted = {}) const {
        return read_case(testing::write_small_case(scratch_ / "", wanted));
    }
    /// The message for a refused test, which must not leave a folder behind.
    std::string refusal(const ResolvedCase& test) const {
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
    void expect_refused(const ResolvedCase& test, const std::string& key) const {
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
    expect_refused(small_case(tiny_step), "numerics.time_step = 1e-18 s, although");
    SmallCase slow;
    slow.rate = 1e-12;
    expect_refused(small_case(slow), "loading.axial_strain_rate = 1e-12 1/s");
    ResolvedCase slippery = small_case();
    slippery.loading.rate = parts::RateTolerance{0.01};
    slippery.material.friction_angle = 1e-12;
    expect_refused(slippery, "check friction angles and strengths");
}

TEST_F(ExpectedRun, IsNoReasonToRefuseWhereThatIsAskedFor) {
    SmallCase slow;
    slow.rate = 1e-9;
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

/// Discs with back-tension bonds between frictional jaws have no linear solution, but their parts must still move.
TEST_F(ExpectedRun, OfEveryKindItsPlatenMoves) {
    constexpr double rate = 0.02;
    struct Tried {
        const char *kind, *height_to_width, *loading;
        bool cells = false;  // whether to use cells, since no circle reaches all parts
    };
    const Tried kinds[] = {
        {"compression", "0.5", ""},
        {"compression", "0.5", "platens = \"frictional\"\nplaten_friction_angle = 20.0\n"},
        {"tension", "0.5", ""},
        {"biaxial", "0.5", "[confinement]\npressure = 1e3\n"},
        {"brazilian", "1.0", "", true},
        {"brazilian", "1.0", "platens = \"frictional\"\nplaten_friction_angle = 20.0\nhalf_angle = 10.0\n"},
        {"brazilian", "1.0", "platens = \"frictional\"\nplaten_friction_angle = 20.0\njaws = \"flat\"\n"},
        {"bending", "0.2", ""},
        {"scb", "0.5", "", true},
        {"direct_shear", "0.5", "normal_stress = 1e6\n", true}};
    std::set<std::string> tried;
    for (const auto& [kind, height_to_width, loading, cells] : kinds) {
        std::ofstream(scratch_ / "case.toml")
            << "[packing]\ncount = 400\nradius_min = 1.333e-2\nradius_max = 2.667e-2\nmean_overlap = 7.74e-5\n"
            << "height_to_width = " << height_to_width << "\n[material]\ndensity = 2500.0\ndamping_ratio = 0.2\n"
            << (cells ? "units = \"area\"\ncontact_modulus = 1e10\nstiffness_ratio = 2.5\nfriction_angle = 35.0\n"
                        "tensile_strength = 1e7\ncohesion = 3e7\nresidual_friction_angle = 25.0\n"
                        "[mesh]\nkind = \"voronoi\"\nthick = 1e-3\n[bond]\nlaw = \"coulomb\"\n"
                      : "normal_stiffness = 1.0e7\nshear_stiffness = 2.5e6\nfriction_angle = 27.0\n")
            << "[loading]\nkind = \"" << kind << "\"\nmax_axial_strain = 0.01\naxial_strain_rate = " << rate << '\n'
            << loading;
        VirtualTest test = prepare_test(read_case(scratch_ / "case.toml"));
        tried.insert(kind);
        EXPECT_NO_THROW(refuse_resting(test)) << kind << loading;
        const double before = test.setup.apparatus.axial_strain(test.world), begun = test.world.stepping.time;
        for (int k = 0; k < 50; ++k) step(test.world);
        const double strain = test.setup.apparatus.axial_strain(test.world) - before;
        // Strain is computed from the position of the driving part in double precision.
        EXPECT_TRUE(agrees(fmt::format("strain of a {} test in 50 steps", kind), strain,
                           rate * (test.world.stepping.time - begun), 1e-6));
    }
    for (const std::string& kind : names_of<LoadingKind>()) EXPECT_TRUE(tried.contains(kind)) << kind;
}

TEST_F(ExpectedRun, WithoutAMovingPlatenIsRefusedHoweverLongItMayTake) {
    SmallCase slow;
    slow.rate = 1e-16;
    TestOptions options;
    options.folder = scratch_ / "out";
    options.endless = true;
    const std::string refused = testing::refusal([&] { run_test(small_case(slow), options); });
    EXPECT_NE(refused.find("loading.axial_strain_rate: found a displacement of"), std::string::npos) << refused;
    EXPECT_FALSE(fs::exists(scratch_ / "out/curve.csv"));
    VirtualTest resting = prepare_test(small_case());
    change_velocity(resting.world, resting.setup.apparatus.top, resting.setup.apparatus.axis, 0.0);
    EXPECT_THROW(load_specimen(resting, {}, nullptr), InputError);
}

TEST_F(ExpectedRun, OfASmallSpecimenTakesNoMoreThreadsThanAreOfUse) {
    TestOptions options;
    options.folder = scratch_ / "out";
    options.threads = 16;
    options.most_threads = 4;
    options.fewest_bodies_a_thread = 40;  // there are 79 bodies
    std::string notices;
    TestHooks hooks;
    hooks.stage = [&](const std::string& line) { notices += line + '\n'; };
    const TestOutcome outcome = run_test(small_case(), options, hooks);
    EXPECT_EQ(outcome.summary.run.threads, 1);
    EXPECT_NE(notices.find("notice: 1 of 16 threads are used"), std::string::npos) << notices;
}

}  // namespace
}  // namespace crackle
