// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/threads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/errors.hpp"
#include "solver/machine/processors_lent.hpp"
#include "solver/machine/threads_to_be_had.hpp"

namespace crackle::tools {

namespace {

/// Limits a number of threads or processes to what the operating system allows, less one: a further thread is always
/// started, to draw frames or to wait for the others.
int to_be_had(int wanted) { return wanted > 1 ? std::clamp(threads_to_be_had(wanted + 1) - 1, 1, wanted) : wanted; }

}  // namespace

int workers_of_machine(std::optional<int> asked, const std::string& command) {
    constexpr int most_workers = 1024;
    const int workers = asked ? *asked : to_be_had(processors_lent());
    if (workers < 1 || workers > most_workers)
        throw InputError(fmt::format("{}: --workers: found {}, expected 1 to {}", command, workers, most_workers));
    return workers;
}

ThreadRoom room_for_threads(int asked) {
    const int most = std::min(asked, processors_lent());
    const int had = to_be_had(most);
    if (had < most) return {had, fmt::format("the operating system allows this process only {}", had)};
    return {had, fmt::format("this process may use {} processor{}", had, had == 1 ? "" : "s")};
}

int threads_of_machine(int asked, Messages& messages) {
    constexpr int most_threads = 1024;
    if (asked <= 1 || asked > most_threads) return asked;
    const ThreadRoom room = room_for_threads(asked);
    if (room.threads < asked)
        messages.notice(fmt::format("{} of {} threads are used: {}", room.threads, asked, room.why));
    return room.threads;
}

}  // namespace crackle::tools
