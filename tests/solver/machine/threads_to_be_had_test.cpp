// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that threads are counted as the system provides them.
#include "solver/machine/threads_to_be_had.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace crackle {
namespace {

/// Counts threads in a process whose user may have `limit` threads in total. A root user has no such limit, so the
/// process changes to the user nobody.
int counted_below(rlim_t limit, int most) {
    constexpr uid_t nobody = 65534;
    const pid_t child = fork();
    if (child == 0) {
        if (getuid() == 0 && setuid(nobody) != 0) _exit(255);
        const rlimit allowed{limit, limit};
        if (setrlimit(RLIMIT_NPROC, &allowed) != 0) _exit(255);
        _exit(threads_to_be_had(most));
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    return WEXITSTATUS(status);
}

TEST(ThreadsToBeHad, AreAtMostAsManyAsAreAskedFor) {
    EXPECT_EQ(threads_to_be_had(1), 1);
    EXPECT_EQ(threads_to_be_had(0), 1);
    EXPECT_EQ(threads_to_be_had(8), 8);
}

TEST(ThreadsToBeHad, AreAsManyAsTheUserMayHave) {
    EXPECT_EQ(counted_below(1, 16), 1);
    const int few = counted_below(5, 16);
    EXPECT_GE(few, 1);
    EXPECT_LE(few, 5);
}

}  // namespace
}  // namespace crackle
