// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the shipped Voronoi compression, loaded five times as fast and past failure. Its bytes must depend neither on
// the number of threads, all of which must have worked, nor on where it was stopped and resumed.

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "solver/world/checkpoint.hpp"
#include "solver/world/world.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/load_specimen.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "specimens/statistics/random_numbers.hpp"
#include "tests/bench/verify/scenes/whole_world.hpp"
#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/folder_contents.hpp"

namespace crackle {
namespace {

using testing::contents;
using testing::expect_same;
using testing::ScratchFolder;
using verification::hash_of;

constexpr int steps_between_questions = 64;  // between calls that ask the loading loop to stop

ResolvedCase fast_case() {
    const CaseFiles files(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/guide_rock/voronoi_compression.toml");
    return files.with(std::vector<CaseSetting>{{"loading.axial_strain_rate", 0.05, "here:1"}});
}

struct Trace {
    std::vector<std::uint64_t> hashes;  // hashes of the whole state, every 64 steps
    std::vector<std::int64_t> thread_blocks;
    std::int64_t broken = 0;
    bool failed = false;
};

Trace trace_of(VirtualTest test, int threads) {
    set_threads(test.world, threads);
    Trace trace;
    TestHooks hooks;
    hooks.interrupted = [&] {
        trace.hashes.push_back(hash_of(save_world(test.world)));
        return false;
    };
    load_specimen(test, hooks);
    trace.thread_blocks = test.world.workers.blocks_done;
    trace.broken = test.world.bonds.broken;
    trace.failed = test.state.failure.failed;
    return trace;
}

TEST(VoronoiCompression, HasTheSameStateForAnyNumberOfThreadsPastFailure) {
    const VirtualTest prepared = prepare_test(fast_case(), {});
    const Trace one = trace_of(prepared, 1);
    fmt::print("  {} bonds broken in {} steps\n", one.broken, one.hashes.size() * steps_between_questions);
    ASSERT_TRUE(one.failed);
    for (const int threads : {2, 3, 7}) {
        const Trace many = trace_of(prepared, threads);
        ASSERT_EQ(many.hashes.size(), one.hashes.size());
        for (std::size_t k = 0; k < one.hashes.size(); ++k) {
            ASSERT_EQ(many.hashes[k], one.hashes[k])
                << threads << " threads, first seen at step " << k * steps_between_questions;
        }
        ASSERT_EQ(many.thread_blocks.size(), static_cast<std::size_t>(threads));
        for (const std::int64_t blocks : many.thread_blocks) EXPECT_GT(blocks, 0) << threads << " threads";
    }
}

TEST(VoronoiCompression, HasTheSameFilesForAnyNumberOfThreadsAndResumedAtFiveRandomSteps) {
    const ScratchFolder scratch;
    const ResolvedCase test = fast_case();
    TestOptions options;
    options.command = "crackle test";
    options.folder = scratch / "one";
    const TestOutcome first = run_test(test, options);
    ASSERT_TRUE(*first.summary.about.failed);
    const auto one = contents(scratch / "one");
    const auto questions = *first.summary.numerics.steps / steps_between_questions;

    std::mt19937_64 generator(5);
    for (const int threads : {1, 2, 3, 7}) {
        options.folder = scratch / ("threads_" + std::to_string(threads));
        options.threads = threads;
        if (threads > 1) {
            run_test(test, options);
            expect_same(contents(options.folder), one, fmt::format("{} threads", threads));
            continue;
        }
        // Packing and solves also call this; counting begins with loading.
        const auto stop = [&] {
            const auto loading = std::make_shared<bool>(false);
            TestHooks hooks;
            hooks.detail = [loading](const std::string& line) {
                *loading = *loading || line.find(" steps to max_axial_strain") != std::string::npos;
            };
            hooks.stage = [loading](const std::string& line) { *loading = *loading || line.starts_with("resumed"); };
            hooks.interrupted = [loading,
                                 left = uniform_below(generator, static_cast<std::uint64_t>(questions / 6))]() mutable {
                return *loading && left-- == 0;
            };
            return hooks;
        };
        TestOutcome outcome = run_test(test, options, stop());
        int interrupts = 0;
        for (; outcome.interrupted; ++interrupts) {
            fmt::print("  stopped at step {}\n", *outcome.summary.numerics.steps);
            outcome = resume_test(options, interrupts < 4 ? stop() : TestHooks{});
        }
        EXPECT_EQ(interrupts, 5);
        expect_same(contents(options.folder), one, "resumed");
    }
}

}  // namespace
}  // namespace crackle
