// SPDX-License-Identifier: GPL-3.0-or-later
// Workers of a process, ended from outside as the system ends those for which there is no memory, or that crash.
#pragma once

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace crackle::testing {

/// Ends `count` workers of a process by a signal, one after the other, each as soon as it is there.
/// @return how many; fewer only where the process has ended, which is left to be waited for, or after two minutes
inline int kill_workers(pid_t process, int count, int signal = SIGKILL) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    int killed = 0, before = 0;
    while (killed < count && std::chrono::steady_clock::now() < last) {
        siginfo_t state{};
        if (::waitid(P_PID, static_cast<id_t>(process), &state, WEXITED | WNOHANG | WNOWAIT) == 0 && state.si_pid != 0)
            break;
        int child = 0;
        std::ifstream(fmt::format("/proc/{0}/task/{0}/children", process)) >> child;
        if (child == 0 || child == before) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            continue;
        }
        ::kill(child, signal);
        before = child;
        ++killed;
    }
    return killed;
}

}  // namespace crackle::testing
