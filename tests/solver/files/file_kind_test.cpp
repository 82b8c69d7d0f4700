// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that files of other programs are recognised by their first bytes, and that plain text is not.
#include "solver/files/file_kind.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "solver/files/read_file.hpp"
#include "tests/support/deck_files.hpp"
#include "tests/support/refusal.hpp"

namespace crackle::file_kind_test {
namespace {

using namespace std::string_literals;

TEST(FileKind, IsKnownByTheFirstBytes) {
    for (const auto& [bytes, kind] : {
             std::pair{R"({ "type": "FeatureCollection", "features": [] })"s, "GeoJSON"},
             {"\xef\xbb\xbf\n{\"type\":\"LineString\",\"coordinates\":[[0,1],[2,3]]}"s, "GeoJSON"},
             {R"([{"type": "Feature"}])"s, "GeoJSON"},
             {R"({"a": 1})"s, "a JSON file"},
             {"[[0.1, 0.2], [0.3, 0.4]]"s, "a JSON file"},
             {"<?xml version=\"1.0\"?>\n<svg xmlns=\"x\"><polyline/></svg>"s, "an SVG drawing"},
             {"<SVG>"s, "an SVG drawing"},
             {"<?xml version=\"1.0\"?><kml>"s, "a KML file"},
             {"<note>"s, "an XML file"},
             {"[packing]\ncount = 3\n"s, "a TOML file"},
             {"[[trace]]\n"s, "a TOML file"},
             {"PK\x03\x04rest"s, "a spreadsheet (xlsx, ods) or another zip archive"},
             {"\0\0\x27\x0a\0\0"s, "a shapefile"},
             {"SQLite format 3\0"s, "a GeoPackage or another SQLite database"},
             {"%PDF-1.7"s, "a PDF file"},
         })
        EXPECT_EQ(foreign_kind(bytes), kind) << bytes;
    for (const char* text :
         {"", " ", "0 1 2\n", "trace,x,y\n", "# a remark\n1 2\n", "0\nSECTION\n", "quartz\n", "-1 2"})
        EXPECT_EQ(foreign_kind(text), "") << text;
    EXPECT_EQ(testing::refusal([] { refuse_foreign("a.txt", "{\"Feature\"", "a list of x y"); }),
              "a.txt: found GeoJSON, expected a list of x y");
}

TEST(ReadText, NamesUtf16) {
    const testing::ScratchFolder scratch;
    for (const std::string& bytes : {"\xff\xfex\0,\0"s, "\xfe\xff\0x\0,"s, "x\0,\0"s, "\0x\0,"s}) {
        std::ofstream(scratch / "t.csv", std::ios::binary) << bytes;
        const std::string refusal = testing::refusal([&] { read_text(scratch / "t.csv"); });
        EXPECT_NE(refusal.find("t.csv: found UTF-16, expected UTF-8 or ASCII; save the text as UTF-8"),
                  std::string::npos)
            << refusal;
    }
}

}  // namespace
}  // namespace crackle::file_kind_test
