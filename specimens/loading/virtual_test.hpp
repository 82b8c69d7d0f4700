// SPDX-License-Identifier: GPL-3.0-or-later
// One virtual test from its case to its results.
//
//   bond_test()     case → specimen → platens → world → bonds → linear solution, at rest
//   prepare_test()  and the start of loading: ready to be loaded, nothing written
//   load_specimen() steps the world until it fails, reaches its largest strain or is interrupted; files are optional
//   run_test(), resume_test()  the same with the folder OUT
//
// Observers look in steps that somebody reads, in a fixed order: curve row, failure, frame; broken bonds as they come.
// Nothing of this reaches the kernels.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "specimens/case/case_file.hpp"
#include "specimens/elastic/moduli.hpp"
#include "specimens/making/hooks.hpp"
#include "specimens/making/specimen.hpp"
#include "specimens/results/state.hpp"
#include "specimens/setup/setup.hpp"

namespace crackle {

class TestFiles;

struct VirtualTest {
    TestCase description;
    TestSetup setup;
    TestState state;
    World world;
    std::optional<SmallStrain> small_strain;  ///< linear solution with bonded platens; none: a notice says why
    double specimen_seconds = 0.0;            ///< wall clock that making the specimen took
};

struct TestOptions {
    std::filesystem::path folder;  ///< OUT
    bool force = false;
    bool verify = false;   ///< run the companions, specimens/loading/companions.hpp
    bool profile = false;  ///< time the phases of a step, for the summary
    int threads = 0;       ///< 0: the case's
    std::string command;   ///< for the summary
    std::chrono::steady_clock::time_point process_start = std::chrono::steady_clock::now();
};

struct TestOutcome {
    nlohmann::ordered_json summary;
    std::filesystem::path folder;  ///< where the results are: OUT, or OUT.new if earlier results are still in OUT
    bool interrupted = false;
    bool unverified = false;    ///< the companions were interrupted: the test is complete, but states no error
    bool was_finished = false;  ///< resume_test() found nothing to do
};

/// @throws InputError for everything that makes the case impossible; TestInterrupted.
VirtualTest bond_test(const TestCase& description, const TestHooks& hooks = {});

/// @throws as bond_test()
VirtualTest prepare_test(const TestCase& description, const TestHooks& hooks = {});

/// Loads to the end. @param files where to write; nullptr: rows and events stay in memory (state.rows,
/// world.bonds.events)
/// @throws UnstableRun with everything so far kept.
void load_specimen(VirtualTest& test, const TestHooks& hooks = {}, TestFiles* files = nullptr);

/// @throws InputError, UnstableRun (results up to there are kept), TestInterrupted
TestOutcome run_test(const TestCase& description, const TestOptions& options, const TestHooks& hooks = {});

/// Goes on with a test from its last checkpoint. @throws InputError if the folder, its case or its checkpoint do not
/// fit.
TestOutcome resume_test(const TestOptions& options, const TestHooks& hooks = {});

}  // namespace crackle
