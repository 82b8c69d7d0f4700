// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a test in its output folder OUT, from the start or from its checkpoint.
// Tested by tests/tools/commands/resume_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "specimens/making/hooks.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/summary/summary.hpp"

namespace crackle {

/// Options for running a test and writing its results.
struct TestOptions {
    std::filesystem::path folder;  ///< output folder, OUT
    bool force = false;            ///< whether to replace earlier results in OUT
    bool begins_again = false;     ///< with `force`: whether to discard the files of an unfinished test in OUT.new
    bool verify = false;           ///< whether to carry out the companion runs (specimens/loading/companions.hpp)
    bool profile = false;          ///< whether to time the phases of a step, for the summary
    int threads = 0;               ///< number of threads; 0: the number given in the case
    // Upper limit on the number of threads. Results do not depend on it.
    int most_threads = 1024;
    std::string most_threads_why;  ///< reason for the limit, used in a notice
    std::int64_t fewest_bodies_a_thread = 1;
    std::function<void()> loading_begins;  ///< called before the first file is written or changed
    /// Whether to allow any number of steps and any run time; refuse_endless() is then not called.
    bool endless = false;
    std::string command;  ///< command line that started the test, recorded in the summary
    std::chrono::steady_clock::time_point process_start = std::chrono::steady_clock::now();
};

/// Outcome of a test.
struct TestOutcome {
    Summary summary;
    std::filesystem::path folder;  ///< where the results are: OUT, or OUT.new if earlier results are still in OUT
    bool interrupted = false;
    /// Whether the companion runs were interrupted; the test is then complete, but its numerical errors are unknown.
    bool unverified = false;
    bool was_finished = false;  ///< whether resume_test() found nothing to do
};

/// Runs a test. @throws InputError; UnstableRun, with results up to then kept; TestInterrupted
TestOutcome run_test(const ResolvedCase& description, const TestOptions& options, const TestHooks& hooks = {});

/// Resumes a test from its last checkpoint.
/// @throws InputError if the folder, its case or its checkpoint are inconsistent
TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks = {});

}  // namespace crackle
