// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/campaign/ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>
#include <xxhash.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "solver/base/errors.hpp"
#include "solver/base/version.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/identity.hpp"

namespace crackle {
namespace {

constexpr int application_id = 0x43524b4c;  // "CRKL": by it a file is known to be a ledger
constexpr int layout_version = 1;
constexpr int busy_milliseconds = 10'000;
constexpr std::size_t most_columns_of_long = 480;  // SQLite joins at most 500 queries

/// As SQL reads it, between marks that are doubled within.
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
    if (const auto* number = std::get_if<double>(&value))
        statement.bind(place, *number);
    else if (const auto* whole = std::get_if<std::int64_t>(&value))
        statement.bind(place, *whole);
    else if (const auto* flag = std::get_if<bool>(&value))
        statement.bind(place, *flag ? 1 : 0);
    else
        statement.bind(place, value_text(value));
}

LedgerCell cell_of(const SQLite::Column& column) {
    if (column.isNull()) return {};
    if (column.isText() || column.isBlob()) return column.getString();
    return column.getDouble();
}

/// By what two plans are known to ask for the same rows, however they are written.
std::string rows_mark(const Plan& plan, const std::vector<std::string>& identities) {
    std::string text;
    for (std::size_t k = 0; k < identities.size(); ++k)
        text += fmt::format("{} {} {} {}\n", plan.rows[k].point, plan.rows[k].seed, name_of(plan.rows[k].variant),
                            identities[k]);
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

/// By the tests' names.
std::string rocks_text(const Plan& plan) {
    nlohmann::ordered_json rocks = nlohmann::ordered_json::object();
    FileHashes files;
    for (std::size_t k = 0; k < plan.points.size(); ++k) {
        const PlanPoint& point = plan.points[k];
        const std::string& name = plan.tests[point.test].name;
        if (rocks.contains(name)) continue;
        std::map<std::string, std::string> keys =
            keys_of_rock(plan.test_of({k, point.own_seed, Variant::as_asked}), files);
        for (const CaseSetting& setting : point.settings) keys.erase(setting.key);
        rocks[name] = keys;
    }
    return rocks.dump();
}

void run(SQLite::Statement& statement) {
    statement.exec();
    statement.reset();
}

}  // namespace

/// Errors of SQLite name the file and say what they are about.
template <class Work>
auto CampaignLedger::guarded(const Work& work) const {
    try {
        return work();
    } catch (const SQLite::Exception& error) {
        const std::string file = file_.string();
        switch (error.getErrorCode()) {
            case SQLITE_FULL:
            case SQLITE_IOERR:
            case SQLITE_READONLY:
            case SQLITE_CANTOPEN:
                throw OutputError(fmt::format(
                    "{}: cannot be written ({}), expected a writable folder with room on the disc; the same command "
                    "goes on",
                    file, error.getErrorStr()));
            case SQLITE_BUSY:
            case SQLITE_LOCKED:
                throw OutputError(
                    fmt::format("{}: another program is writing it, expected it left alone for {} s; end "
                                "that, the same command goes on",
                                file, busy_milliseconds / 1000));
            case SQLITE_CORRUPT:
            case SQLITE_NOTADB:
                throw InputError(
                    fmt::format("{}: found a file that is no ledger or is damaged ({}), expected one that "
                                "`crackle campaign` made; restore a copy, or choose another -o",
                                file, error.getErrorStr()));
            default:
                throw InputError(
                    fmt::format("{}: {}, expected a ledger that `crackle campaign` made", file, error.what()));
        }
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
                "{}: found a file that is no ledger, expected one that `crackle campaign` made", file.string()));
    });
    return ledger;
}

void CampaignLedger::make_tables(Journal journal) {
    SQLite::Database& db = *database_;
    const int id = db.execAndGet("PRAGMA application_id").getInt();
    const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
    if (!empty && id != application_id)
        throw InputError(
            fmt::format("{}: found a file that is no ledger, expected one that `crackle campaign` made; "
                        "choose another -o",
                        file_.string()));
    const int version = db.execAndGet("PRAGMA user_version").getInt();
    if (!empty && version != layout_version)
        throw InputError(
            fmt::format("{}: found a ledger of layout {}, expected {}; it was made by another version of "
                        "crackle: choose another -o",
                        file_.string(), version, layout_version));
    // One writer; a stopped process loses no change that was finished.
    db.exec(journal == Journal::beside ? "PRAGMA journal_mode = WAL" : "PRAGMA journal_mode = TRUNCATE");
    db.exec(journal == Journal::beside ? "PRAGMA synchronous = NORMAL" : "PRAGMA synchronous = OFF");
    db.exec("PRAGMA foreign_keys = ON");
    if (empty) {
        SQLite::Transaction change(db);
        db.exec(fmt::format("PRAGMA application_id = {}", application_id));
        db.exec(fmt::format("PRAGMA user_version = {}", layout_version));
        db.exec("CREATE TABLE meta(key TEXT PRIMARY KEY, value ANY) STRICT, WITHOUT ROWID");
        db.exec(
            "CREATE TABLE test(identity TEXT PRIMARY KEY, state TEXT NOT NULL, tries INTEGER NOT NULL, host TEXT, "
            "processor_seconds REAL, wall_seconds REAL, exit INTEGER, message TEXT, notices TEXT) STRICT");
        db.exec("CREATE TABLE figures(identity TEXT PRIMARY KEY REFERENCES test(identity)) STRICT");
        db.exec("CREATE TABLE point(number INTEGER PRIMARY KEY, test TEXT NOT NULL) STRICT");
        db.exec(
            "CREATE TABLE plan(row INTEGER PRIMARY KEY, point INTEGER NOT NULL REFERENCES point(number), "
            "seed INTEGER NOT NULL, variant TEXT NOT NULL, identity TEXT NOT NULL) STRICT");
        make_views();
        change.commit();
    }
    SQLite::Statement columns(db, "SELECT name FROM pragma_table_info('figures')");
    while (columns.executeStep()) figure_columns_.insert(columns.getColumn(0).getString());
}

void CampaignLedger::make_views() {
    SQLite::Database& db = *database_;
    db.exec("DROP VIEW IF EXISTS results");
    db.exec("DROP VIEW IF EXISTS long");
    std::vector<std::string> of_point, of_figures, parts;
    std::set<std::string> axes;
    SQLite::Statement points(db, "SELECT name FROM pragma_table_info('point')");
    while (points.executeStep()) {
        const std::string name = points.getColumn(0).getString();
        if (name != "number") of_point.push_back("point." + quoted(name));
        axes.insert(name);
    }
    SQLite::Statement figures(db, "SELECT name FROM pragma_table_info('figures')");
    while (figures.executeStep()) {
        const std::string name = figures.getColumn(0).getString();
        if (name == "identity") continue;
        // What was asked for has the name; what came of it another.
        const std::string shown = axes.contains(name) ? name + " (reached)" : name;
        of_figures.push_back(fmt::format(", figures.{} AS {}", quoted(name), quoted(shown)));
        if (parts.size() < most_columns_of_long)
            parts.push_back(
                fmt::format("SELECT plan.row AS row, point.test AS test, plan.variant AS variant, {} AS figure, "
                            "figures.{} AS value FROM plan JOIN point ON point.number = plan.point JOIN figures "
                            "USING(identity) WHERE typeof(figures.{}) IN ('real', 'integer')",
                            literal(shown), quoted(name), quoted(name)));
    }
    db.exec(
        fmt::format("CREATE VIEW results AS SELECT plan.row AS row, {}, plan.seed AS seed, plan.variant AS variant, "
                    "plan.identity AS identity, test.state AS state, test.processor_seconds AS processor_seconds{} "
                    "FROM plan JOIN point ON point.number = plan.point LEFT JOIN test USING(identity) LEFT JOIN "
                    "figures USING(identity) ORDER BY plan.row",
                    fmt::join(of_point, ", "), fmt::join(of_figures, "")));
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
        db.exec(
            "CREATE TABLE plan(row INTEGER PRIMARY KEY, point INTEGER NOT NULL REFERENCES point(number), "
            "seed INTEGER NOT NULL, variant TEXT NOT NULL, identity TEXT NOT NULL) STRICT");
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
        SQLite::Statement meta(db, "INSERT OR REPLACE INTO meta VALUES(?, ?)");
        const auto note = [&](const char* key, const std::string& value) {
            meta.bind(1, key);
            meta.bind(2, value);
            run(meta);
        };
        note("title", plan.title);
        note("plan", plan.text);
        note("plan_file", plan.file.filename().string());
        note("results_version", fmt::format("{}", results_version));
        note("rows", rows_mark(plan, identities));
        note("rocks", rocks_text(plan));
        make_views();
        change.commit();
    });
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
        SQLite::Statement test(
            db,
            "INSERT INTO test VALUES(?, ?, 1, ?, ?, ?, ?, ?, ?) ON CONFLICT(identity) DO UPDATE SET state = "
            "excluded.state, tries = tries + 1, host = excluded.host, processor_seconds = excluded.processor_seconds, "
            "wall_seconds = excluded.wall_seconds, exit = excluded.exit, message = excluded.message, notices = "
            "excluded.notices");
        test.bind(1, result.identity);
        test.bind(2, result.state);
        test.bind(3, host);
        test.bind(4, result.processor_seconds);
        test.bind(5, result.wall_seconds);
        test.bind(6, result.exit);
        if (!result.message.empty()) test.bind(7, result.message);
        if (!result.notices.empty()) test.bind(8, fmt::format("{}", fmt::join(result.notices, "\n")));
        run(test);
        put_figures(result.identity, result.figures);
        change.commit();
    });
}

void CampaignLedger::put_figures(const std::string& identity, const Figures& all) {
    if (all.empty()) return;
    add_columns(all);
    std::string names = "identity", places = "?";
    for (const auto& [name, value] : all) {
        names += ", " + quoted(name);
        places += ", ?";
    }
    SQLite::Statement figures(*database_, fmt::format("INSERT OR REPLACE INTO figures({}) VALUES({})", names, places));
    int place = 1;
    figures.bind(place, identity);
    for (const auto& [name, value] : all) {
        ++place;
        if (const auto* word = std::get_if<std::string>(&value))
            figures.bind(place, *word);
        else
            figures.bind(place, std::get<double>(value));
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
        }
        std::vector<std::string> names;
        SQLite::Statement columns(db, "SELECT name FROM pragma_table_info('figures', 'other')");
        while (columns.executeStep()) {
            const std::string name = columns.getColumn(0).getString();
            names.push_back(quoted(name));
            if (figure_columns_.insert(name).second)
                db.exec(fmt::format("ALTER TABLE main.figures ADD COLUMN {} ANY", quoted(name)));
        }
        // A test that is done is done, whoever did it.
        const int added = db.exec(
            "INSERT OR REPLACE INTO main.test SELECT * FROM other.test AS o WHERE NOT EXISTS (SELECT 1 FROM main.test "
            "AS m WHERE m.identity = o.identity AND (m.state = 'done' OR o.state <> 'done'))");
        db.exec(fmt::format("INSERT OR IGNORE INTO main.figures({0}) SELECT {0} FROM other.figures",
                            fmt::join(names, ", ")));
        make_views();
        change.commit();
        db.exec("DETACH DATABASE other");
        return static_cast<std::int64_t>(added);
    });
}

std::map<std::string, std::string> CampaignLedger::ended() const {
    return guarded([&] {
        std::map<std::string, std::string> states;
        SQLite::Statement tests(*database_, "SELECT identity, state FROM test");
        while (tests.executeStep()) states.emplace(tests.getColumn(0).getString(), tests.getColumn(1).getString());
        return states;
    });
}

LedgerCounts CampaignLedger::counts() const {
    return guarded([&] {
        SQLite::Statement all(*database_,
                              "SELECT (SELECT count(*) FROM plan), count(*), coalesce(sum(state = 'done'), 0), "
                              "coalesce(sum(state <> 'done'), 0), coalesce(sum(processor_seconds), 0.0) FROM (SELECT "
                              "DISTINCT identity FROM plan) LEFT JOIN test USING(identity)");
        all.executeStep();
        return LedgerCounts{all.getColumn(0).getInt64(), all.getColumn(1).getInt64(), all.getColumn(2).getInt64(),
                            all.getColumn(3).getInt64(), all.getColumn(4).getDouble()};
    });
}

std::string CampaignLedger::meta(const std::string& key) const {
    return guarded([&] {
        SQLite::Statement one(*database_, "SELECT value FROM meta WHERE key = ?");
        one.bind(1, key);
        return one.executeStep() ? one.getColumn(0).getString() : std::string();
    });
}

LedgerTable CampaignLedger::results() const { return query("SELECT * FROM results"); }

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
