// SPDX-License-Identifier: GPL-3.0-or-later
// Base64 (RFC 4648, padded), the encoding of binary data in XML and HTML.
// Tested by tests/specimens/frames/frame_test.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crackle {

/// Encodes bytes as padded base64.
std::string encode_base64(std::span<const unsigned char> bytes);

/// Decodes text without white space. @return empty if the text is not padded base64
std::optional<std::vector<unsigned char>> decode_base64(std::string_view text);

}  // namespace crackle
