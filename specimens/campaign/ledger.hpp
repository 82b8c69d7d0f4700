// SPDX-License-Identifier: GPL-3.0-or-later
// The ledger of a campaign: one SQLite file that says what was planned, what has been run, and what came of it. Written
// by one process; any number may read it meanwhile, by `crackle campaign show`, sqlite3, pandas.
//
//   meta     key, value: the plan's text, title, versions; rocks: what each of its tests is made of (keys_of_rock() of
//   its
//            first point, without the axes that are for it), as JSON
//   point    number, test, and a column for each axis of the plan, named by its key
//   plan     row, point, seed, variant, identity: what the present plan asks for
//   test     identity, state, tries, host, processor_seconds, wall_seconds, exit, message, notices: all that were run,
//            of this plan or an earlier one; a test that has no row has not ended
//   figures  identity, and a column for each figure of summary.json, named as there
//   results  (view) all of these beside each other, a row of the plan each
//   long     (view) row, test, variant, figure, value: of figures that are numbers, the first 480
//
// Tested by tests/specimens/campaign/campaign_test.cpp.
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

/// A value of a ledger: nothing, a number, or a word.
using LedgerCell = std::variant<std::monostate, double, std::string>;

struct LedgerTable {
    std::vector<std::string> columns;
    std::vector<std::vector<LedgerCell>> rows;
};

/// Of the rows of the present plan.
struct LedgerCounts {
    std::int64_t rows = 0;   ///< planned
    std::int64_t tests = 0;  ///< different ones among these
    std::int64_t done = 0, gone_wrong = 0;
    double processor_seconds = 0.0;  ///< of those that have ended
};

/// Where a change is noted until it is done.
enum class Journal : std::uint8_t {
    beside,  ///< a file that readers look at, too: they see each change at once; on a disc of this machine only
    within,  ///< for network file systems: who reads meanwhile waits; after a loss of power it may have to be made
             ///< again
};

class CampaignLedger {
  public:
    /// To be written, made where there is none. @throws InputError if it is none of ours, OutputError
    static CampaignLedger open(const std::filesystem::path& file, Journal journal = Journal::beside);
    /// To be read. @throws InputError if there is none
    static CampaignLedger read(const std::filesystem::path& file);
    CampaignLedger(CampaignLedger&& other) noexcept;
    CampaignLedger& operator=(CampaignLedger&&) = delete;
    ~CampaignLedger();

    /// Puts a plan in the place of the present one, at once or not at all; what was run stays.
    /// @param identities of plan.rows
    void set_plan(const Plan& plan, const std::vector<std::string>& identities);
    /// Adds what a test gave; one that is there already gets another try.
    void record(const RowResult& result, const std::string& host);
    /// Adds all tests of another ledger that this one has not, or has not as done, and takes over its plan where asked.
    /// @return how many
    std::int64_t gather(const std::filesystem::path& other, bool its_plan);

    /// Identities of tests that have ended, by state.
    std::map<std::string, std::string> ended() const;
    LedgerCounts counts() const;
    std::string meta(const std::string& key) const;  ///< empty where there is none

    /// Of the present plan, a row each in its order: row, test, axes, seed, variant, state, figures by name.
    LedgerTable results() const;
    /// Any table or view by a query.
    LedgerTable query(const std::string& sql) const;

  private:
    CampaignLedger(std::filesystem::path file, std::unique_ptr<SQLite::Database> database);

    template <class Work>
    auto guarded(const Work& work) const;
    void make_tables(Journal journal);
    void make_views();
    void add_columns(const Figures& figures);
    void put_figures(const std::string& identity, const Figures& all);

    std::filesystem::path file_;
    std::unique_ptr<SQLite::Database> database_;
    std::set<std::string> figure_columns_;
};

}  // namespace crackle
