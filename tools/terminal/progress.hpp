// SPDX-License-Identifier: GPL-3.0-or-later
// How far long work is: one line on stderr that is written over, on a terminal only, and gone in the end.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <string>

namespace crackle::tools {

/// What is not a number is not known, and not shown.
struct Progress {
    double share = std::numeric_limits<double>::quiet_NaN();  ///< done, 0 to 1
    double rate = std::numeric_limits<double>::quiet_NaN();   ///< so many of `unit` a second
    const char* unit = "";
    double seconds_left = std::numeric_limits<double>::quiet_NaN();
    std::string detail = {};
};

/// "31 s", "2 min 5 s", "1 h 12 min"; empty for what is not finite. @param seconds >= 0
std::string spoken_time(double seconds);

/// The line's text, without what moves the cursor. @param columns where it is cut off
std::string progress_text(const Progress& progress, std::size_t columns);

class ProgressLine {
  public:
    /// @param wanted false: never shown, as where stderr is no terminal
    explicit ProgressLine(bool wanted);
    /// Draws nothing: `heard` has it, as often as it would be drawn. Empty: never
    explicit ProgressLine(std::function<void(const Progress&)> heard);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    bool shown() const { return shown_; }

    /// Begins work of `all` pieces; `what` is drawn at once, for the first piece may take long.
    /// @param unit of the rate, plural; empty: pieces are unlike, and neither rate nor time left can be estimated
    void begin(const std::string& what, double all, const char* unit);
    /// So many pieces are done: rate and time left by the pace since begin(). Drawn at most five times a second.
    void count(double done, const std::string& detail = {});
    /// The next stage of work that has few of them, each of which may take long; drawn at once.
    void step(double done, const std::string& what);
    /// The same of work that knows its own pace.
    void draw(const Progress& progress);
    /// Removes the line until it is drawn again.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;

    bool due() const;
    Progress after(double done) const;
    void put(const Progress& progress);

    bool shown_;
    std::function<void(const Progress&)> heard_;
    bool there_ = false;
    std::string what_;
    double all_ = 0.0;
    const char* unit_ = "";
    Clock::time_point begun_, drawn_;
};

}  // namespace crackle::tools
