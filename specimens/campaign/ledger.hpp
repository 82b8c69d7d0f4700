// SPDX-License-Identifier: GPL-3.0-or-later
// The ledger of a campaign: one SQLite file with the planned tests, those that have been run, and their results. One
// process writes it; any number of processes may read it at the same time, with `crackle campaign show`, sqlite3 or
// pandas.
//
//   meta      key, value: the plan's text, title, versions; `rocks`: keys_of_rock() of each test's first point, without
//             the axes that apply to it, as JSON
//   point     number, test, and a column for each axis of the plan, named by its key
//   plan      row, point, seed, variant, identity: the rows of the present plan
//   test      identity, state, tries, host, processor_seconds, wall_seconds, exit, message, notices: all tests, of this
//             plan or an earlier one, that have ended. curve_sha256, summary_sha256: hashes of the kept files;
//             sha256: hash of the row, see ledger_hashes.hpp. Earlier versions leave these three empty
//   figures   identity, and a column for each figure of summary.json, with its name there
//   results   (view) the tables above joined, one row per row of the plan
//   long      (view) row, test, variant, figure, value: the first 480 figures that are numbers
//
// Tested by tests/specimens/campaign/ledger_test.cpp and campaign_test.cpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "specimens/campaign/plan.hpp"
#include "specimens/campaign/row.hpp"

namespace SQLite {
class Database;
}

namespace crackle {

/// A cell of a ledger: empty, a number, or a text.
using LedgerCell = std::variant<std::monostate, double, std::string>;

/// Rows returned by a query, with the names of the columns.
struct LedgerTable {
    std::vector<std::string> columns;
    std::vector<std::vector<LedgerCell>> rows;
};

/// Numbers of rows and tests in the present plan.
struct LedgerCounts {
    std::int64_t rows = 0;   ///< planned rows
    std::int64_t tests = 0;  ///< number of different tests in these rows
    std::int64_t done = 0, gone_wrong = 0;
    std::int64_t failures = 0;       ///< number of tests in gone_wrong with a system failure (RowKind::failure)
    double processor_seconds = 0.0;  ///< processor time of the tests that have ended, s
};

/// Location of SQLite's journal until a transaction is complete.
enum class Journal : std::uint8_t {
    beside,  ///< a second file, which readers also read, so that they see each change at once; on local discs only
    /// For network file systems: readers wait during a change; a power failure may damage the ledger, which must then
    /// be created again.
    within,
};

/// SHA-256 of the files kept of a test; empty for a file that was not kept.
struct KeptHashes {
    std::string curve, summary;
};

/// The file in which a campaign records its plan and the results of its tests.
class CampaignLedger {
  public:
    /// Opens a ledger for writing; creates it if needed. @throws InputError if the file is not a ledger; OutputError
    static CampaignLedger open(const std::filesystem::path& file, Journal journal = Journal::beside);
    /// Opens a ledger for reading. @throws InputError if there is no ledger
    static CampaignLedger read(const std::filesystem::path& file);
    /// The other ledger must not be used any more.
    CampaignLedger(CampaignLedger&& other) noexcept;
    CampaignLedger& operator=(CampaignLedger&&) = delete;
    ~CampaignLedger();

    /// Replaces the present plan in a single transaction; results of tests are kept.
    /// @param identities  identity of the test in each of plan.rows
    void set_plan(const Plan& plan, const std::vector<std::string>& identities);
    /// Records the result of a test. If the test was recorded before, its row is updated and its number of tries
    /// incremented.
    void record(const RowResult& result, const std::string& host);
    /// Adds tests of another ledger that are missing here, not done here, or done here without kept files. Both
    /// ledgers must have been checked before.
    /// @param its_plan  whether to copy the other ledger's plan as well @return number of tests added
    std::int64_t gather(const std::filesystem::path& other, bool its_plan);

    /// Removes rows that have changed since they were recorded, so that their tests run again.
    /// @return descriptions of these rows
    std::vector<std::string> drop_damaged();
    /// Removes all tests that ended without results. @return number of rows removed
    std::int64_t drop_gone_wrong();

    /// States of the tests that have ended, by identity. Damaged rows are left out.
    std::map<std::string, std::string> ended() const;
    /// Hashes of kept files, by identity. Tests recorded by earlier versions are left out.
    std::map<std::string, KeptHashes> kept_hashes() const;
    /// Number of rows and tests of the plan, by state.
    LedgerCounts counts() const;
    std::string meta(const std::string& key) const;  ///< value of a key in `meta`; empty if there is no such key

    /// @throws InputError if the plan has changed since it was recorded
    void require_whole_plan() const;
    /// @throws InputError if the plan or a test has changed since it was recorded; the message names the first one
    void require_whole() const;
    /// Results of the present plan, one row for each row of the plan. The columns are row, test, one for each axis,
    /// seed, variant, identity, state, processor_seconds, and one for each figure, with its name in summary.json.
    /// @throws InputError under the same conditions as require_whole(), and if a row lacks its test, seed, variant or
    /// identity
    LedgerTable results() const;
    /// Result of an SQL query on any table or view. Hashes are not checked.
    LedgerTable query(const std::string& sql) const;

  private:
    CampaignLedger(std::filesystem::path file, std::unique_ptr<SQLite::Database> database);

    template <class Work>
    auto guarded(const Work& work) const;
    void make_tables(Journal journal);
    void make_views();
    std::vector<std::string> columns_of(const char* table) const;
    std::vector<std::pair<std::string, std::string>> shown_figures() const;
    std::string results_query() const;
    void add_columns(const Figures& figures);
    void put_figures(const std::string& identity, const Figures& all);
    void note(const std::string& key, const std::string& value);

    std::filesystem::path file_;
    std::unique_ptr<SQLite::Database> database_;
    std::set<std::string> figure_columns_;
};

}  // namespace crackle
