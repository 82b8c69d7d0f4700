// SPDX-License-Identifier: GPL-3.0-or-later
// Tested by tests/solver/files/file_kind_test.cpp.
#pragma once

#include <string>
#include <string_view>

namespace crackle {

/// Recognises, from a file's first bytes, kinds of files that users may have but this program does not read: "GeoJSON",
/// "an SVG drawing", "a spreadsheet (xlsx, ods) or another zip archive". Empty for plain text.
std::string_view foreign_kind(std::string_view bytes);

/// Refuses a file whose kind foreign_kind() recognises. @param expected what the program reads here, and what the user
/// can do with the file @throws InputError «name: found GeoJSON, expected ...»
void refuse_foreign(const std::string& name, std::string_view bytes, const std::string& expected);

}  // namespace crackle
