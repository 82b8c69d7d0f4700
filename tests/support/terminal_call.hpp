// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program on a pseudo-terminal and returns what a user would see, including control sequences.
#pragma once

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace crackle::testing {

struct TerminalAnswer {
    int code = -1;
    std::string shown;     ///< stdout and stderr together
    double seconds = 0.0;  ///< s, duration of the call
};

/// @param words shell words after the program's path @param environment variables set in addition to the caller's
/// @param program path of the program
inline TerminalAnswer call_on_terminal(const std::filesystem::path& folder, const std::string& words,
                                       const std::vector<std::pair<std::string, std::string>>& environment = {},
                                       unsigned short columns = 120, const std::string& program = CRACKLE_PROGRAM) {
    const auto begun = std::chrono::steady_clock::now();
    winsize size{24, columns, 0, 0};
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
        unsetenv("NO_COLOR");
        setenv("TERM", "xterm", 1);
        for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
        const std::string command = "exec '" + program + "' " + words;
        if (chdir(folder.c_str()) == 0) execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    TerminalAnswer answer;
    if (child < 0) return answer;
    char bytes[4096];
    for (ssize_t got = 0; (got = read(terminal, bytes, sizeof bytes)) > 0;)
        answer.shown.append(bytes, static_cast<std::size_t>(got));
    close(terminal);
    int status = 0;
    waitpid(child, &status, 0);
    answer.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return answer;
}

}  // namespace crackle::testing
