// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/machine/threads_to_be_had.hpp"

#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace crackle {

int threads_to_be_had(int most) {
    std::mutex gate;  // locked until all threads have been started, so that they exist at the same time
    std::vector<std::thread> others;
    {
        const std::lock_guard closed(gate);
        try {
            while (static_cast<int>(others.size()) + 1 < most)
                others.emplace_back([&gate] { const std::lock_guard wait(gate); });
        } catch (const std::system_error&) {  // the operating system refused to create another thread
        }
    }
    for (std::thread& other : others) other.join();
    return static_cast<int>(others.size()) + 1;
}

}  // namespace crackle
