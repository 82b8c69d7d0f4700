// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/test_test.cpp and tests/faults/threads_test.py.
#pragma once

#include <optional>
#include <string>

#include "tools/terminal/messages.hpp"

namespace crackle::tools {

/// Number of worker processes that run tests: as requested, or one for each processor that this process may use.
/// @throws InputError if the requested number is below 1 or above 1024
int workers_of_machine(std::optional<int> asked, const std::string& command);

struct ThreadRoom {
    int threads = 1;
    std::string why;  ///< what limits the number of threads, for a notice if fewer are used than requested
};

/// Number of threads worth using: at most the number requested, the number of processors that this process may use, and
/// the number of threads that the system allows. Threads that share a processor would wait for each other at every
/// step.
ThreadRoom room_for_threads(int asked);

/// As above, with a notice if the number is less than requested. Invalid numbers (below 1 or above 1024) are returned
/// unchanged, to be refused by the caller.
int threads_of_machine(int asked, Messages& messages);

}  // namespace crackle::tools
