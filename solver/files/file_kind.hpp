// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/files/file_kind_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace crackle {

/// What a file is, by its first bytes, that people have in hand and this program does not read: "GeoJSON", "an SVG
/// drawing", "a spreadsheet (xlsx, ods) or another zip archive". Empty for plain text.
std::string_view foreign_kind(std::string_view bytes);

/// @param expected what is read here, and what to do with such a file
/// @throws InputError «name: found GeoJSON, expected ...» for a file of such a kind
void refuse_foreign(const std::string& name, std::string_view bytes, const std::string& expected);

}  // namespace crackle
