// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace crackle::tools {
namespace {

const char* code_of(Style style) {
    switch (style) {
        case Style::heading:
            return "1";
        case Style::error:
            return "1;31";
        case Style::notice:
            return "33";
        case Style::faint:
            break;
    }
    return "2";
}

}  // namespace

bool is_terminal(Stream stream) {
    const char* kind = std::getenv("TERM");
    if (kind == nullptr || *kind == '\0' || std::string_view(kind) == "dumb") return false;
    return isatty(stream == Stream::out ? STDOUT_FILENO : STDERR_FILENO) == 1;
}

std::size_t terminal_columns() {
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

std::string styled(const std::string& text, Style style, Stream stream) {
    const char* refused = std::getenv("NO_COLOR");
    if ((refused != nullptr && *refused != '\0') || !is_terminal(stream)) return text;
    return std::string("\x1b[") + code_of(style) + 'm' + text + "\x1b[0m";
}

}  // namespace crackle::tools
