// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that different spellings of a path give the same path, and that a folder is refused where a file is needed.
#include "solver/files/output_path.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "solver/files/read_file.hpp"
#include "solver/files/replace_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle {
namespace {

namespace fs = std::filesystem;
using testing::refusal;

class OutputPath : public ::testing::Test {
  protected:
    OutputPath() : before_(fs::current_path()) { fs::current_path(scratch_ / ""); }
    ~OutputPath() override { fs::current_path(before_); }

    const testing::ScratchFolder scratch_;
    const fs::path before_;
};

const char* const names[] = {"x.html",         "./x.html",    "with blanks.html", "\xff\xfe not utf-8.html",
                             "new\nline.html", "-o.html",     "deep/er/x.html",   "./deep/./x",
                             ".hidden",        "caf\xc3\xa9", "deep//x.html"};

TEST_F(OutputPath, OfAFileIsWrittenWhereverItsNameIsFrom) {
    fs::create_directories("deep/er");
    for (const std::string name : names) {
        for (const fs::path& path : {fs::path(name), fs::path(scratch_ / name)}) {
            const fs::path output = output_file(path);
            replace_file(output, "page");
            EXPECT_EQ(read_file(scratch_ / name), "page") << name;
            EXPECT_TRUE(fs::is_directory(folder_of(output))) << name;
            EXPECT_TRUE(fs::equivalent(folder_of(output), (scratch_ / name).parent_path())) << name;
            fs::remove(path);
        }
    }
    EXPECT_EQ(folder_of("x.html"), ".");
}

TEST_F(OutputPath, OfAFileIsNoFoldersNorALinks) {
    fs::create_directories("folder");
    fs::create_symlink("target", "link");
    EXPECT_NE(refusal([] { output_file(""); }).find("found an empty name"), std::string::npos);
    for (const char* name : {"folder/", "absent/", ".", "..", "folder/.", "/"})
        EXPECT_NE(refusal([&] { output_file(name); }).find("found the name of a folder"), std::string::npos) << name;
    EXPECT_NE(refusal([] { output_file("folder"); }).find("found a folder"), std::string::npos);
    EXPECT_NE(refusal([] { output_file("link"); }).find("found a symbolic link"), std::string::npos);
    EXPECT_NE(refusal([] { output_file("/dev/null", true); }).find("found a device"), std::string::npos);
}

TEST_F(OutputPath, OfAFileIsReplacedByForceAloneAndNeverWhereItIsRead) {
    std::ofstream("there") << "text";
    EXPECT_NE(refusal([] { output_file("there", false); }).find("add --force"), std::string::npos);
    EXPECT_EQ(output_file("there", true), "there");
    const std::vector<fs::path> inputs{scratch_ / "there"};
    EXPECT_NE(refusal([&] { output_file("./there", true, inputs); }).find("found an input"), std::string::npos);
    EXPECT_EQ(output_file("new", false, inputs), "new");
}

TEST_F(OutputPath, OfAFolderLosesItsSlashAndKeepsItsName) {
    fs::create_directories("deep/er");
    for (const auto& [given, expected] :
         {std::pair("out", "out"), std::pair("out/", "out"), std::pair("./out", "./out"),
          std::pair("deep/er/", "deep/er"), std::pair("a b/", "a b"), std::pair("\xff/", "\xff"), std::pair("/", "/")})
        EXPECT_EQ(output_folder(given).string(), expected);
    EXPECT_EQ(output_folder("."), fs::canonical("."));
    EXPECT_EQ(output_folder("./"), fs::canonical("."));
    EXPECT_EQ(output_folder("deep/er/.."), fs::canonical("deep"));
    EXPECT_NE(refusal([] { output_folder(""); }).find("found an empty name"), std::string::npos);
    std::ofstream("file") << "text";
    EXPECT_NE(refusal([] { output_folder("file"); }).find("found a file"), std::string::npos);
}

TEST_F(OutputPath, OfAFolderIsNeverAboveAnInput) {
    fs::create_directories("case/inputs");
    fs::create_directories("cases");
    std::ofstream("case/inputs/rock.toml") << "text";
    const std::vector<fs::path> inputs{"case/inputs/rock.toml"};
    for (const fs::path& above :
         {fs::path("case/inputs"), fs::path("case"), fs::path("."), fs::path("/"), scratch_ / "", scratch_ / "case/"})
        EXPECT_NE(refusal([&] {
                      refuse_folder_of_inputs(above, inputs);
                  }).find("found the input case/inputs/rock.toml in this folder"),
                  std::string::npos)
            << above;
    for (const char* beside : {"cases", "case/inputs/out", "absent", "cas"})
        EXPECT_NO_THROW(refuse_folder_of_inputs(beside, inputs)) << beside;
    fs::create_directory_symlink("case", "by_link");
    EXPECT_NE(refusal([&] { refuse_folder_of_inputs("by_link", inputs); }).find("found the input"), std::string::npos);
}

}  // namespace
}  // namespace crackle
