// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "solver/base/errors.hpp"
#include "solver/base/threads_to_be_had.hpp"

namespace crackle::tools {

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int workers_of_machine(std::optional<int> asked, const std::string& command) {
    constexpr int most_workers = 1024;
    const int workers = asked.value_or(processors());
    if (workers < 1 || workers > most_workers)
        throw InputError(fmt::format("{}: --workers: found {}, expected 1 to {}", command, workers, most_workers));
    return workers;
}

ThreadRoom room_for_threads(int asked) {
    const int most = std::min(asked, processors());
    // Frames are drawn beside them on one more.
    const int had = most > 1 ? std::clamp(threads_to_be_had(most + 1) - 1, 1, most) : most;
    if (had < most) return {had, fmt::format("the system lets this process have {} more", had)};
    return {had, fmt::format("this process has {} processors", had)};
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
