// SPDX-License-Identifier: GPL-3.0-or-later
// Case files: everything one virtual test needs to know (test_case.hpp), read from one TOML file.
//
// Every parameter is declared once (declare_parameter.hpp): table, key, unit, default, range, sentence. The reader, the
// error texts, `crackle test --keys` and the resolved case that a test leaves beside its results all come from that
// declaration. A case may begin with include = "other.toml": the other file's values hold wherever the case is silent,
// so that several tests share one specimen.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "specimens/case/test_case.hpp"

namespace crackle {

/// A value for one key, over what the files say: a point of a campaign's axis, say.
struct CaseSetting {
    std::string key;  ///< "material.cohesion"; of a table that may come several times "mineral[2].cohesion"
    CaseValue value;
    std::string where;  ///< "file:line" for errors; paths are relative to that file
};

/// A case that is no file: its text, as TOML or as the same tables in JSON.
struct CaseText {
    std::string name = "case";  ///< in errors, and its title unless it has one
    std::string text;
    bool json = false;  ///< keys have no lines then
    /// Paths in it are relative to the present folder.
};

/// What a case and the files it includes say, before settings and defaults: read once, made into many tests.
class CaseFiles {
  public:
    /// @throws InputError as read_case(), but for what only the whole case shows
    explicit CaseFiles(const std::filesystem::path& path);
    explicit CaseFiles(const CaseText& text);

    /// The test with settings over what the files say, the last one over those before it. @throws InputError
    TestCase with(std::span<const CaseSetting> settings) const;

    /// The joints alone, of a file that need not be a whole case: defaults and checks of [joints], [[joint_set]] and
    /// [[trace]]; of the rest what the files say. @throws InputError
    TestCase joints() const;

  private:
    TestCase written_;
};

/// Reads and checks a case. @throws InputError «file:line: key: found X, expected Y; what to do».
TestCase read_case(const std::filesystem::path& path);
TestCase read_case(const CaseText& text);

/// Writes the case with every value in the open, each with its unit and sentence; reading it back gives the same test.
/// @param folder where the text will stand: paths are written relative to it.
void write_resolved_case(std::ostream& out, const TestCase& test, const std::filesystem::path& folder);

struct Parameter;

/// One key of a case with the value that it has, written or by default.
struct ResolvedKey {
    std::string label;  ///< "material.cohesion", "mineral[2].cohesion"
    const Parameter* parameter;
    CaseValue value;
};
/// All that have one, in the order of a written case. Equal lists are equal tests, but for what files contain.
std::vector<ResolvedKey> resolved_keys(const TestCase& test);

/// The table of all keys with unit, default, range and sentence, for people.
void describe_case_keys(std::ostream& out);

}  // namespace crackle
