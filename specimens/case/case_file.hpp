// SPDX-License-Identifier: GPL-3.0-or-later
// Case files. A case file is a TOML file that completely describes one virtual test.
//
// Every parameter is declared once (declare_parameter.hpp): table, key, unit, default, range and a one-sentence
// description. The reader, the error messages, `crackle test --keys` and the resolved case stored with the results all
// use that declaration. A case may begin with include = "other.toml": keys that the case does not set take their values
// from the other file, so several tests can share one specimen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "specimens/case/parameter.hpp"
#include "specimens/parts/resolved_case.hpp"

namespace crackle {

/// A value for one key that overrides the case files. Campaigns set the values on their axes in this way.
struct CaseSetting {
    std::string key;  ///< "material.cohesion", or "mineral[2].cohesion" for a table that may occur several times
    CaseValue value;
    std::string where;  ///< "file:line" for error messages; relative paths start from that file's folder
};

/// A case given as text instead of a file, either as TOML or as the same tables in JSON. Relative paths in it start
/// from the current folder.
struct CaseText {
    std::string name = "case";  ///< used in error messages, and as the title if the text gives no title
    std::string text;
    bool json = false;  ///< whether the text is JSON; its keys then have no line numbers
};

/// Factors on the loading rate and on the time step, for companion runs: the same test at another rate or time step.
struct RunScale {
    double rate = 1.0, step = 1.0;
};

/// Values from a case file and its includes, before settings and defaults are applied. They are read once and used for
/// many tests.
class CaseFiles {
  public:
    /// @throws InputError under the same conditions as read_case(), except for errors that can be detected only in a
    /// complete case
    explicit CaseFiles(const std::filesystem::path& path);
    /// Reads the values from a text instead of a file.
    explicit CaseFiles(const CaseText& text);

    /// Returns the test with settings that override the files. If a key is set several times, the last setting applies.
    /// @throws InputError
    ResolvedCase with(std::span<const CaseSetting> settings, const RunScale& scale = {}) const;

    /// Returns only the joints; the file may be an incomplete case. Only [joints], [[joint_set]] and [[trace]] get
    /// defaults and are checked. Other values stay as written in the files. @throws InputError
    JointCase joints() const;

  private:
    std::shared_ptr<const TestCase> written_;
};

/// Reads and checks a case. @throws InputError «file:line: key: found X, expected Y; what to do».
ResolvedCase read_case(const std::filesystem::path& path);
/// Reads and checks a case that is given as text instead of a file.
ResolvedCase read_case(const CaseText& text);
/// The joints of a case. @throws InputError if the case was not read from a file or text
JointCase joints_of(const ResolvedCase& test);

/// Values of keys that are known only after the specimen has been made.
struct MadeValues {
    std::optional<double> mesh_thick;  // m
    std::optional<std::int64_t> frames;
};

/// Writes the case with all values, each with its unit and description. Reading the output gives the same test.
/// @param folder  the folder where the text will be stored; paths are written relative to this folder
/// @throws InputError if the case was not read from a file or text
void write_resolved_case(std::ostream& out, const ResolvedCase& test, const std::filesystem::path& folder,
                         const MadeValues& made = {});

/// One key of a case with its value, which is either set by a file or a default.
struct ResolvedKey {
    std::string label;  ///< "material.cohesion", "mineral[2].cohesion"
    const Parameter* parameter;
    CaseValue value;
    std::filesystem::path file;  ///< the file that the key names; empty for other keys
};
/// All keys that have a value, in the order in which a case is written. Tests with equal lists are equal, except for
/// the contents of the files they name.
std::vector<ResolvedKey> resolved_keys(const ResolvedCase& test);

/// Prints a table of all keys with unit, default, range and description.
void describe_case_keys(std::ostream& out);

}  // namespace crackle
