// SPDX-License-Identifier: GPL-3.0-or-later
// A crew of worker processes, each of which handles one work item (`piece`) at a time. An item that crashes its process
// or takes too long is reported and does not affect the others.
//
// Workers are forked from the calling process and see its data as of that time; it must not have started any threads
// before. Workers end when the calling process ends, for whatever reason.
// Tested by tests/specimens/campaign/crew_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace crackle {

/// Exit code of a worker that ran out of memory.
inline constexpr int worker_without_memory = 71;

/// How the processing of a work item ended.
struct PieceEnd {
    /// Whether the worker returned an answer, ended by itself, was killed by a signal, or took too long.
    enum class How : std::uint8_t { answered, ended, killed, timed_out } how = How::answered;
    std::string answer;  ///< the worker's answer, if it returned one
    int code = 0;        ///< exit code if the process ended by itself; signal if it was killed
    double seconds = 0.0;
};

/// Text for a process that ended without an answer: "its process was ended by signal 11 (Segmentation fault)".
std::string spoken_end(const PieceEnd& end);

/// Callbacks and limits of run_crew().
struct CrewWork {
    /// Processes a work item and returns the answer. Runs in the worker.
    std::function<std::string(std::size_t piece)> work;
    /// Returns the next work item for a worker; empty if none is available at present. Runs in the parent process.
    /// @param before  previous work item of that worker
    std::function<std::optional<std::size_t>(std::optional<std::size_t> before)> next;
    /// Called when the processing of a work item has ended. Runs in the parent process.
    std::function<void(std::size_t piece, const PieceEnd& end)> ended;
    /// Polled several times a second; once it returns true, the workers are killed and their work items abandoned.
    std::function<bool()> interrupted;
    double time_limit = 0.0;  ///< largest time per work item, s; 0: no limit
};

/// Processes work items until `next` returns no more and all workers are idle, or until interrupted() returns true.
/// @return whether all work items were processed @throws std::system_error if a process cannot be created
bool run_crew(int workers, const CrewWork& crew);

}  // namespace crackle
