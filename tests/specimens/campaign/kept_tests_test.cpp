// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the files kept of tests beside the ledger: their names, and that they are what the tests wrote.

#include "specimens/campaign/kept_tests.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "tests/specimens/campaign/small_campaign.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::write_small_plan;
using testing::write_text;

using KeptTestsTest = testing::SmallCampaign;

TEST_F(KeptTestsTest, CurvesAskedForLaterAreMade) {
    write_small_plan(folder_, 1);
    run("out");
    write_small_plan(folder_, 1, "[run]\nkeep = \"curves\"\n");
    EXPECT_EQ(run("out").run, 4);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "out/curves"), fs::directory_iterator()), 4);
    EXPECT_EQ(run("out").run, 0);
}

TEST_F(KeptTestsTest, KeepsCurvesOrEverythingWhereAskedFor) {
    write_small_plan(folder_, 1, "[run]\nkeep = \"curves\"\n");
    run("curves");
    write_small_plan(folder_, 1, "[run]\nkeep = \"all\"\n");
    run("all");
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "curves/curves")) {
        ++files;
        const fs::path whole = folder_ / "all/tests" / entry.path().stem() / "curve.csv";
        EXPECT_EQ(read_file(entry.path()), read_file(whole));
    }
    EXPECT_EQ(files, 4U);
    EXPECT_EQ(table("curves"), table("all"));
}

TEST_F(KeptTestsTest, WhatIsKeptIsNamedByTestPointAndPackingAndFoundByIdentity) {
    write_small_plan(folder_, 1, "[run]\nkeep = \"all\"\n");
    run("out");
    const std::regex readable("(tension|compression)-friction_angle=(20|35)-packing1-[0-9a-f]{12}");
    std::set<std::string> points;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/tests")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(std::regex_match(name, readable)) << name;
        points.insert(name.substr(0, name.rfind('-')));
    }
    EXPECT_EQ(points.size(), 4U);
    // Earlier versions used all digits of the identity as the name. Such files are found, and nothing is run again.
    const LedgerTable tests = ledger("out").query("SELECT identity FROM test");
    ASSERT_EQ(tests.rows.size(), 4U);
    for (const auto& row : tests.rows) {
        const std::string identity = std::get<std::string>(row[0]);
        const auto named = KeptTests(folder_ / "out").folder(identity);
        ASSERT_TRUE(named.has_value()) << identity;
        fs::rename(*named, folder_ / "out/tests" / identity);
        EXPECT_EQ(KeptTests(folder_ / "out").curve(identity), folder_ / "out/tests" / identity / "curve.csv");
    }
    EXPECT_EQ(run("out").run, 0);
    EXPECT_FALSE(KeptTests(folder_ / "out").name("0123456789abcdef0123456789abcdef").has_value());
}

TEST_F(KeptTestsTest, APointOfManyAxesIsNamedByItsNumber) {
    Plan plan = read_plan(write_small_plan(folder_));
    const PlanRow& row = plan.rows.back();
    const std::string identity = "0123456789abcdef0123456789abcdef";
    EXPECT_EQ(kept_name(plan, row, identity), "compression-friction_angle=35-packing2-0123456789ab");
    for (const char* key : {"mineral[1].contact_modulus", "mineral[2].contact_modulus", "material.tensile_strength"})
        plan.points[row.point].settings.push_back({key, CaseValue(6e10), "plan.toml"});
    EXPECT_EQ(kept_name(plan, row, identity), "compression-point4-packing2-0123456789ab");
    plan.points[row.point].settings = {{"mineral[1].cohesion", CaseValue(6e7), "plan.toml"}};
    plan.tests[1].name = "Größe/1";
    const std::string odd = kept_name(plan, row, identity);
    EXPECT_EQ(odd.find('/'), std::string::npos) << odd;
    EXPECT_NE(odd.find("-mineral1.cohesion="), std::string::npos) << odd;
}

/// Identities of the completed tests of a ledger.
std::vector<std::string> identities_of(const CampaignLedger& ledger) {
    std::vector<std::string> all;
    for (const auto& row : ledger.query("SELECT identity FROM test WHERE state = 'done' ORDER BY identity").rows)
        all.push_back(std::get<std::string>(row[0]));
    return all;
}

/// Changes a digit of the last number in a file.
void change_last_digit(const fs::path& file) {
    std::string text = read_file(file);
    const std::size_t at = text.find_last_of("0123456789");
    text[at] = text[at] == '7' ? '8' : '7';
    write_text(file, text);
}

TEST_F(KeptTestsTest, ACurveThatWasChangedIsNamedAndItsTestRunAgain) {
    for (const auto& [keep, file] : {std::pair("curves", ".csv"), std::pair("all", "/curve.csv"),
                                     std::pair("all", "/summary.json"), std::pair("all", "/events.csv")}) {
        write_small_plan(folder_, 1, fmt::format("[run]\nkeep = \"{}\"\n", keep));
        run(keep);
        const std::string identity = identities_of(ledger(keep)).front();
        const KeptTests whole(folder_ / keep, ledger(keep).kept_hashes());
        const auto curve = whole.read_curve(identity);
        ASSERT_TRUE(curve.has_value());
        const fs::path changed =
            folder_ / keep / (std::string(keep) == "all" ? "tests" : "curves") / (*whole.name(identity) + file);
        const std::string before = read_file(changed);
        change_last_digit(changed);
        const std::string fault = whole.fault_of(identity, std::string(keep) == "all" ? Keep::all : Keep::curves);
        fmt::print("  {}\n", fault);
        EXPECT_EQ(fault.rfind(changed.string() + ": found ", 0), 0U) << fault;
        if (changed.filename() != "events.csv") {
            EXPECT_THROW(whole.read_curve(identity), InputError);
        }
        EXPECT_EQ(run(keep).run, 1);
        ASSERT_EQ(told_.size(), 1U);
        EXPECT_EQ(told_[0], fault);
        if (changed.filename() != "summary.json") {
            EXPECT_EQ(read_file(changed), before);
        }
        EXPECT_EQ(run(keep).run, 0);
    }
}

// A test run only for its summary keeps no files, whatever files exist there.
TEST_F(KeptTestsTest, ACurveThatNoTestOfTheLedgerWroteIsNotRead) {
    write_small_plan(folder_, 1);
    run("out");
    const std::string identity = identities_of(ledger("out")).front();
    fs::create_directory(folder_ / "out/curves");
    write_text(folder_ / "out/curves" / (identity + ".csv"), "axial_strain,axial_stress\n0,9e9\n");
    EXPECT_FALSE(KeptTests(folder_ / "out", ledger("out").kept_hashes()).read_curve(identity).has_value());
    EXPECT_TRUE(KeptTests(folder_ / "out").read_curve(identity).has_value()) << "earlier versions recorded no hashes";
}

}  // namespace
}  // namespace crackle
