// SPDX-License-Identifier: GPL-3.0-or-later
// SHA-256 hashes of a ledger's tests and plan, which reveal any later change. A hash covers the cells together with
// their column names. Empty cells are left out, so adding a column does not change any hash.
// Tested by tests/specimens/campaign/ledger_test.cpp.
#pragma once

#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace crackle {

/// A row of table `test`, compared with its recorded hash.
struct CheckedRow {
    std::string identity, state;
    bool whole = true;  ///< whether the row is as recorded; true for rows of earlier versions, which have no hash
};

/// Whether the ledger has hashes; ledgers of earlier versions do not.
bool has_hashes(const SQLite::Database& database);

/// Hash of a test: of its row in `test`, without the hash itself, and of its row in `figures`.
std::string hash_of_test(const SQLite::Database& database, const std::string& identity);

/// All rows of table `test`, each compared with its hash.
std::vector<CheckedRow> checked_rows(const SQLite::Database& database);

/// Text for a test: "row 5 (tension, material.friction_angle = 20, seed 3)"; its identity if the plan does not include
/// it.
std::string called(const SQLite::Database& database, const std::string& identity);

/// Hash of the present plan: of the tables `point`, `plan` and `meta`, without the hash itself.
std::string hash_of_plan(const SQLite::Database& database);

/// Key of the plan's hash in `meta`.
inline constexpr const char* plan_hash_key = "plan_sha256";

}  // namespace crackle
