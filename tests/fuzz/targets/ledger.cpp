// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign's ledger. If the first byte is 0, the rest replaces bytes of a valid ledger: three bytes of position, then
// the new byte. Otherwise it sets cells of tables, with corrected hashes: table, column, row, kind of value, value.

#include "specimens/campaign/ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/campaign/ledger_hashes.hpp"
#include "specimens/campaign/plan_file.hpp"
#include "specimens/campaign/point_table.hpp"
#include "specimens/envelope/measured_strengths.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/targets.hpp"

namespace crackle::fuzz {
namespace {

constexpr const char* test_case =
    "[packing]\ncount = 30\nradius_min = 0.01\nradius_max = 0.02\nmean_overlap = 1e-4\n[material]\ndensity = 2500\n"
    "normal_stiffness = 1e7\nshear_stiffness = 2.5e6\nfriction_angle = 27\ndamping_ratio = 0.2\n[loading]\nkind = "
    "\"tension\"\nmax_axial_strain = 0.02\n";
constexpr const char* plan_text =
    "title = \"small\"\n[[test]]\nname = \"pull\"\ncase = \"case.toml\"\n[[axis]]\nkey = "
    "\"material.friction_angle\"\nvalues = [20, 30]\n[packings]\ncount = 2\n";

/// The bytes of a ledger of four tests, one of which failed.
std::string whole_ledger() {
    write_file("case.toml", test_case);
    const Plan plan = read_plan(write_file("plan.toml", plan_text));
    const std::filesystem::path file = scratch() / "whole.sqlite";
    CampaignLedger ledger = CampaignLedger::open(file, Journal::within);
    std::vector<std::string> identities;
    for (std::size_t k = 0; k < plan.rows.size(); ++k) identities.push_back(fmt::format("test{}", k));
    ledger.set_plan(plan, identities);
    for (const std::string& identity : identities) {
        RowResult result;
        result.identity = identity;
        result.state = identity == "test3" ? row_refused : row_done;
        result.message = identity == "test3" ? "found no way" : "";
        result.processor_seconds = 0.5;
        if (identity != "test3")
            result.figures = {{"kind", "tension"},   {"material_units", "area"},        {"failed", 1.0},
                              {"peak_stress", 2e6},  {"youngs_modulus", 1e10},          {"failed_at", "gauge"},
                              {"peak_strain", 2e-4}, {"loading.max_axial_strain", 0.02}};
        ledger.record(result, "host");
    }
    return read_file(file);
}

/// Replaces bytes at the positions given by the input.
std::string changed_file(std::string bytes, std::string_view input) {
    for (Values values(input.substr(0, 400)); !bytes.empty() && !input.empty(); input.remove_prefix(4)) {
        if (input.size() < 4) break;
        const std::size_t place = (values.byte() * 256UL + values.byte()) * 256UL + values.byte();
        bytes[place % bytes.size()] = static_cast<char>(values.byte());
    }
    return bytes;
}

void bind_cell(SQLite::Statement& statement, int place, Values& values) {
    switch (values.byte() % 5U) {
        case 0:
            statement.bind(place);
            break;
        case 1:
            statement.bind(place, values.number());
            break;
        case 2:
            statement.bind(place, static_cast<std::int64_t>(values.byte()) << (values.byte() % 56U));
            break;
        case 3: {
            std::string text(values.byte() % 16U, ' ');
            for (char& letter : text) letter = static_cast<char>(values.byte());
            statement.bind(place, text);
            break;
        }
        default:
            statement.bind(place, std::string("test") + static_cast<char>('0' + values.byte() % 5U));
    }
}

void change_cells(const std::filesystem::path& file, std::string_view input) {
    constexpr std::array tables{"meta", "test", "figures", "point", "plan"};
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    database.exec("PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF");
    Values values(input);
    for (int change = values.byte() % 4; change >= 0; --change) {
        const char* table = tables[values.byte() % tables.size()];
        std::vector<std::string> columns;
        SQLite::Statement names(database, fmt::format("SELECT name FROM pragma_table_info('{}')", table));
        while (names.executeStep()) columns.push_back(names.getColumn(0).getString());
        SQLite::Statement update(
            database,
            fmt::format("UPDATE {0} SET \"{1}\" = ? WHERE \"{2}\" = (SELECT \"{2}\" FROM {0} LIMIT 1 OFFSET ?)", table,
                        columns[values.byte() % columns.size()], columns[0]));
        update.bind(2, values.byte() % 9);
        bind_cell(update, 1, values);
        try {
            update.exec();
        } catch (const SQLite::Exception&) {  // for example a duplicate key, or a value of a wrong kind
        }
    }
    SQLite::Statement tests(database, "SELECT identity FROM test");
    std::vector<std::string> identities;
    while (tests.executeStep()) identities.push_back(tests.getColumn(0).getString());
    for (const std::string& identity : identities) {
        SQLite::Statement hash(database, "UPDATE test SET sha256 = ? WHERE identity = ?");
        hash.bind(1, hash_of_test(database, identity));
        hash.bind(2, identity);
        hash.exec();
    }
    SQLite::Statement plan(database, "UPDATE meta SET value = ? WHERE key = ?");
    plan.bind(1, hash_of_plan(database));
    plan.bind(2, plan_hash_key);
    plan.exec();
}

/// Reads the ledger as the commands do, each separately.
template <class Reading>
void read_as(const Reading& reading) {
    try {
        reading();
    } catch (const InputError&) {
    }
}

}  // namespace

void ledger(std::string_view bytes) {
    static const std::string whole = whole_ledger();
    if (bytes.empty()) return;
    const bool of_file = bytes.front() == 0;
    bytes.remove_prefix(1);
    const std::filesystem::path folder = scratch() / "campaign";
    std::filesystem::create_directories(folder);
    const std::filesystem::path file =
        write_file("campaign/campaign.sqlite", of_file ? changed_file(whole, bytes) : whole);
    if (!of_file) change_cells(file, bytes);
    read_as([&] {
        const CampaignLedger ledger = CampaignLedger::read(file);
        const LedgerTable results = ledger.results();
        const std::vector<PointSummary> points = summarise(results, numeric_figures(results));
        points_csv(points, usual_figures(results));
        tests_csv(results);
    });
    read_as([&] { CampaignLedger::read(file).counts(); });
    read_as([&] { CampaignLedger::read(file).kept_hashes(); });
    read_as([&] { read_strengths(std::array{folder}); });
    read_as([&] {
        CampaignLedger ledger = CampaignLedger::open(file, Journal::within);
        ledger.drop_damaged();
        ledger.ended();
        ledger.drop_gone_wrong();
    });
}

}  // namespace crackle::fuzz
