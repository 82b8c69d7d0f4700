// SPDX-License-Identifier: GPL-3.0-or-later
// TOML files as toml++ reads them, and how errors name what stands in them.
// Tested by tests/specimens/case/case_file_test.cpp.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>
#include <string_view>

namespace crackle {

/// @param expected in words, "a case file" @throws InputError «file:line: …» if there is none, or it is not TOML
toml::table parse_toml(const std::filesystem::path& path, const std::string& expected);

/// The same of a text. @param name for errors
toml::table parse_toml_text(const std::filesystem::path& name, const std::string& text);
/// The same content written as JSON, an object; its nodes have no lines. @throws InputError where it is something else
toml::table toml_of_json(const std::filesystem::path& name, std::string_view json);

/// "file:line"; "file" of a node that comes from no line.
std::string line_of(const std::filesystem::path& file, const toml::node& node);
/// What a node is, "a whole number".
std::string kind_name(const toml::node& node);
/// Its value where it is short enough, texts in quotes; else what it is.
std::string shown(const toml::node& node);

}  // namespace crackle
