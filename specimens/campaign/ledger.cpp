// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/version.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/identity.hpp"
#include "specimens/campaign/ledger_failure.hpp"
#include "specimens/campaign/ledger_hashes.hpp"

namespace crackle {
namespace {

constexpr int application_id = 0x43524b4c;  // "CRKL"; marks an SQLite file as a ledger
constexpr int layout_version = 2;
constexpr int layout_without_hashes = 1;           // older layout; readable, and converted when opened for writing
constexpr std::size_t most_columns_of_long = 480;  // SQLite allows 500 terms in a compound query
constexpr const char* plan_table =
    "CREATE TABLE plan(row INTEGER PRIMARY KEY, point INTEGER NOT NULL REFERENCES point(number), seed INTEGER NOT "
    "NULL, variant TEXT NOT NULL, identity TEXT NOT NULL) STRICT";

/// Encloses a text in quotation marks for SQL; marks inside it are doubled.
std::string between(char mark, const std::string& text) {
    std::string result(1, mark);
    for (const char letter : text) {
        result += letter;
        if (letter == mark) result += letter;
    }
    return result += mark;
}
std::string quoted(const std::string& name) { return between('"', name); }
std::string literal(const std::string& text) { return between('\'', text); }

void bind_value(SQLite::Statement& statement, int place, const CaseValue& value) {
    std::visit(
        [&]<class T>(const T& own) {
            if constexpr (std::is_arithmetic_v<T>)
                statement.bind(place, own);
            else
                statement.bind(place, value_text(value));
        },
        value);
}

LedgerCell cell_of(const SQLite::Column& column) {
    if (column.isNull()) return {};
    if (column.isText() || column.isBlob()) return column.getString();
    return column.getDouble();
}

void run(SQLite::Statement& statement) {
    statement.exec();
    statement.reset();
}

}  // namespace

/// Calls work(). SQLite exceptions are translated into errors with the file name and a description.
template <class Work>
auto CampaignLedger::guarded(const Work& work) const {
    errno = 0;
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        const int last = errno, kept = database_ ? ::sqlite3_system_errno(database_->getHandle()) : 0;
        refuse_ledger(error, kept, last, file_.string());
    }
}

CampaignLedger::CampaignLedger(std::filesystem::path file, std::unique_ptr<SQLite::Database> database)
    : file_(std::move(file)), database_(std::move(database)) {}
CampaignLedger::CampaignLedger(CampaignLedger&& other) noexcept = default;
CampaignLedger::~CampaignLedger() = default;

CampaignLedger CampaignLedger::open(const std::filesystem::path& file, Journal journal) {
    CampaignLedger ledger(file, nullptr);
    ledger.guarded([&] {
        ledger.database_ = std::make_unique<SQLite::Database>(
            file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, busy_milliseconds);
        ledger.make_tables(journal);
    });
    return ledger;
}

CampaignLedger CampaignLedger::read(const std::filesystem::path& file) {
    if (!is_file(file)) {
        throw InputError(fmt::format("{}: found no ledger, expected one that `crackle campaign` made; check the folder",
                                     file.string()));
    }
    CampaignLedger ledger(file, nullptr);
    ledger.guarded([&] {
        ledger.database_ = std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READONLY, busy_milliseconds);
        if (ledger.database_->execAndGet("PRAGMA application_id").getInt() != application_id)
            throw InputError(fmt::format(
                "{}: found a file that is not a ledger, expected one that `crackle campaign` made", file.string()));
    });
    return ledger;
}

void CampaignLedger::make_tables(Journal journal) {
    SQLite::Database& db = *database_;
    const int id = db.execAndGet("PRAGMA application_id").getInt();
    const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
    if (!empty && id != application_id)
        throw InputError(
            fmt::format("{}: found a file that is not a ledger, expected one that `crackle campaign` made; "
                        "choose another folder with -o",
                        file_.string()));
    const int version = db.execAndGet("PRAGMA user_version").getInt();
    if (!empty && version != layout_version && version != layout_without_hashes)
        throw InputError(
            fmt::format("{}: found a ledger of layout {}, expected {}; another version of crackle made it, "
                        "so choose another folder with -o",
                        file_.string(), version, layout_version));
    // Only one process writes. In both journal modes, a killed process loses no finished transaction.
    db.exec(journal == Journal::beside ? "PRAGMA journal_mode = WAL" : "PRAGMA journal_mode = TRUNCATE");
    db.exec(journal == Journal::beside ? "PRAGMA synchronous = NORMAL" : "PRAGMA synchronous = OFF");
    db.exec("PRAGMA foreign_keys = ON");
    if (empty) {
        SQLite::Transaction change(db);
        db.exec(fmt::format("PRAGMA application_id = {}", application_id));
        db.exec(fmt::format("PRAGMA user_version = {}", layout_version));
        db.exec("CREATE TABLE meta(key TEXT PRIMARY KEY, value ANY) STRICT, WITHOUT ROWID");
        db.exec(fmt::format("CREATE TABLE test({}, {}, {}) STRICT",
                            "identity TEXT PRIMARY KEY, state TEXT NOT NULL, tries INTEGER NOT NULL, host TEXT",
                            "processor_seconds REAL, wall_seconds REAL, exit INTEGER, message TEXT, notices TEXT",
                            "curve_sha256 TEXT, summary_sha256 TEXT, sha256 TEXT"));
        db.exec("CREATE TABLE figures(identity TEXT PRIMARY KEY REFERENCES test(identity)) STRICT");
        db.exec("CREATE TABLE point(number INTEGER PRIMARY KEY, test TEXT NOT NULL) STRICT");
        db.exec(plan_table);
        make_views();
        change.commit();
    } else if (version == layout_without_hashes) {
        SQLite::Transaction change(db);
        for (const char* column : {"curve_sha256", "summary_sha256", "sha256"})
            db.exec(fmt::format("ALTER TABLE test ADD COLUMN {} TEXT", column));
        db.exec(fmt::format("PRAGMA user_version = {}", layout_version));
        change.commit();
    }
    for (const std::string& name : columns_of("figures")) figure_columns_.insert(name);
}

std::vector<std::string> CampaignLedger::columns_of(const char* table) const {
    SQLite::Statement column(*database_, "SELECT name FROM pragma_table_info(?)");
    column.bind(1, table);
    std::vector<std::string> names;
    while (column.executeStep()) names.push_back(column.getColumn(0).getString());
    return names;
}

/// Names of figures, and the names shown for them: " (reached)" is appended to the name of a figure that is also an
/// axis.
std::vector<std::pair<std::string, std::string>> CampaignLedger::shown_figures() const {
    const std::vector<std::string> axes = columns_of("point");
    std::vector<std::pair<std::string, std::string>> shown;
    for (const std::string& name : columns_of("figures")) {
        if (name == "identity") continue;
        shown.emplace_back(name, std::find(axes.begin(), axes.end(), name) != axes.end() ? name + " (reached)" : name);
    }
    return shown;
}

std::string CampaignLedger::results_query() const {
    std::string axes, figures;
    for (const std::string& name : columns_of("point"))
        if (name != "number") axes += fmt::format("point.{}, ", quoted(name));
    for (const auto& [name, shown] : shown_figures())
        figures += fmt::format(", figures.{} AS {}", quoted(name), quoted(shown));
    return fmt::format(
        "SELECT plan.row AS row, {}plan.seed AS seed, plan.variant AS variant, plan.identity AS identity, test.state "
        "AS state, test.processor_seconds AS processor_seconds{} FROM plan JOIN point ON point.number = plan.point "
        "LEFT JOIN test USING(identity) LEFT JOIN figures USING(identity) ORDER BY plan.row",
        axes, figures);
}

void CampaignLedger::make_views() {
    SQLite::Database& db = *database_;
    db.exec("DROP VIEW IF EXISTS results");
    db.exec("DROP VIEW IF EXISTS long");
    std::vector<std::string> parts;
    for (const auto& [name, shown] : shown_figures()) {
        if (parts.size() == most_columns_of_long) break;
        parts.push_back(
            fmt::format("SELECT plan.row AS row, point.test AS test, plan.variant AS variant, {} AS figure, "
                        "figures.{} AS value FROM plan JOIN point ON point.number = plan.point JOIN figures "
                        "USING(identity) WHERE typeof(figures.{}) IN ('real', 'integer')",
                        literal(shown), quoted(name), quoted(name)));
    }
    db.exec("CREATE VIEW results AS " + results_query());
    db.exec("CREATE VIEW long AS " +
            (parts.empty()
                 ? std::string("SELECT 0 AS row, '' AS test, '' AS variant, '' AS figure, 0.0 AS value WHERE 0")
                 : fmt::format("{}", fmt::join(parts, " UNION ALL "))));
}

void CampaignLedger::set_plan(const Plan& plan, const std::vector<std::string>& identities) {
    guarded([&] {
        SQLite::Database& db = *database_;
        SQLite::Transaction change(db);
        for (const char* view : {"results", "long"}) db.exec(fmt::format("DROP VIEW IF EXISTS {}", view));
        db.exec("DROP TABLE plan");
        db.exec("DROP TABLE point");
        std::string columns, places;
        for (const Axis& axis : plan.axes) {
            columns += ", " + quoted(axis.key) + " ANY";
            places += ", ?";
        }
        db.exec(fmt::format("CREATE TABLE point(number INTEGER PRIMARY KEY, test TEXT NOT NULL{}) STRICT", columns));
        db.exec(plan_table);
        SQLite::Statement add_point(db, fmt::format("INSERT INTO point VALUES(?, ?{})", places));
        for (std::size_t k = 0; k < plan.points.size(); ++k) {
            const PlanPoint& point = plan.points[k];
            add_point.clearBindings();
            add_point.bind(1, static_cast<std::int64_t>(k));
            add_point.bind(2, plan.tests[point.test].name);
            for (std::size_t a = 0; a < point.axes.size(); ++a)
                bind_value(add_point, static_cast<int>(point.axes[a]) + 3, point.settings[a].value);
            run(add_point);
        }
        SQLite::Statement add_row(db, "INSERT INTO plan VALUES(?, ?, ?, ?, ?)");
        for (std::size_t k = 0; k < plan.rows.size(); ++k) {
            const PlanRow& row = plan.rows[k];
            add_row.bind(1, static_cast<std::int64_t>(k));
            add_row.bind(2, static_cast<std::int64_t>(row.point));
            add_row.bind(3, row.seed);
            add_row.bind(4, name_of(row.variant));
            add_row.bind(5, identities[k]);
            run(add_row);
        }
        db.exec("CREATE INDEX plan_identity ON plan(identity)");
        note("title", plan.title);
        note("plan", plan.text);
        note("plan_file", plan.file.filename().string());
        note("results_version", fmt::format("{}", results_version));
        note("rows", rows_mark(plan, identities));
        note("rocks", rocks_text(plan));
        note(plan_hash_key, hash_of_plan(db));
        make_views();
        change.commit();
    });
}

void CampaignLedger::note(const std::string& key, const std::string& value) {
    SQLite::Statement meta(*database_, "INSERT OR REPLACE INTO meta VALUES(?, ?)");
    meta.bind(1, key);
    meta.bind(2, value);
    run(meta);
}

void CampaignLedger::add_columns(const Figures& figures) {
    bool added = false;
    for (const auto& [name, value] : figures) {
        if (!figure_columns_.insert(name).second) continue;
        database_->exec(fmt::format("ALTER TABLE figures ADD COLUMN {} ANY", quoted(name)));
        added = true;
    }
    if (added) make_views();
}

void CampaignLedger::record(const RowResult& result, const std::string& host) {
    guarded([&] {
        SQLite::Database& db = *database_;
        SQLite::Transaction change(db);
        std::string updates = "tries = tries + 1";
        for (const char* column : {"state", "host", "processor_seconds", "wall_seconds", "exit", "message", "notices"})
            updates += fmt::format(", {0} = excluded.{0}", column);
        for (const char* column : {"curve_sha256", "summary_sha256"})
            updates += fmt::format(", {0} = coalesce(excluded.{0}, {0})", column);
        SQLite::Statement test(db, fmt::format("INSERT INTO test VALUES(?, ?, 1, ?, ?, ?, ?, ?, ?, ?, ?, NULL) ON "
                                               "CONFLICT(identity) DO UPDATE SET {}",
                                               updates));
        test.bind(1, result.identity);
        test.bind(2, result.state);
        test.bind(3, host);
        test.bind(4, result.processor_seconds);
        test.bind(5, result.wall_seconds);
        test.bind(6, result.exit);
        if (!result.message.empty()) test.bind(7, result.message);
        if (!result.notices.empty()) test.bind(8, fmt::format("{}", fmt::join(result.notices, "\n")));
        if (!result.curve_sha256.empty()) test.bind(9, result.curve_sha256);
        if (!result.summary_sha256.empty()) test.bind(10, result.summary_sha256);
        run(test);
        put_figures(result.identity, result.figures);
        SQLite::Statement hash(db, "UPDATE test SET sha256 = ? WHERE identity = ?");
        hash.bind(1, hash_of_test(db, result.identity));
        hash.bind(2, result.identity);
        run(hash);
        change.commit();
    });
}

void CampaignLedger::put_figures(const std::string& identity, const Figures& all) {
    SQLite::Statement earlier(*database_, "DELETE FROM figures WHERE identity = ?");  // figures of an earlier run
    earlier.bind(1, identity);
    run(earlier);
    if (all.empty()) return;
    add_columns(all);
    std::string names = "identity", places = "?";
    for (const auto& [name, value] : all) {
        names += ", " + quoted(name);
        places += ", ?";
    }
    SQLite::Statement figures(*database_, fmt::format("INSERT INTO figures({}) VALUES({})", names, places));
    int place = 1;
    figures.bind(place, identity);
    for (const auto& [name, value] : all) {
        ++place;
        std::visit([&](const auto& known) { figures.bind(place, known); }, value);
    }
    run(figures);
}

std::int64_t CampaignLedger::gather(const std::filesystem::path& other, bool its_plan) {
    return guarded([&] {
        SQLite::Database& db = *database_;
        db.exec("ATTACH DATABASE " + literal(other.string()) + " AS other");
        SQLite::Transaction change(db);
        for (const char* view : {"results", "long"}) db.exec(fmt::format("DROP VIEW IF EXISTS {}", view));
        if (its_plan) {
            for (const char* table : {"plan", "point"}) db.exec(fmt::format("DROP TABLE main.{}", table));
            for (const char* table : {"point", "plan"}) {
                db.exec(db.execAndGet(fmt::format("SELECT sql FROM other.sqlite_schema WHERE name = '{}'", table))
                            .getString());
                db.exec(fmt::format("INSERT INTO main.{0} SELECT * FROM other.{0}", table));
            }
            db.exec("CREATE INDEX plan_identity ON plan(identity)");
            db.exec("INSERT OR REPLACE INTO main.meta SELECT * FROM other.meta");
            note(plan_hash_key, hash_of_plan(db));
        }
        std::vector<std::string> names;
        SQLite::Statement columns(db, "SELECT name FROM pragma_table_info('figures', 'other')");
        while (columns.executeStep()) {
            const std::string name = columns.getColumn(0).getString();
            names.push_back(quoted(name));
            if (figure_columns_.insert(name).second)
                db.exec(fmt::format("ALTER TABLE main.figures ADD COLUMN {} ANY", quoted(name)));
        }
        // A result replaces failures and results without kept files; a verdict on the case replaces a system failure.
        const auto rank = [](const char* row) {
            return fmt::format(
                "CASE WHEN {0}.state = '{1}' THEN 3 + ({0}.curve_sha256 IS NOT NULL OR "
                "{0}.summary_sha256 IS NOT NULL) WHEN {0}.state IN ('{2}', '{3}') THEN 1 ELSE 2 END",
                row, row_done, row_failed, row_crashed);
        };
        const int added = db.exec(
            fmt::format("INSERT OR REPLACE INTO main.test SELECT * FROM other.test AS o WHERE NOT EXISTS (SELECT 1 "
                        "FROM main.test AS m WHERE m.identity = o.identity AND {} >= {})",
                        rank("m"), rank("o")));
        db.exec(fmt::format("INSERT OR IGNORE INTO main.figures({0}) SELECT {0} FROM other.figures",
                            fmt::join(names, ", ")));
        make_views();
        change.commit();
        db.exec("DETACH DATABASE other");
        return static_cast<std::int64_t>(added);
    });
}

std::vector<std::string> CampaignLedger::drop_damaged() {
    return guarded([&] {
        SQLite::Database& db = *database_;
        std::vector<std::string> dropped;
        SQLite::Transaction change(db);
        for (const CheckedRow& row : checked_rows(db)) {
            if (row.whole) continue;
            dropped.push_back(called(db, row.identity));
            for (const char* table : {"figures", "test"}) {
                SQLite::Statement drop(db, fmt::format("DELETE FROM {} WHERE identity = ?", table));
                drop.bind(1, row.identity);
                run(drop);
            }
        }
        db.exec("DELETE FROM figures WHERE identity NOT IN (SELECT identity FROM test)");
        change.commit();
        return dropped;
    });
}

std::int64_t CampaignLedger::drop_gone_wrong() {
    return guarded([&] {
        SQLite::Transaction change(*database_);
        database_->exec("DELETE FROM figures WHERE identity IN (SELECT identity FROM test WHERE state <> 'done')");
        const int dropped = database_->exec("DELETE FROM test WHERE state <> 'done'");
        change.commit();
        return static_cast<std::int64_t>(dropped);
    });
}

std::map<std::string, std::string> CampaignLedger::ended() const {
    return guarded([&] {
        std::map<std::string, std::string> states;
        for (const CheckedRow& row : checked_rows(*database_))
            if (row.whole) states.emplace(row.identity, row.state);
        return states;
    });
}

std::map<std::string, KeptHashes> CampaignLedger::kept_hashes() const {
    return guarded([&] {
        std::map<std::string, KeptHashes> hashes;
        if (!has_hashes(*database_)) return hashes;
        SQLite::Statement tests(*database_, "SELECT identity, sha256, curve_sha256, summary_sha256 FROM test");
        while (tests.executeStep()) {
            const auto text = [&](int k) { return tests.getColumn(k).isNull() ? "" : tests.getColumn(k).getString(); };
            if (!tests.getColumn(1).isNull()) hashes[text(0)] = {text(2), text(3)};
        }
        return hashes;
    });
}

void CampaignLedger::require_whole_plan() const {
    guarded([&] {
        const std::string recorded = meta(plan_hash_key);
        if (recorded.empty() || recorded == hash_of_plan(*database_)) return;
        throw InputError(fmt::format(
            "{}: found a plan that is not the one recorded, expected axes, seeds and texts that match its hash; "
            "run the command that made the ledger again, which restores the plan and keeps finished tests",
            file_.string()));
    });
}

void CampaignLedger::require_whole() const {
    guarded([&] {
        require_whole_plan();
        std::vector<std::string> damaged;
        for (const CheckedRow& row : checked_rows(*database_))
            if (!row.whole) damaged.push_back(called(*database_, row.identity));
        if (damaged.empty()) return;
        throw InputError(
            fmt::format("{}: {}: found values that differ from those recorded, expected values that match their "
                        "hash{}; run the command that made the ledger again, which repeats the test",
                        file_.string(), damaged.front(),
                        damaged.size() > 1 ? fmt::format(" (also in {} more tests)", damaged.size() - 1) : ""));
    });
}

LedgerCounts CampaignLedger::counts() const {
    return guarded([&] {
        SQLite::Statement all(*database_,
                              "SELECT (SELECT count(*) FROM plan), count(*), coalesce(sum(state = 'done'), 0), "
                              "coalesce(sum(state <> 'done'), 0), coalesce(sum(state IN (?, ?)), 0), "
                              "coalesce(sum(processor_seconds), 0.0) FROM (SELECT DISTINCT identity FROM plan) LEFT "
                              "JOIN test USING(identity)");
        all.bind(1, row_failed);
        all.bind(2, row_crashed);
        all.executeStep();
        return LedgerCounts{all.getColumn(0).getInt64(), all.getColumn(1).getInt64(), all.getColumn(2).getInt64(),
                            all.getColumn(3).getInt64(), all.getColumn(4).getInt64(), all.getColumn(5).getDouble()};
    });
}

std::string CampaignLedger::meta(const std::string& key) const {
    return guarded([&] {
        SQLite::Statement one(*database_, "SELECT value FROM meta WHERE key = ?");
        one.bind(1, key);
        return one.executeStep() ? one.getColumn(0).getString() : std::string();
    });
}

LedgerTable CampaignLedger::results() const {
    require_whole();
    // The stored view `results` has no hash, so its query is run here. Cell types are checked, as hashes ignore them.
    LedgerTable table = guarded([&] { return query(results_query()); });
    for (const char* column : {"test", "seed", "variant", "identity"}) {
        const auto at = std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin();
        const bool number = std::string_view(column) == "seed";
        for (const auto& row : table.rows) {
            const LedgerCell& cell = row[static_cast<std::size_t>(at)];
            if (number ? std::holds_alternative<double>(cell) : std::holds_alternative<std::string>(cell)) continue;
            throw InputError(
                fmt::format("{}: found a row whose {} is missing, expected {}; run the command that made "
                            "the ledger again, which restores the plan",
                            file_.string(), column, number ? "a number" : "a text"));
        }
    }
    return table;
}

LedgerTable CampaignLedger::query(const std::string& sql) const {
    return guarded([&] {
        LedgerTable table;
        SQLite::Statement statement(*database_, sql);
        for (int k = 0; k < statement.getColumnCount(); ++k) table.columns.emplace_back(statement.getColumnName(k));
        while (statement.executeStep()) {
            std::vector<LedgerCell>& row = table.rows.emplace_back();
            for (int k = 0; k < statement.getColumnCount(); ++k) row.push_back(cell_of(statement.getColumn(k)));
        }
        return table;
    });
}

}  // namespace crackle
