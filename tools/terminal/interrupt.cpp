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

std::atomic<bool> stop_asked{false}, heard{false}, on_terminal{false};
std::atomic<const char*> words_unheard{nullptr};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free,
              "variables used in a signal handler must be lock-free");

constexpr unsigned patience = 2,
                   last_patience = 3;  // waiting times before the message and before the end, s
constexpr int exit_code_interrupted = 130;

void put(std::string_view text) {
    // Errors of writing to a closed terminal are ignored, since the program is about to end.
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void put_line(std::string_view text) {
    if (on_terminal) put("\r\x1b[K");  // overwrites the progress line
    put("crackle: ");
    put(text);
    put("\n");
}

extern "C" void end_if_unheard(int /*signal*/) {
    const int reason = errno;
    const char* const last_words = words_unheard;
    if (last_words != nullptr && !heard) {
        put_line(last_words);
        ::_exit(exit_code_interrupted);
    }
    errno = reason;
}

extern "C" void report_still_here(int /*signal*/) {
    const int reason = errno;
    if (words_unheard != nullptr && !heard) {
        put_line("will end in three seconds, or when the current solve is done; press Ctrl-C again to end at once");
    } else {
        put_line("will end when the current solve or file is done; press Ctrl-C again to end at once");
    }
    std::signal(SIGALRM, end_if_unheard);
    ::alarm(last_patience);
    errno = reason;
}

extern "C" void take_down_interrupt(int /*signal*/) {
    const int reason = errno;
    stop_asked = true;
    // The next signal of any of these kinds ends the program.
    for (const int next : {SIGINT, SIGTERM, SIGHUP}) std::signal(next, SIG_DFL);
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

void end_unheard(const char* last_words) { words_unheard = last_words; }

bool interrupted() {
    if (host()) return host()();
    if (stop_asked) heard = true;
    return stop_asked;
}

}  // namespace crackle::tools
