// SPDX-License-Identifier: GPL-3.0-or-later
// What the program prints on stderr beside its results: stages, notices, how far it is, and errors.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "tools/terminal/progress.hpp"

namespace crackle::tools {

enum class Loudness : std::uint8_t { quiet, usual, verbose };

/// A host that has messages in place of a terminal, as Python does. Empty members hear nothing.
struct Listener {
    std::function<void(const std::string&)> stage, detail, notice;
    std::function<void(const Progress&)> progress;
};

class Messages {
  public:
    explicit Messages(Loudness loudness);
    /// Quiet: nothing is printed.
    explicit Messages(Listener listener);

    bool quiet() const { return loudness_ == Loudness::quiet; }
    /// Whether a host has them, which tells its user in its own way of an end that is no error.
    bool hosted() const { return hosted_; }
    bool verbose() const { return loudness_ == Loudness::verbose; }
    ProgressLine& progress() { return progress_; }

    /// One line a stage that is done; not with -q. With -v it begins with the seconds since the command began, and
    /// since the line before.
    void stage(const std::string& text);
    /// What only -v reports, likewise.
    void detail(const std::string& text);
    /// What the user should know, one sentence; not with -q.
    void notice(const std::string& text);
    /// Before results on stdout: removes the progress line.
    void make_room() { progress_.clear(); }

  private:
    void line(const std::string& text);

    Loudness loudness_;
    bool hosted_ = false;
    Listener listener_;
    std::chrono::steady_clock::time_point begun_, last_line_;
    ProgressLine progress_;
};

/// What the program is called in its messages, before the first of them; "crackle" where nothing says otherwise.
void name_program(const std::string& name);

/// "crackle: TEXT", also with -q. A text that begins with "crackle COMMAND:" keeps that as its beginning.
void report_error(const std::string& text);

}  // namespace crackle::tools
