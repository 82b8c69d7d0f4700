// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the contents of the ledger are either what was recorded, or reported as changed.

#include "specimens/campaign/ledger.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/base/errors.hpp"
#include "specimens/campaign/ledger_hashes.hpp"
#include "tests/specimens/campaign/small_campaign.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::write_small_plan;
using testing::write_text;

using LedgerTest = testing::SmallCampaign;

TEST_F(LedgerTest, AnAxisOfAKeyThatIsAFigureTooKeepsBothApart) {
    testing::write_packed_case(folder_ / "tension.toml");
    write_text(folder_ / "plan.toml",
               "[[test]]\ncase = \"tension.toml\"\n[[axis]]\nkey = \"packing.mean_overlap\"\n"
               "values = [7e-5, 8e-5]\n");
    run("out");
    const LedgerTable results = CampaignLedger::read(ledger_file(folder_ / "out")).results();
    for (const char* column : {"packing.mean_overlap", "packing.mean_overlap (reached)"})
        EXPECT_EQ(std::count(results.columns.begin(), results.columns.end(), column), 1) << column;
}

/// Changes a ledger with SQL, without the program.
void change(const fs::path& file, const std::string& sql) {
    SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
    EXPECT_GE(database.exec(sql), 0);
}

std::string refusal_of(const CampaignLedger& ledger) {
    try {
        static_cast<void>(ledger.results());
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        return error.what();
    }
    return "";
}

TEST_F(LedgerTest, ARowThatWasChangedIsNamedAndRunAgain) {
    write_small_plan(folder_, 1);
    run("out");
    const std::string before = table("out");
    for (const char* sql : {"UPDATE figures SET peak_stress = 1.0001 * peak_stress WHERE identity = (SELECT identity "
                            "FROM plan WHERE row = 3)",
                            "UPDATE figures SET kind = 'tension' WHERE identity = (SELECT identity FROM plan WHERE row "
                            "= 3)",
                            "DELETE FROM figures WHERE identity = (SELECT identity FROM plan WHERE row = 3)",
                            "UPDATE test SET state = 'refused' WHERE identity = (SELECT identity FROM plan WHERE row = "
                            "3)"}) {
        change(ledger_file(folder_ / "out"), sql);
        const std::string refused = refusal_of(ledger("out"));
        EXPECT_NE(refused.find("row 3 (compression, material.friction_angle = 35, seed 1)"), std::string::npos) << sql;
        EXPECT_EQ(run("out").run, 1) << sql;
        ASSERT_EQ(told_.size(), 1U);
        EXPECT_NE(told_[0].find("row 3 (compression"), std::string::npos) << told_[0];
        EXPECT_EQ(table("out"), before) << sql;
    }
}

TEST_F(LedgerTest, APlanThatWasChangedIsNamedAndPutRight) {
    write_small_plan(folder_, 1);
    run("out");
    const std::string before = table("out");
    for (const char* sql :
         {"UPDATE point SET \"material.friction_angle\" = 21 WHERE number = 0",
          "UPDATE plan SET seed = 9 WHERE row = 1", "UPDATE meta SET value = 'x' WHERE key = 'title'"}) {
        change(ledger_file(folder_ / "out"), sql);
        EXPECT_NE(refusal_of(ledger("out")).find("found a plan that is not the one recorded"), std::string::npos)
            << sql;
        EXPECT_EQ(run("out").run, 0) << sql;
        EXPECT_EQ(table("out"), before) << sql;
    }
}

// Hashes cover neither views nor declared column types.
TEST_F(LedgerTest, WhatNoHashIsOfIsNotBelieved) {
    write_small_plan(folder_, 1);
    run("out");
    const fs::path file = ledger_file(folder_ / "out");
    const std::string before = table("out");
    change(file, "DROP VIEW results");
    change(file, "CREATE VIEW results AS SELECT row, 'tension' AS test FROM plan");
    EXPECT_EQ(table("out"), before);
    for (const char* column : {"variant", "identity"}) {
        change(file, fmt::format("PRAGMA writable_schema = ON; UPDATE sqlite_schema SET sql = replace(replace(sql, "
                                 "'{0} TEXT NOT NULL', '{0}'), ') STRICT', ')') WHERE name = 'plan'",
                                 column));
        change(file, fmt::format("UPDATE plan SET {} = 3.5 WHERE row = 0", column));
        SQLite::Database database(file.string(), SQLite::OPEN_READWRITE);
        database.exec("UPDATE meta SET value = '" + hash_of_plan(database) + "' WHERE key = 'plan_sha256'");
        EXPECT_NE(refusal_of(ledger("out")).find(fmt::format("found a row whose {} is missing", column)),
                  std::string::npos);
        EXPECT_EQ(run("out").run, 0);
        EXPECT_EQ(table("out"), before);
    }
}

TEST_F(LedgerTest, ADamagedShareIsGatheredWithoutItsDamage) {
    write_small_plan(folder_, 2);
    run("whole");
    run("shared", 1, {1, 2});
    run("shared", 1, {2, 2});
    change(folder_ / "shared/shards/2.sqlite",
           "UPDATE figures SET peak_stress = 9e9 WHERE rowid = (SELECT min(rowid) FROM figures)");
    try {
        gather_shards(folder_ / "shared");
        ADD_FAILURE() << "it was believed";
    } catch (const InputError& error) {
        fmt::print("  {}\n", error.what());
        EXPECT_NE(std::string(error.what()).find("shards/2.sqlite: row "), std::string::npos);
    }
    EXPECT_EQ(ledger("shared").counts().done, 7);
    EXPECT_EQ(run("shared", 1, {2, 2}).run, 1);
    EXPECT_EQ(gather_shards(folder_ / "shared").counts.done, 8);
    EXPECT_EQ(table("shared"), table("whole"));
}

TEST_F(LedgerTest, OfAnEarlierVersionIsReadAsItIsAndGoneOnWith) {
    write_small_plan(folder_, 1, "[run]\nkeep = \"curves\"\n");
    run("out");
    const std::string before = table("out");
    const fs::path file = ledger_file(folder_ / "out");
    for (const char* column : {"sha256", "curve_sha256", "summary_sha256"})
        change(file, fmt::format("ALTER TABLE test DROP COLUMN {}", column));
    change(file, "DELETE FROM meta WHERE key = 'plan_sha256'");
    change(file, "PRAGMA user_version = 1");
    EXPECT_EQ(table("out"), before) << "read";
    EXPECT_EQ(run("out").run, 0);
    EXPECT_EQ(table("out"), before) << "gone on with";
    write_small_plan(folder_, 2, "[run]\nkeep = \"curves\"\n");
    EXPECT_EQ(run("out").run, 4) << "only the second packing";
    change(file, "UPDATE figures SET peak_stress = 9e9 WHERE identity = (SELECT identity FROM plan WHERE row = 7)");
    EXPECT_NE(refusal_of(ledger("out")).find("row 7"), std::string::npos) << "new rows have hashes";
}

// A result found by a share when it was run again replaces a failure gathered earlier.
TEST_F(LedgerTest, WhatIsKnownBetterTakesThePlaceOfWhatIsKnown) {
    const auto with = [&](const char* name, const char* state, const std::string& curve) {
        CampaignLedger ledger = CampaignLedger::open(folder_ / name);
        RowResult result;
        result.identity = "one";
        result.state = state;
        result.curve_sha256 = curve;
        if (result.state == row_done) result.figures = {{"peak_stress", 3.0}};
        ledger.record(result, "here");
    };
    const auto state_after = [&](const char* into, const char* from) {
        CampaignLedger ledger = CampaignLedger::open(folder_ / into);
        ledger.gather(folder_ / from, false);
        return ledger.ended().at("one");
    };
    with("failure", row_failed, "");
    with("verdict", row_unstable, "");
    with("result", row_done, "");
    with("kept", row_done, "abc");
    EXPECT_EQ(state_after("verdict", "failure"), row_unstable);
    EXPECT_EQ(state_after("failure", "verdict"), row_unstable);
    EXPECT_EQ(state_after("result", "verdict"), row_done);
    EXPECT_EQ(state_after("result", "kept"), row_done);
    EXPECT_EQ(CampaignLedger::read(folder_ / "result").kept_hashes().at("one").curve, "abc");
}

}  // namespace
}  // namespace crackle
