// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of terminals: whether a stream is a terminal, its width, and colours. Colours follow https://no-color.org.
// Tested by tests/tools/commands/command_line_test.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace crackle::tools {

enum class Stream : std::uint8_t { out, err };

/// Whether a stream is a terminal on which a line can be overwritten. False for pipes and files, or if TERM is dumb.
bool is_terminal(Stream stream);

/// Width in columns of the terminal on stderr; 80 if unknown.
std::size_t terminal_columns();

enum class Style : std::uint8_t { heading, error, notice, faint };

/// The text in the given style if the stream is a terminal and NO_COLOR is not set; otherwise the text itself.
std::string styled(const std::string& text, Style style, Stream stream);

}  // namespace crackle::tools
