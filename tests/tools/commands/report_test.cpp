// SPDX-License-Identifier: GPL-3.0-or-later
// Tests `crackle report` as called by a user: what it writes, refuses and leaves unchanged.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/sample_results.hpp"

namespace {

namespace fs = std::filesystem;
using crackle::testing::SampleTest;
using crackle::testing::write_sample_results;

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void replace_in(const fs::path& file, const std::string& old_text, const std::string& new_text) {
    std::string text = text_of(file);
    const std::size_t at = text.find(old_text);
    ASSERT_NE(at, std::string::npos) << file << " should hold " << old_text;
    std::ofstream(file, std::ios::binary) << text.replace(at, old_text.size(), new_text);
}

struct Outcome {
    int code = -1;
    std::string output;  // stdout and stderr
};

class Report : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        root = fs::temp_directory_path() /
               ("crackle-report-" + std::string(info->name()) + "-" + std::to_string(::getpid()));
        fs::remove_all(root);
        write_sample_results(root / "test", SampleTest{});
    }
    void TearDown() override { fs::remove_all(root); }

    Outcome run(const std::string& arguments) const {
        const fs::path log = root / "log";
        const std::string command = "cd '" + root.string() + "' && '" CRACKLE_PROGRAM "' report " + arguments + " > '" +
                                    log.string() + "' 2>&1";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(log)};
    }

    /// Expects exit code 2, one line with every given text, and no page.
    void expect_refused(const std::string& arguments, const std::vector<std::string>& texts) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 2) << outcome.output;
        for (const std::string& text : texts)
            EXPECT_NE(outcome.output.find(text), std::string::npos)
                << "expected '" << text << "' in: " << outcome.output;
        EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
        EXPECT_FALSE(fs::exists(root / "page.html"));
    }

    fs::path root;
};

nlohmann::json data_of(const fs::path& page) {
    const std::string text = text_of(page), opening = R"(<script type="application/json" id="crackle-data">)";
    const std::size_t begin = text.find(opening) + opening.size();
    return nlohmann::json::parse(text.substr(begin, text.find("</script>", begin) - begin));
}

TEST_F(Report, OfOneTestLiesInItsFolderAndCarriesItsTitleAndSummary) {
    const Outcome outcome = run("test");
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    EXPECT_EQ(outcome.output, "test/report.html\n");
    const nlohmann::json data = data_of(root / "test" / "report.html");
    EXPECT_EQ(data["title"], "Sample test");
    ASSERT_EQ(data["tests"].size(), 1U);
    EXPECT_EQ(data["tests"][0]["name"], "test");
    EXPECT_EQ(data["tests"][0]["summary"], nlohmann::json::parse(text_of(root / "test" / "summary.json")));
    EXPECT_EQ(data["tests"][0]["arrays"]["curve.axial_stress"]["length"], 601);
    ASSERT_EQ(data["tests"][0]["frames"].size(), 3U);
    EXPECT_EQ(data["tests"][0]["frames"][1]["roles"], nlohmann::json({"peak"}));
    EXPECT_DOUBLE_EQ(data["tests"][0]["frames"][1]["axial_strain"], 1.0e-3);
}

TEST_F(Report, OfSeveralTestsKeepsTheirOrder) {
    SampleTest tension;
    tension.kind = "tension";
    write_sample_results(root / "another", tension);
    ASSERT_EQ(run("test another/ -o page.html --title 'Two of them'").code, 0);
    const nlohmann::json data = data_of(root / "page.html");
    EXPECT_EQ(data["title"], "Two of them");
    EXPECT_EQ(data["tests"][0]["name"], "test");
    EXPECT_EQ(data["tests"][1]["name"], "another");
}

TEST_F(Report, HasTheSameBytesForTheSameResults) {
    ASSERT_EQ(run("test -o page.html").code, 0);
    const std::string first = text_of(root / "page.html");
    ASSERT_EQ(run("test -o page.html").code, 0);
    EXPECT_EQ(text_of(root / "page.html"), first);
}

TEST_F(Report, KeepsMarkupInTitlesInsideItsData) {
    SampleTest test;
    test.title = "</script><script>alert(1)</script><!--";
    write_sample_results(root / "test", test);
    ASSERT_EQ(run("test -o page.html").code, 0);
    EXPECT_EQ(text_of(root / "page.html").find("alert(1)</script>"), std::string::npos);
    EXPECT_EQ(data_of(root / "page.html")["title"], test.title);
}

TEST_F(Report, OfATestWithoutFramesStillShowsItsCurve) {
    for (const char* role : {"start", "peak", "end"})
        replace_in(root / "test" / "summary.json", std::string("\"frame_") + role, std::string("\"no_frame_") + role);
    fs::remove_all(root / "test" / "frames");
    ASSERT_EQ(run("test -o page.html").code, 0);
    EXPECT_TRUE(data_of(root / "page.html")["tests"][0]["frames"].empty());
}

TEST_F(Report, CarriesAMeasuredCurveInTheUnitsOfItsTests) {
    std::ofstream(root / "lab.csv") << "axial_strain (%),axial_stress (kPa)\n0,0\n0.1,4.5\n";
    ASSERT_EQ(run("test -o page.html --measured lab.csv").code, 0);
    const nlohmann::json measured = data_of(root / "page.html")["measured"];
    EXPECT_EQ(measured["label"], "measured (lab.csv)");
    EXPECT_EQ(measured["strain"], nlohmann::json({0.0, 0.001}));
    EXPECT_EQ(measured["stress"], nlohmann::json({0.0, 4500.0}));
    fs::remove(root / "page.html");
    SampleTest tension;
    tension.kind = "tension";
    write_sample_results(root / "pulled", tension);
    expect_refused("test pulled -o page.html --measured lab.csv", {"lab.csv", "compression and tension"});
}

TEST_F(Report, RefusesAFolderThatIsNotThere) {
    expect_refused("nowhere -o page.html", {"nowhere: found no such folder", "crackle test"});
}

TEST_F(Report, RefusesAFolderWithoutResults) {
    fs::create_directories(root / "empty");
    expect_refused("empty -o page.html", {"empty/summary.json: file not found", "crackle test"});
}

TEST_F(Report, RefusesNoFolderAtAll) { expect_refused("-o page.html", {"expected at least one"}); }

TEST_F(Report, RefusesAnUnknownOption) { expect_refused("test --colour red -o page.html", {"--colour"}); }

TEST_F(Report, NamesFileLineAndColumnOfABadNumber) {
    replace_in(root / "test" / "curve.csv", "\n0,0,0,", "\n0,zero,0,");
    expect_refused("test -o page.html", {"test/curve.csv:2: found 'zero', expected a number or nan for axial_stress"});
}

TEST_F(Report, NamesFileLineAndColumnOfAnInfiniteNumber) {
    replace_in(root / "test" / "curve.csv", "\n0,0,0,", "\n0,inf,0,");
    expect_refused("test -o page.html", {"test/curve.csv:2: found 'inf', expected a number or nan for axial_stress"});
}

TEST_F(Report, OfTablesThatBeginWithAByteOrderMark) {
    const std::string text = text_of(root / "test" / "curve.csv");
    std::ofstream(root / "test" / "curve.csv", std::ios::binary) << "\xef\xbb\xbf" << text;
    EXPECT_EQ(run("test -o page.html").code, 0);
}

TEST_F(Report, RefusesASummaryOfManyLevels) {
    std::ofstream(root / "test" / "summary.json")
        << "{\"kind\": " << std::string(200'000, '[') << std::string(200'000, ']') << "}";
    expect_refused("test -o page.html", {"test/summary.json: found more than 100 nested brackets"});
}

TEST_F(Report, NamesTheLineOfATruncatedRow) {
    const std::string text = text_of(root / "test" / "curve.csv");
    std::ofstream(root / "test" / "curve.csv", std::ios::binary) << text.substr(0, text.rfind(','));
    expect_refused("test -o page.html", {"test/curve.csv:602: found 16 values between commas, expected 17"});
}

TEST_F(Report, NamesAMissingColumn) {
    replace_in(root / "test" / "events.csv", "last_of_interface", "last");
    expect_refused("test -o page.html", {"test/events.csv:1: found no column 'last_of_interface'"});
}

TEST_F(Report, NamesAnUnknownMode) {
    replace_in(root / "test" / "events.csv", ",shear,1\n", ",torn,1\n");
    expect_refused("test -o page.html", {"events.csv:", "mode: found 'torn', expected one of: tension, shear"});
}

TEST_F(Report, NamesABodyThatIsNoWholeNumber) {
    replace_in(root / "test" / "events.csv", ",1\n", ",nan\n");
    expect_refused("test -o page.html", {"events.csv:2: last_of_interface: found nan, expected a whole number"});
}

TEST_F(Report, NamesBrokenJson) {
    replace_in(root / "test" / "summary.json", "\"kind\":", "\"kind\" ");
    expect_refused("test -o page.html", {"test/summary.json: found malformed JSON at byte"});
}

TEST_F(Report, NamesANumberThatNoDoubleHolds) {
    replace_in(root / "test" / "summary.json", "\"kind\":", "\"steps\": 1e400, \"kind\":");
    expect_refused("test -o page.html", {"test/summary.json: found a number beyond 1.8e308"});
}

TEST_F(Report, NamesUnitsThatAreNoWord) {
    replace_in(root / "test" / "summary.json", "\"kind\":", "\"material_units\": 3, \"kind\":");
    expect_refused("test -o page.html", {"material_units: found 3, expected \"point\" or \"area\""});
}

TEST_F(Report, NamesAnImpossibleKind) {
    replace_in(root / "test" / "summary.json", "\"compression\"", "3");
    expect_refused("test -o page.html",
                   {"test/summary.json: kind: found 3, expected a kind of test, such as \"compression\""});
}

TEST_F(Report, RefusesResultsThatAreHalfReplaced) {
    fs::create_directories(root / "test.new");
    std::ofstream(root / "test.new/replaces-older-results") << "";  // a test with --force that is still running
    EXPECT_EQ(run("test -o first.html").code, 0);
    std::ofstream(root / "test.new/replaces-older-results") << "complete, being moved\nparticles_00000.vtp\n";
    for (const char* name : {"test", "test/"})
        expect_refused(name + std::string(" -o page.html"), {"results of two tests", "crackle test --resume test"});
}

TEST_F(Report, NamesAFrameThatIsMissing) {
    fs::remove(root / "test" / "frames" / "particles_00400.vtp");
    expect_refused("test -o page.html", {"particles_00400.vtp: file not found"});
}

TEST_F(Report, NamesADamagedFrame) {
    const fs::path file = root / "test" / "frames" / "particles_00400.vtp";
    const std::string text = text_of(file);
    std::ofstream(file, std::ios::binary) << text.substr(0, text.size() / 2);
    expect_refused("test -o page.html", {"particles_00400.vtp: found malformed XML"});
}

TEST_F(Report, LeavesAFileThatIsNotAReportAlone) {
    const std::string before = text_of(root / "test" / "curve.csv");
    const Outcome outcome = run("test -o test/curve.csv");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.output.find("not a page written by crackle"), std::string::npos) << outcome.output;
    EXPECT_EQ(text_of(root / "test" / "curve.csv"), before);
}

TEST_F(Report, SaysWhereItCannotWrite) {
    expect_refused("test -o no/such/folder/page.html", {"no/such/folder/page.html: cannot be written"});
}

}  // namespace
