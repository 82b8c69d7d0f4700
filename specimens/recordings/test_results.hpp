// SPDX-License-Identifier: GPL-3.0-or-later
// The results of one finished test, read from its folder: summary, curve and breaks, and slips and acoustic events if
// they were recorded.
// Tested by tests/tools/commands/view_test.cpp, slips by tests/tools/page/page_data_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/summary/summary.hpp"

namespace crackle {

/// Second line of every report page. A file without this line was not written by this program.
inline constexpr std::string_view report_mark = "<!-- crackle report -->";
/// Whether a file is a report page of this program.
bool is_report_page(const std::filesystem::path& file);

/// A table of numbers with named columns.
struct NumberTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;

    /// Values of a column. @return nullptr if there is no such column
    const std::vector<double>* find(std::string_view name) const;
    /// Number of rows.
    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

/// The results of a test, read from its files.
struct TestResults {
    std::string name;                  ///< name of the folder
    Summary summary;                   ///< contents of summary.json
    NumberTable curve;                 ///< columns of curve.csv
    NumberTable events;                ///< columns of events.csv; `mode` is 1 for shear, 0 for tension
    std::optional<NumberTable> slips;  ///< columns of slips.csv; empty if the test did not record slips
    /// Columns of ae.csv; `type` is 0 to 3 for opening, shear, closing and none. Empty if the test did not record
    /// acoustic emission.
    std::optional<NumberTable> emission;
};

/// Reads comma-separated numbers below a header line, which is line `names_line` of the file. Words in the column
/// `word_column`, if given, are replaced with their index in `words`.
/// @param file  name of the file for messages
/// @throws InputError that names file, line and column
NumberTable number_table(const std::filesystem::path& file, std::string_view text, std::string_view word_column = {},
                         const std::vector<std::string>& words = {}, int names_line = 1);

/// Reads broken bonds from events.csv of a test or of a deck's run. @param needed  names of required columns
/// @param text  text that starts with the header, which is line `names_line` of the file
/// @param again  advice on how to write the file again, for messages
NumberTable break_table(const std::filesystem::path& file, std::string_view text,
                        const std::vector<const char*>& needed, const char* again, int names_line = 1);

/// Reads the results of a test. @param folder  results of `crackle test -o`
/// @throws InputError if a file is missing, invalid or changed since the test wrote it (stated_files.hpp)
TestResults read_results(const std::filesystem::path& folder);

}  // namespace crackle
