// SPDX-License-Identifier: GPL-3.0-or-later
// Reads TOML files with toml++ and formats their contents for error messages.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>
#include <string_view>

namespace crackle {

/// Reads a TOML file. @param expected  the kind of file, such as "a case file" @throws InputError «file:line: …» if the
/// file is missing or not valid TOML
toml::table parse_toml(const std::filesystem::path& path, const std::string& expected);

/// Parses TOML. @param name  name of the file or text, for error messages
toml::table parse_toml_text(const std::filesystem::path& name, const std::string& text);
/// Converts a JSON object to a TOML table; its nodes have no line numbers. @throws InputError if the text is not a JSON
/// object
toml::table toml_of_json(const std::filesystem::path& name, std::string_view json);

/// The position "file:line", or only "file" for a node without a line number.
std::string line_of(const std::filesystem::path& file, const toml::node& node);
/// Name of a node's type, such as "a whole number".
std::string kind_name(const toml::node& node);
/// The value of a node if it is short, with text in quotes; otherwise the name of its type.
std::string shown(const toml::node& node);

}  // namespace crackle
