// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/terminal/printable.hpp"

#include <unistd.h>

#include <algorithm>
#include <iostream>

#include "solver/base/utf8.hpp"

namespace crackle::tools {

std::string printable(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const auto [bytes, code] = first_letter(text);
        if (bytes == 0 || (code < 0x20U && code != '\n' && code != '\t')) {
            shown += fmt::format("\\x{:02x}", code);
        } else if (code >= 0x7fU && code < 0xa0U) {
            shown += fmt::format("\\u{:04x}", code);
        } else {
            shown += text.substr(0, bytes);
        }
        text.remove_prefix(std::max<std::size_t>(1, bytes));
    }
    return shown;
}

void print_text(std::string_view text) { std::cout << printable(text); }

void print_bytes(std::string_view bytes) {
    if (isatty(STDOUT_FILENO) == 1) {
        print_text(bytes);
    } else {
        std::cout << bytes;
    }
}

}  // namespace crackle::tools
