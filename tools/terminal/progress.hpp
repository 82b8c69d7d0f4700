// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of long work: a line on stderr that is overwritten and finally removed. It is shown only on a terminal.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <string>

namespace crackle::tools {

/// Progress of some work. Values that are NaN are unknown and not shown.
struct Progress {
    double share = std::numeric_limits<double>::quiet_NaN();  ///< completed fraction, 0 to 1
    double rate = std::numeric_limits<double>::quiet_NaN();   ///< number of `unit` per second
    const char* unit = "";
    double seconds_left = std::numeric_limits<double>::quiet_NaN();
    std::string detail = {};
};

/// A duration as text, for example "31 s", "2 min 5 s" or "1 h 12 min"; empty if it is not finite. @param seconds >= 0
std::string spoken_time(double seconds);

/// Text of the progress line, without control sequences. @param columns width at which it is cut off
std::string progress_text(const Progress& progress, std::size_t columns);

class ProgressLine {
  public:
    /// @param wanted whether to show the line; false, for example, if stderr is not a terminal
    explicit ProgressLine(bool wanted);
    /// Passes progress to `heard` instead of drawing it, as often as the line would be drawn. If `heard` is empty,
    /// progress is discarded.
    explicit ProgressLine(std::function<void(const Progress&)> heard);
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    bool shown() const { return shown_; }

    /// Starts work that consists of `all` units. `what` is drawn at once, since the first unit may take long.
    /// @param unit name of the unit in the rate, plural; empty if units differ too much for an estimate of rate and
    /// remaining time
    void begin(const std::string& what, double all, const char* unit);
    /// Reports the number of completed units. Rate and remaining time are estimated from the time since begin(). The
    /// line is drawn at most five times per second.
    void count(double done, const std::string& detail = {});
    /// Starts the next stage of work that consists of a few long stages, and draws the line at once.
    /// @param done number of completed stages
    void step(double done, const std::string& what);
    /// Draws progress whose rate and completed fraction the caller has determined.
    void draw(const Progress& progress);
    /// Erases the line; the next drawing shows it again.
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
