// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/test_test.cpp and tests/faults/threads_test.py.
#pragma once

#include <optional>
#include <string>

#include "tools/terminal/messages.hpp"

namespace crackle::tools {

/// Processes that run tests: as asked for, else one for each processor lent to this process. @throws InputError if that
/// is none, or above 1024
int workers_of_machine(std::optional<int> asked, const std::string& command);

struct ThreadRoom {
    int threads = 1;
    std::string why;  ///< there are no more
};

/// Threads that are of use here: at most as many as asked for, as processors are lent to this process (threads that
/// share one wait for each other at every step), and as the system gives it now.
ThreadRoom room_for_threads(int asked);

/// The same, with a notice where these are fewer than asked for. Numbers that are none (below 1, above 1024) are left
/// to be refused.
int threads_of_machine(int asked, Messages& messages);

}  // namespace crackle::tools
