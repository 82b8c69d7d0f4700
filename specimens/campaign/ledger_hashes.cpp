// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/ledger_hashes.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>

#include "specimens/campaign/plan.hpp"
#include "specimens/results/sha256.hpp"

namespace crackle {
namespace {

/// Cells of a query's rows, sorted by column name rather than in the order of the tables.
class NamedCells {
  public:
    /// @param first  first column to include
    /// @param second_table  first column of the second table, whose names may repeat those of the first table
    NamedCells(const SQLite::Statement& statement, int first, int second_table) {
        for (int k = first; k < statement.getColumnCount(); ++k)
            columns_.emplace_back(fmt::format("{}{}", k < second_table ? "" : "figures.", statement.getColumnName(k)),
                                  k);
        std::erase_if(columns_, [](const auto& column) { return column.first == "sha256"; });
        std::sort(columns_.begin(), columns_.end());
    }

    /// Text of a row. The length of each cell precedes it, so that no two different rows have the same text.
    std::string text_of_row(SQLite::Statement& statement) const {
        std::string text;
        const auto add = [&](char kind, std::string_view bytes) {
            fmt::format_to(std::back_inserter(text), "{}{} {}", kind, bytes.size(), bytes);
        };
        for (const auto& [name, k] : columns_) {
            const SQLite::Column cell = statement.getColumn(k);
            if (cell.isNull()) continue;
            add('=', name);
            if (cell.isText() || cell.isBlob())
                add('t', cell.getString());
            else
                add('n', fmt::format("{:x}", std::bit_cast<std::uint64_t>(cell.getDouble())));
        }
        return text;
    }

  private:
    std::vector<std::pair<std::string, int>> columns_;  // names and column indices
};

int columns_of(const SQLite::Database& database, const char* table) {
    SQLite::Statement count(database, "SELECT count(*) FROM pragma_table_info(?)");
    count.bind(1, table);
    count.executeStep();
    return count.getColumn(0).getInt();
}

constexpr const char* tests_with_figures =
    "SELECT test.identity, test.state, test.sha256, test.*, figures.* FROM test LEFT JOIN figures ON figures.identity "
    "= test.identity";
constexpr int before_cells = 3;  // identity, state and hash precede the cells

NamedCells cells_of_tests(const SQLite::Database& database, const SQLite::Statement& statement) {
    return {statement, before_cells, before_cells + columns_of(database, "test")};
}

}  // namespace

bool has_hashes(const SQLite::Database& database) {
    SQLite::Statement column(database, "SELECT 1 FROM pragma_table_info('test') WHERE name = 'sha256'");
    return column.executeStep();
}

std::string hash_of_test(const SQLite::Database& database, const std::string& identity) {
    SQLite::Statement row(database, fmt::format("{} WHERE test.identity = ?", tests_with_figures));
    row.bind(1, identity);
    return row.executeStep() ? sha256(cells_of_tests(database, row).text_of_row(row)) : std::string();
}

std::vector<CheckedRow> checked_rows(const SQLite::Database& database) {
    std::vector<CheckedRow> all;
    if (!has_hashes(database)) {
        SQLite::Statement row(database, "SELECT identity, state FROM test");
        while (row.executeStep()) all.push_back({row.getColumn(0).getString(), row.getColumn(1).getString()});
        return all;
    }
    SQLite::Statement row(database, tests_with_figures);
    const NamedCells cells = cells_of_tests(database, row);
    while (row.executeStep()) {
        const SQLite::Column hash = row.getColumn(2);
        all.push_back({row.getColumn(0).getString(), row.getColumn(1).getString(),
                       hash.isNull() || hash.getString() == sha256(cells.text_of_row(row))});
    }
    return all;
}

std::string hash_of_plan(const SQLite::Database& database) {
    Sha256 hash;
    for (const char* rows : {"SELECT * FROM point ORDER BY number", "SELECT * FROM plan ORDER BY row",
                             "SELECT * FROM meta WHERE key <> 'plan_sha256' ORDER BY key"}) {
        SQLite::Statement row(database, rows);
        const NamedCells cells(row, 0, row.getColumnCount());
        while (row.executeStep()) hash.add(cells.text_of_row(row) + '\n');
    }
    return hash.digits();
}

std::string called(const SQLite::Database& database, const std::string& identity) {
    SQLite::Statement row(database,
                          "SELECT plan.row, plan.variant, plan.seed, point.* FROM plan JOIN point ON point.number = "
                          "plan.point WHERE plan.identity = ? ORDER BY plan.row");
    row.bind(1, identity);
    if (!row.executeStep()) return fmt::format("the test {}", identity);
    constexpr int axes_begin = 5;  // the columns before the axes are row, variant, seed, number and test
    std::string at = row.getColumn(axes_begin - 1).getString();
    for (int k = axes_begin; k < row.getColumnCount(); ++k)
        if (!row.getColumn(k).isNull())
            at += fmt::format(", {} = {}", row.getColumnName(k), row.getColumn(k).getString());
    const std::string variant = row.getColumn(1).getString();
    return fmt::format("row {} ({}, seed {}{})", row.getColumn(0).getInt64(), at, row.getColumn(2).getInt64(),
                       variant == name_of(Variant::as_asked) ? "" : ", " + variant);
}

}  // namespace crackle
