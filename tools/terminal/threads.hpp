// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/tools/commands/test_test.cpp.
#pragma once

#include "tools/terminal/messages.hpp"

namespace crackle::tools {

/// Processors that this process may use, at least 1.
int processors();

/// Threads asked for, at most as many as this process has processors, with a notice where these are fewer: threads that
/// share one wait for each other at every step. Numbers that are none (below 1, above 1024) are left to be refused.
int threads_of_machine(int asked, Messages& messages);

}  // namespace crackle::tools
