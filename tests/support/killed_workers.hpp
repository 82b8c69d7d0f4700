// SPDX-License-Identifier: GPL-3.0-or-later
// Kills worker processes, to simulate a lack of memory or a crash.
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

/// Kills `count` workers of a process one after another, each as soon as it exists.
/// @return number of workers killed; fewer if the process has ended (it must still be waited for), or after two minutes
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
