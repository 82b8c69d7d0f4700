// SPDX-License-Identifier: GPL-3.0-or-later
// Output on stderr in addition to results: stages, notices, progress and errors.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "tools/terminal/progress.hpp"

namespace crackle::tools {

enum class Loudness : std::uint8_t { quiet, usual, verbose };

/// Receives messages for a host without a terminal, such as Python. If a member is empty, its messages are discarded.
struct Listener {
    std::function<void(const std::string&)> stage, detail, notice;
    std::function<void(const Progress&)> progress;
};

class Messages {
  public:
    explicit Messages(Loudness loudness);
    /// Prints nothing and passes messages to the listener.
    explicit Messages(Listener listener);

    bool quiet() const { return loudness_ == Loudness::quiet; }
    /// Whether a host receives the messages. A host reports interruptions to its user in its own way.
    bool hosted() const { return hosted_; }
    bool verbose() const { return loudness_ == Loudness::verbose; }
    ProgressLine& progress() { return progress_; }

    /// Prints a line for a completed stage, except with -q. With -v the line begins with the seconds since the start of
    /// the command and since the previous line.
    void stage(const std::string& text);
    /// Prints a detail, only with -v; the line has the same form as for stage().
    void detail(const std::string& text);
    /// Prints a one-sentence notice for the user; prints nothing with -q.
    void notice(const std::string& text);
    /// Removes the progress line. Call this before printing results to stdout.
    void make_room() { progress_.clear(); }

  private:
    void line(const std::string& text);

    Loudness loudness_;
    bool hosted_ = false;
    Listener listener_;
    std::chrono::steady_clock::time_point begun_, last_line_;
    ProgressLine progress_;
};

/// Sets the program's name in messages; call it before the first message. The default is "crackle".
void name_program(const std::string& name);

/// Prints "crackle: TEXT", also with -q. If the text itself begins with "crackle COMMAND:", no prefix is added.
void report_error(const std::string& text);

}  // namespace crackle::tools
