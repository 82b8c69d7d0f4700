// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/messages.hpp"

#include <fmt/format.h>

#include <iostream>
#include <string_view>
#include <utility>

#include "tools/terminal/printable.hpp"
#include "tools/terminal/terminal.hpp"

namespace crackle::tools {
namespace {

constexpr std::string_view notice_mark = "notice:";

// Largest number of bytes printed of one message; longer text is usually the contents of a file.
constexpr std::size_t longest_message = 2000;

std::string& program_name() {
    static std::string name = "crackle";
    return name;
}

/// The message in printable form, shortened if it is too long.
std::string shown(std::string_view text) {
    std::string beginning = printable(text.substr(0, longest_message));
    if (text.size() > longest_message) beginning += fmt::format("... ({} bytes more)", text.size() - longest_message);
    return beginning;
}

}  // namespace

Messages::Messages(Loudness loudness)
    : loudness_(loudness),
      begun_(std::chrono::steady_clock::now()),
      last_line_(begun_),
      progress_(loudness != Loudness::quiet) {}

Messages::Messages(Listener listener)
    : loudness_(Loudness::quiet),
      hosted_(true),
      listener_(std::move(listener)),
      begun_(std::chrono::steady_clock::now()),
      last_line_(begun_),
      progress_(listener_.progress) {}

void Messages::line(const std::string& text) {
    progress_.clear();
    if (verbose()) {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> all = now - begun_, stage = now - last_line_;
        std::cerr << styled(fmt::format("{:8.2f} s {:+8.2f}  ", all.count(), stage.count()), Style::faint, Stream::err);
        last_line_ = now;
    }
    if (text.starts_with(notice_mark)) {
        std::cerr << styled(std::string(notice_mark), Style::notice, Stream::err)
                  << shown(text.substr(notice_mark.size()));
    } else {
        std::cerr << shown(text);
    }
    std::cerr << '\n';
}

void Messages::stage(const std::string& text) {
    if (listener_.stage) listener_.stage(text);
    if (!quiet()) line(text);
}

void Messages::detail(const std::string& text) {
    if (listener_.detail) listener_.detail(text);
    if (verbose()) line(text);
}

void Messages::notice(const std::string& text) {
    if (listener_.notice) listener_.notice(text);
    if (quiet()) return;
    progress_.clear();
    std::cerr << styled(program_name() + ':', Style::notice, Stream::err) << ' ' << shown(text) << '\n';
}

void name_program(const std::string& name) { program_name() = name; }

void report_error(const std::string& text) {
    const std::string own = program_name() + ' ';
    const std::size_t colon = text.find(": ");
    const bool named = text.starts_with(own) && colon != std::string::npos &&
                       text.find_first_of("/.", own.size()) > colon;  // the text before the colon is not a file name
    const std::string beginning = named ? text.substr(0, colon + 1) : program_name() + ':';
    std::cerr << styled(beginning, Style::error, Stream::err) << ' ' << shown(named ? text.substr(colon + 2) : text)
              << '\n';
}

}  // namespace crackle::tools
