// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string_view>
#include <utility>

#include "solver/base/utf8.hpp"
#include "tools/terminal/printable.hpp"
#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

constexpr std::chrono::milliseconds between_redraws{200};

/// The text cut to at most `columns` characters, without splitting UTF-8 sequences.
std::string cut_off(const std::string& text, std::size_t columns) {
    std::string_view rest = text;
    for (std::size_t letters = 0; letters < columns && !rest.empty(); ++letters)
        rest.remove_prefix(std::max<std::size_t>(first_letter(rest).bytes, 1));
    return text.substr(0, text.size() - rest.size());
}

}  // namespace

std::string spoken_time(double seconds) {
    if (!std::isfinite(seconds) || seconds > 1e9) return "";
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string progress_text(const Progress& progress, std::size_t columns) {
    std::string text;
    const auto add = [&text](const std::string& part) {
        if (!part.empty()) text += (text.empty() ? "" : "  ") + part;
    };
    if (std::isfinite(progress.share)) add(fmt::format("{:3.0f} %", 100.0 * progress.share));
    if (std::isfinite(progress.rate)) add(fmt::format("{:.3g} {}/s", progress.rate, progress.unit));
    if (const std::string left = spoken_time(progress.seconds_left); !left.empty()) add(left + " left");
    add(printable(progress.detail));
    return cut_off(text, columns);
}

ProgressLine::ProgressLine(bool wanted)
    : shown_(wanted && is_terminal(Stream::err)), begun_(Clock::now()), drawn_(begun_ - between_redraws) {}

ProgressLine::ProgressLine(std::function<void(const Progress&)> heard)
    : shown_(heard != nullptr), heard_(std::move(heard)), begun_(Clock::now()), drawn_(begun_ - between_redraws) {}

bool ProgressLine::due() const { return shown_ && Clock::now() - drawn_ >= between_redraws; }

void ProgressLine::put(const Progress& progress) {
    drawn_ = Clock::now();
    if (heard_) {
        heard_(progress);
        return;
    }
    there_ = true;
    std::cerr << "\r\x1b[K" << progress_text(progress, terminal_columns() - 1) << std::flush;
}

void ProgressLine::begin(const std::string& what, double all, const char* unit) {
    if (!shown_) return;
    what_ = what;
    all_ = all;
    unit_ = unit;
    begun_ = Clock::now();
    put({.share = 0.0, .detail = what});
}

Progress ProgressLine::after(double done) const {
    Progress progress{.share = done / all_, .unit = unit_};
    if (*unit_ == '\0' || !(done > 0.0)) return progress;
    const double pace = done / std::chrono::duration<double>(Clock::now() - begun_).count();
    progress.rate = pace;
    progress.seconds_left = (all_ - done) / pace;
    return progress;
}

void ProgressLine::count(double done, const std::string& detail) {
    if (!due()) return;
    Progress progress = after(done);
    progress.detail = what_ + (detail.empty() || what_.empty() ? "" : ", ") + detail;
    put(progress);
}

void ProgressLine::step(double done, const std::string& what) {
    if (!shown_) return;
    what_ = what;
    Progress progress = after(done);
    progress.detail = what;
    put(progress);
}

void ProgressLine::draw(const Progress& progress) {
    if (due()) put(progress);
}

void ProgressLine::clear() {
    if (!there_) return;
    there_ = false;
    drawn_ = Clock::now() - between_redraws;
    std::cerr << "\r\x1b[K" << std::flush;
}

}  // namespace crackle::tools
