// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/commands/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace crackle::tools {

std::string draw_with_gnuplot(const std::filesystem::path& script) {
    const std::filesystem::path folder = script.has_parent_path() ? script.parent_path() : ".";
    std::string program = "gnuplot", name = script.filename().string();
    char* const words[] = {program.data(), name.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    pid_t child = 0;
    const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed == ENOENT) return "found no gnuplot, expected it on the PATH; install Debian's gnuplot-nox";
    if (failed != 0) return fmt::format("gnuplot cannot be started ({})", std::strerror(failed));
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) return fmt::format("gnuplot ended unexpectedly ({})", std::strerror(errno));
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    return fmt::format("gnuplot did not draw {}", name);
}

}  // namespace crackle::tools
