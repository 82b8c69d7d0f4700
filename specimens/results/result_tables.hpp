// SPDX-License-Identifier: GPL-3.0-or-later
// The tables that a test writes row by row. Each is declared once, with the condition for writing it, its columns, and
// its text in FILES.md. To add a table, add a value to ResultTable and a row to result_tables.cpp.
// Tested by tests/specimens/results/files_test.cpp.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "solver/base/names.hpp"
#include "solver/base/quantity.hpp"
#include "solver/files/file_mark.hpp"
#include "specimens/parts/resolved_case.hpp"
#include "specimens/recordings/stated_files.hpp"

namespace crackle {

/// A table. Checkpoints store the lengths and hashes of the tables in this order.
enum class ResultTable : std::uint8_t { curve, events, slips, ae };
constexpr auto list_names(ResultTable) { return in_order("curve.csv", "events.csv", "slips.csv", "ae.csv"); }
inline constexpr std::size_t result_tables = table_of_names<ResultTable>.size();

/// Lengths and hashes of all tables; the length is 0 for a table that is not written.
using TableMarks = std::array<FileMark, result_tables>;

/// Options for the files of a test.
struct FileOptions {
    parts::Output output = {};
    bool emission = false;  ///< whether acoustic events are recorded
    /// Whether curve.csv has the column for tests with a membrane, walls or a normal force, and events.csv the column
    /// for jointed specimens.
    bool pressed = false, jointed = false;
    std::size_t large_frame = 200'000;  ///< number of bodies from which the frame at the peak is kept on disk
};

/// Properties of a table.
struct ResultTableFacts {
    const char* holds;    ///< contents of the table, for lists of files
    const char* section;  ///< text about the table in FILES.md, above its columns
    bool (*wanted)(const FileOptions&);
    std::string (*header)(const FileOptions&);  ///< first line, including the line end
    std::vector<Quantity> (*columns)();
};
/// Properties of one table.
const ResultTableFacts& facts_of(ResultTable table);

/// The tables that a test writes.
std::vector<ResultTable> tables_of(const FileOptions& options);
/// Names of the given tables, with their lengths and hashes.
FileMarks named_marks(const std::vector<ResultTable>& tables, const TableMarks& marks);

}  // namespace crackle
