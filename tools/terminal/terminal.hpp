// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a stream is a terminal, and what may be shown there. Colours: https://no-color.org.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace crackle::tools {

enum class Stream : std::uint8_t { out, err };

/// A terminal that can write over a line: not a pipe, not a file, not TERM=dumb.
bool is_terminal(Stream stream);

/// Columns of the terminal on stderr; 80 where that is unknown.
std::size_t terminal_columns();

enum class Style : std::uint8_t { heading, error, notice, faint };

/// The text in a style, where the stream is a terminal and NO_COLOR is not set; else the text alone.
std::string styled(const std::string& text, Style style, Stream stream);

}  // namespace crackle::tools
