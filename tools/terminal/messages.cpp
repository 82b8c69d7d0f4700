// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/messages.hpp"

#include <fmt/format.h>

#include <iostream>
#include <string_view>

#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

constexpr std::string_view notice_mark = "notice:";

}  // namespace

Messages::Messages(Loudness loudness)
    : loudness_(loudness),
      begun_(std::chrono::steady_clock::now()),
      last_line_(begun_),
      progress_(loudness != Loudness::quiet) {}

void Messages::line(const std::string& text) {
    progress_.clear();
    if (verbose()) {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> all = now - begun_, stage = now - last_line_;
        std::cerr << styled(fmt::format("{:8.2f} s {:+8.2f}  ", all.count(), stage.count()), Style::faint, Stream::err);
        last_line_ = now;
    }
    if (text.starts_with(notice_mark)) {
        std::cerr << styled(std::string(notice_mark), Style::notice, Stream::err) << text.substr(notice_mark.size());
    } else {
        std::cerr << text;
    }
    std::cerr << '\n';
}

void Messages::stage(const std::string& text) {
    if (!quiet()) line(text);
}

void Messages::detail(const std::string& text) {
    if (verbose()) line(text);
}

void Messages::notice(const std::string& text) {
    if (quiet()) return;
    progress_.clear();
    std::cerr << styled("crackle:", Style::notice, Stream::err) << ' ' << text << '\n';
}

void report_error(const std::string& text) {
    const std::string own = "crackle ";
    const std::size_t colon = text.find(": ");
    const bool named = text.starts_with(own) && colon != std::string::npos &&
                       text.find_first_of("/.", own.size()) > colon;  // no file's name
    const std::string beginning = named ? text.substr(0, colon + 1) : "crackle:";
    std::cerr << styled(beginning, Style::error, Stream::err) << ' ' << (named ? text.substr(colon + 2) : text) << '\n';
}

}  // namespace crackle::tools
