// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace crackle::tools {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void take_down_interrupt(int signal) {
    asked = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_interrupts() {
    std::signal(SIGINT, take_down_interrupt);
    std::signal(SIGTERM, take_down_interrupt);
    std::signal(SIGHUP, take_down_interrupt);
}

void make_writing_fail_by_error() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() { return asked; }

}  // namespace crackle::tools
