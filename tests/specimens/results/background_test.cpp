// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/results/background.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace crackle {
namespace {

TEST(Background, DoesAllJobsInTheOrderInWhichTheyCame) {
    std::vector<int> done, expected(100);
    std::iota(expected.begin(), expected.end(), 0);
    {
        Background background;
        for (const int k : expected) {
            background.make_room(2);
            background.add([&done, k] { done.push_back(k); });
        }
    }
    EXPECT_EQ(done, expected);
}

TEST(Background, WaitsUntilNothingIsLeftToDo) {
    std::atomic<int> done = 0;
    Background background;
    background.wait();
    for (int k = 0; k < 5; ++k) {
        background.add([&done] {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            ++done;
        });
    }
    background.wait();
    EXPECT_EQ(done, 5);
}

TEST(Background, HoldsNoMoreThanWhatMayWait) {
    std::atomic<int> begun = 0;
    std::atomic<bool> go_on = false;
    Background background;
    const auto job = [&] {
        ++begun;
        while (!go_on) std::this_thread::yield();
    };
    background.add(job);
    std::atomic<bool> added = false;
    std::thread second([&] {
        background.make_room(0);
        background.add(job);
        added = true;
    });
    while (begun == 0) std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_FALSE(added);
    go_on = true;
    second.join();
    background.wait();
    EXPECT_EQ(begun, 2);
}

TEST(Background, ThrowsWhatAJobThrewOnceAndDropsThoseBehindIt) {
    bool later = false;
    Background background;
    background.add([] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        throw std::runtime_error("disk is full");
    });
    background.add([&later] { later = true; });
    EXPECT_THROW(background.wait(), std::runtime_error);
    EXPECT_NO_THROW(background.wait());
    EXPECT_FALSE(later);
    background.add([&later] { later = true; });
    background.wait();
    EXPECT_TRUE(later);
}

}  // namespace
}  // namespace crackle
