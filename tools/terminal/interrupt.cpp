// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <utility>

#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

std::function<bool()>& host() {
    static std::function<bool()> hears;
    return hears;
}

std::atomic<bool> stop_asked{false}, on_terminal{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

constexpr unsigned patience = 2;  // s

void put(std::string_view text) {
    // What cannot be written to a closed terminal is no concern of one who ends.
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void report_still_here(int /*signal*/) {
    const int reason = errno;
    if (on_terminal) put("\r\x1b[K");  // in place of the progress line
    put("crackle: ends as soon as the present solve or file is done; a second Ctrl-C ends it at once\n");
    errno = reason;
}

extern "C" void take_down_interrupt(int /*signal*/) {
    const int reason = errno;
    stop_asked = true;
    for (const int next : {SIGINT, SIGTERM, SIGHUP}) std::signal(next, SIG_DFL);  // whichever comes then
    std::signal(SIGALRM, report_still_here);
    ::alarm(patience);
    errno = reason;
}

}  // namespace

void watch_interrupts() {
    if (host()) return;
    on_terminal = is_terminal(Stream::err);
    std::signal(SIGINT, take_down_interrupt);
    std::signal(SIGTERM, take_down_interrupt);
    std::signal(SIGHUP, take_down_interrupt);
}

void make_writing_fail_by_error() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void hear_interrupts_by(std::function<bool()> hears) { host() = std::move(hears); }

bool interrupted() { return host() ? host()() : stop_asked.load(); }

}  // namespace crackle::tools
