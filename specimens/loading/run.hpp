// SPDX-License-Identifier: GPL-3.0-or-later
// A test with its folder OUT: begun, or gone on with from its checkpoint.
// Tested by tests/tools/commands/resume_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "specimens/case/case_file.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/recordings/test_summary.hpp"

namespace crackle {

struct TestOptions {
    std::filesystem::path folder;  ///< OUT
    bool force = false;
    bool verify = false;   ///< run the companions, specimens/loading/companions.hpp
    bool profile = false;  ///< time the phases of a step, for the summary
    int threads = 0;       ///< 0: the case's
    // Fewer threads than asked for do the work beyond these; what is written is the same.
    int most_threads = 1024;
    std::string most_threads_why;  ///< for a notice
    std::int64_t fewest_bodies_a_thread = 1;
    bool endless = false;  ///< as many steps and days as it takes; refuse_endless() is not asked
    std::string command;   ///< for the summary
    std::chrono::steady_clock::time_point process_start = std::chrono::steady_clock::now();
};

struct TestOutcome {
    TestSummary summary;
    std::filesystem::path folder;  ///< where the results are: OUT, or OUT.new if earlier results are still in OUT
    bool interrupted = false;
    bool unverified = false;    ///< the companions were interrupted: the test is complete, but states no error
    bool was_finished = false;  ///< resume_test() found nothing to do
};

/// @throws InputError, UnstableRun (results up to there are kept), TestInterrupted
TestOutcome run_test(const TestCase& description, const TestOptions& options, const TestHooks& hooks = {});

/// Goes on with a test from its last checkpoint. @throws InputError if the folder, its case or its checkpoint do not
/// fit.
TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks = {});

}  // namespace crackle
