// SPDX-License-Identifier: GPL-3.0-or-later
// The results of one finished test, read back from its folder: summary, curve, breaks, and slips and
// acoustic events where there are any.
// Tested by tests/tools/commands/view_test.cpp, slips by tests/tools/page/page_data_test.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/recordings/test_summary.hpp"

namespace crackle {

/// Second line of every report page; a file without it was not written by this program.
inline constexpr std::string_view report_mark = "<!-- crackle report -->";
bool is_report_page(const std::filesystem::path& file);

/// A table of numbers with named columns.
struct NumberTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;

    /// @return nullptr where there is no such column
    const std::vector<double>* find(std::string_view name) const;
    std::size_t rows() const { return columns.empty() ? 0 : columns.front().size(); }
};

struct TestResults {
    std::string name;                  ///< the folder's
    TestSummary summary;               ///< as written
    NumberTable curve;                 ///< columns of curve.csv
    NumberTable events;                ///< columns of events.csv; `mode` as 1 for shear, 0 for tension
    std::optional<NumberTable> slips;  ///< columns of slips.csv; none where the test did not record slips
    /// Columns of ae.csv, `type` as 0 to 3 for opening, shear, closing, none; none where the test did not listen.
    std::optional<NumberTable> emission;
};

/// Comma-separated numbers under a line of names, which is `names_line` of the file. The words of column `word_column`,
/// if given, are read as their place in `words`. @param file for messages @throws InputError naming file, line and
/// column
NumberTable number_table(const std::filesystem::path& file, std::string_view text, std::string_view word_column = {},
                         const std::vector<std::string>& words = {}, int names_line = 1);

/// Broken bonds: events.csv of a test or of a deck's run, with `needed` columns.
/// @param text  beginning with the names, which are `names_line` of the file @param again  words that write it again
NumberTable break_table(const std::filesystem::path& file, std::string_view text,
                        const std::vector<const char*>& needed, const char* again, int names_line = 1);

/// @param folder  what `crackle test -o` made
/// @throws InputError naming the file that is missing, wrong or not what the test wrote (stated_files.hpp), and how to
/// make it
TestResults read_results(const std::filesystem::path& folder);

}  // namespace crackle
