// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program and ends it by a signal once it has reached a given state. There are no waiting times, since the
// speed of machines and sanitizers differs by a factor of twenty.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace crackle::testing {

/// Starts the program in a folder, with standard output and error in out.txt and err.txt there.
inline pid_t started_call(const std::filesystem::path& folder, std::vector<std::string> words) {
    const pid_t child = ::fork();
    if (child != 0) return child;
    words.insert(words.begin(), CRACKLE_PROGRAM);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    if (::chdir(folder.c_str()) == 0 && ::freopen("out.txt", "w", stdout) != nullptr &&
        ::freopen("err.txt", "w", stderr) != nullptr)
        ::execv(CRACKLE_PROGRAM, arguments.data());
    ::_exit(127);
}

/// Waits for the process to end. @return its exit code; -1 if a signal ended it
inline int ended_call(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Runs the program and sends the signal once `ready` returns true.
/// @return its exit code; -1 if a signal ended it, if it ended before `ready`, or if it was not ready within two
/// minutes
template <class Ready>
int interrupted_call(const std::filesystem::path& folder, const std::vector<std::string>& words, int signal,
                     const Ready& ready) {
    const pid_t child = started_call(folder, words);
    const auto last = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    int status = 0;
    bool is_ready = false;
    while (!(is_ready = ready()) && std::chrono::steady_clock::now() < last) {
        if (::waitpid(child, &status, WNOHANG) == child) {
            ADD_FAILURE() << "it ended before the signal";
            return -1;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(is_ready) << "two minutes have passed";
    ::kill(child, is_ready ? signal : SIGKILL);
    const int code = ended_call(child);
    EXPECT_NE(code, -1) << "signal " << signal << " ended it";
    return code;
}

}  // namespace crackle::testing
