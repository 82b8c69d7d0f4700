// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/machine/threads_to_be_had_test.cpp.
#pragma once

namespace crackle {

/// Number of threads that the operating system allows this process to run at the same time, including the current one.
/// Limits of a user or container may be far below the number of processors. OpenMP aborts the process if it cannot
/// create a thread, so callers check here before starting a team.
/// @param most number of threads to try @return between 1 and `most`
int threads_to_be_had(int most);

}  // namespace crackle
