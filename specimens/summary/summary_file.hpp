// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a summary to JSON and back. The keys of the file are the names of the members. The members of a nested
// struct appear among the members of the struct around it.
// Tested by tests/specimens/summary/summary_test.cpp.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "specimens/summary/summary.hpp"

namespace crackle {

/// The summary as JSON. Callers must include the JSON library.
nlohmann::ordered_json json_of(const Summary& summary);
/// Text of the file, on one line if `indent` is negative; otherwise one line per entry, indented by `indent` spaces per
/// level. File names need not be UTF-8: invalid bytes are replaced rather than rejected.
std::string text_of(const Summary& summary, int indent = -1);

/// Converts JSON to a summary. A value whose type differs from the declared one is unknown; undeclared keys are
/// ignored.
Summary summary_from(const nlohmann::ordered_json& json);
/// Reads the text of a finished test's summary.json. @param file  name of the file, for messages
/// @throws InputError if it is not valid JSON, or if kind, specimen or failed is missing or invalid
Summary read_summary(const std::string& file, std::string_view text);
/// Reads the text of a file that may be damaged. The summary is empty if the text is not valid JSON.
Summary parse_summary(std::string_view text);

}  // namespace crackle
