// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/base/threads_to_be_had.hpp"

#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace crackle {

int threads_to_be_had(int most) {
    std::mutex gate;  // closed until all are there: what counts is how many there can be at a time
    std::vector<std::thread> others;
    {
        const std::lock_guard closed(gate);
        try {
            while (static_cast<int>(others.size()) + 1 < most)
                others.emplace_back([&gate] { const std::lock_guard wait(gate); });
        } catch (const std::system_error&) {  // refused: there are no more
        }
    }
    for (std::thread& other : others) other.join();
    return static_cast<int>(others.size()) + 1;
}

}  // namespace crackle
