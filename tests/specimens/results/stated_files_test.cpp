// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a test's summary identifies its files, and that readers accept no others.
#include "specimens/recordings/stated_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "solver/base/errors.hpp"
#include "solver/files/read_file.hpp"
#include "specimens/case/case_file.hpp"
#include "specimens/loading/run.hpp"
#include "specimens/recordings/test_results.hpp"
#include "specimens/summary/summary_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/small_rock.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::refusal;
using Json = nlohmann::ordered_json;

void expect_says(const std::string& got, const std::string& expected) {
    EXPECT_NE(got.find(expected), std::string::npos) << got;
}

/// A small tension test that records slips, completed.
class FinishedTest : public ::testing::Test {
  protected:
    FinishedTest() {
        testing::SmallCase wanted;
        wanted.output += "\nslips = true";
        const ResolvedCase test = read_case(testing::write_small_case(scratch_ / "", wanted));
        summary_ = run_test(test, options()).summary;
    }
    TestOptions options() const {
        TestOptions wanted;
        wanted.folder = folder_;
        wanted.command = "crackle test";
        return wanted;
    }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
    }
    /// Changes each of the files that are read, and checks the message.
    void expect_refused(const std::function<std::string(std::string)>& change, const std::string& says) const {
        for (const std::string name : {"curve.csv", "events.csv", "slips.csv"}) {
            const std::string text = read_file(folder_ / name);
            write(name, change(text));
            const std::string reading = refusal([&] { read_results(folder_); });
            expect_says(reading, (folder_ / name).string() + ": found ");
            expect_says(reading, says);
            expect_says(reading, fmt::format("expected the {} that the test wrote", text.size()));
            EXPECT_EQ(refusal([&] { resume_test(options()); }), reading);
            write(name, text);
        }
        EXPECT_NO_THROW(read_results(folder_));
    }

    testing::ScratchFolder scratch_;
    const fs::path folder_ = scratch_ / "out";
    Summary summary_;
};

TEST_F(FinishedTest, StatesItsFilesAsTheyAre) {
    EXPECT_EQ(json_of(summary_), Json::parse(read_file(folder_ / "summary.json")));
    const FileMarks stated = stated_files(summary_, "summary.json");
    ASSERT_EQ(stated.size(), 4U);
    for (const auto& [name, mark] : stated) {
        EXPECT_EQ(mark, mark_of(read_file(folder_ / name))) << name;
        EXPECT_EQ(mark, mark_of_file(folder_ / name)) << name;
    }
    EXPECT_TRUE(read_results(folder_).slips);
    EXPECT_TRUE(resume_test(options()).was_finished);
}

TEST_F(FinishedTest, ReadsNoFileThatWasEdited) {
    expect_refused(
        [](std::string text) {
            text.back() = ' ';  // replaces the end of the last line, which a reader of numbers would accept
            return text;
        },
        "other bytes, expected");
}

TEST_F(FinishedTest, ReadsNoFileThatWasCut) {
    expect_refused([](const std::string& text) { return text.substr(0, text.rfind('\n', text.size() - 2) + 1); },
                   "bytes, expected");
}

TEST_F(FinishedTest, ReadsNoFileWithRowsPutToIt) {
    expect_refused([](const std::string& text) { return text + text.substr(text.rfind('\n', text.size() - 2) + 1); },
                   "bytes, expected");
}

TEST_F(FinishedTest, ReadsNoFileThatIsGoneOrThatItDidNotWrite) {
    const std::string text = read_file(folder_ / "slips.csv");
    fs::remove(folder_ / "slips.csv");
    expect_says(refusal([&] { read_results(folder_); }), "slips.csv: file not found");
    write("slips.csv", text);
    Json without = json_of(summary_);
    without["files"].erase("slips.csv");
    write("summary.json", without.dump());
    expect_says(refusal([&] { read_results(folder_); }),
                "slips.csv: found a file that the test did not write (summary.json has no files.slips.csv), expected "
                "none; remove it");
}

TEST_F(FinishedTest, TakesNoOtherCheckpointForItsOwn) {
    Json other = json_of(summary_);
    other["files"]["checkpoint"]["xxh3"] = "0123456789abcdef";
    write("summary.json", other.dump());
    expect_says(refusal([&] { resume_test(options()); }), "checkpoint: found ");
    EXPECT_NO_THROW(read_results(folder_)) << "reading needs no checkpoint";
}

TEST_F(FinishedTest, OfAnEarlierVersionIsReadAsItIs) {
    Json silent = json_of(summary_);
    silent.erase("files");
    write("summary.json", silent.dump());
    write("curve.csv", read_file(folder_ / "curve.csv") + "1\n");
    expect_says(refusal([&] { read_results(folder_); }), "found 1 value");  // found by the reader of numbers
    write("curve.csv", read_file(folder_ / "curve.csv").substr(0, read_file(folder_ / "curve.csv").size() - 2));
    EXPECT_NO_THROW(read_results(folder_));
}

TEST_F(FinishedTest, WhoseSummaryStatesItsFilesWronglyIsRefused) {
    const Json good = json_of(summary_)["files"]["curve.csv"];
    const auto refused = [&](const Json& files) {
        Json wrong = json_of(summary_);
        wrong["files"] = files;
        write("summary.json", wrong.dump());
        expect_says(refusal([&] { read_results(folder_); }), "found no bytes and xxh3 of files");
    };
    for (const Json& files : {Json(nullptr), Json(3), Json::object(), Json::array({1})}) refused(files);
    for (const Json& bytes : {Json(-1), Json("1"), Json(1.5), Json(nullptr)})
        refused({{"curve.csv", {{"bytes", bytes}, {"xxh3", good["xxh3"]}}}});
    for (const Json& hash : {Json(""), Json("12g"), Json(7), Json("10000000000000000")})
        refused({{"curve.csv", {{"bytes", good["bytes"]}, {"xxh3", hash}}}});
    refused({{"../curve.csv", good}});
    refused({{"curve.csv", {{"bytes", good["bytes"]}}}});
}

}  // namespace
}  // namespace crackle
