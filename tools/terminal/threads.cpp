// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace crackle::tools {

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int threads_of_machine(int asked, Messages& messages) {
    constexpr int most_threads = 1024;
    if (asked <= processors() || asked > most_threads) return asked;
    messages.notice(fmt::format("{0} of {1} threads are used: this process has {0} processors", processors(), asked));
    return processors();
}

}  // namespace crackle::tools
