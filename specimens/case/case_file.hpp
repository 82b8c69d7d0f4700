// SPDX-License-Identifier: GPL-3.0-or-later
// Case files: everything one virtual test needs to know (test_case.hpp), read from one TOML file.
//
// Every parameter is declared once, in parameters.cpp: table, key, unit, default, range, sentence. The reader, the
// error texts, `crackle test --keys` and the resolved case that a test leaves beside its results all come from that
// declaration. A case may begin with include = "other.toml": the other file's values hold wherever the case is silent,
// so that several tests share one specimen.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "specimens/case/test_case.hpp"

namespace crackle {

/// Reads and checks a case. @throws InputError «file:line: key: found X, expected Y; what to do».
TestCase read_case(const std::filesystem::path& path);

/// Writes the case with every value in the open, each with its unit and sentence; reading it back gives the same test.
/// @param folder where the text will stand: paths are written relative to it.
void write_resolved_case(std::ostream& out, const TestCase& test, const std::filesystem::path& folder);

/// The table of all keys with unit, default, range and sentence, for people.
void describe_case_keys(std::ostream& out);

}  // namespace crackle
