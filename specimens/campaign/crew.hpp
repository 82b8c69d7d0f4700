// SPDX-License-Identifier: GPL-3.0-or-later
// Processes that work off pieces one by one. A piece that brings its process down, or takes too long, is told of and
// costs the others nothing.
//
// Workers are forked from this process, before which it must have run no threads, and know what it knew then. They end
// with it, however it ends.
// Tested by tests/specimens/campaign/crew_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace crackle {

/// How a piece ended.
struct PieceEnd {
    enum class How : std::uint8_t { answered, ended, killed, timed_out } how = How::answered;
    std::string answer;  ///< of one that was answered
    int code = 0;        ///< exit code where its process ended by itself, signal where it was killed
    double seconds = 0.0;
};

struct CrewWork {
    /// What a worker does with a piece; its answer. Runs in the worker.
    std::function<std::string(std::size_t piece)> work;
    /// The next piece for a worker that has done another before; nothing: there is none for it now. Runs here.
    std::function<std::optional<std::size_t>(std::optional<std::size_t> before)> next;
    /// A piece has ended. Runs here.
    std::function<void(std::size_t piece, const PieceEnd& end)> ended;
    /// Asked some times a second; true: workers are ended, pieces at work are left.
    std::function<bool()> interrupted;
    double time_limit = 0.0;  ///< s a piece; 0: none
};

/// Works off what `next` gives until it gives nothing and no piece is at work, or interrupted() says so.
/// @return whether all was worked off @throws std::system_error if no process can be made
bool run_crew(int workers, const CrewWork& crew);

}  // namespace crackle
