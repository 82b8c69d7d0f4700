// SPDX-License-Identifier: GPL-3.0-or-later
// Tests trace files: the three formats give the same traces, written values are read back exactly, and errors are
// reported with their line.

#include "specimens/joints/trace_files.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/refusal.hpp"

namespace crackle::trace_files_test {
namespace {

using testing::refusal;

const TracePoints two{{{0.0, 0.5}, {1.5, 2.0}, {2.0, 2.25}}, {{-1.0, 3.0}, {4.0, 3.5}}};

constexpr const char* dxf =
    "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1009\n  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n"
    "  0\nPOLYLINE\n  8\nfaults\n 66\n     1\n 10\n0.0\n 20\n0.0\n"
    "  0\nVERTEX\n  8\nfaults\n 10\n0.0\n 20\n0.5\n  0\nVERTEX\n 10\n1.5\n 20\n2.0\n  0\nVERTEX\n 10\n2.0\n 20\n2.25\n"
    "  0\nSEQEND\n  8\nfaults\n"
    "  0\nLINE\n  8\njoints\n 10\n-1.0\n 20\n3.0\n 30\n0.0\n 11\n4.0\n 21\n3.5\n 31\n0.0\n"
    "  0\nENDSEC\n  0\nEOF\n";

std::string refused(const std::string& name, const std::string& text, const std::string& layer = "") {
    return refusal([&] { parse_traces(name, text, layer); });
}

TEST(TraceFiles, FormsOfOneSurveyAreReadAlike) {
    EXPECT_EQ(parse_traces("a.txt", "# x1 y1 x2 y2\n0 0.5\t1.5 2 2 2.25\n\n-1 3 +4 3.5 # the other\r\n", ""), two);
    EXPECT_EQ(parse_traces("a.csv", "trace,x,y\n1,0,0.5\n1,1.5,2\n1,2,2.25\nfar,-1,3\nfar,4,3.5\n", ""), two);
    EXPECT_EQ(parse_traces("a.DXF", dxf, ""), two);
    EXPECT_EQ(parse_traces("b.csv", "set,x1,y1,x2,y2\nA,-1,3,4,3.5\n", ""), TracePoints{two[1]});
}

TEST(TraceFiles, AreReadAsOtherProgramsWriteThem) {
    for (const char* text :
         {"trace; x; y\r\n1;0;0.5\r\n1;1.5;2\r\n1;2;2.25\r\nfar;-1;3\r\nfar;4;3.5\r\n;;\r\n",
          "\"trace\"\t\"y\"\t\"z\"\t\"x\"\n1\t0.5\t\t0\n1\t2\t9\t1.5\n1\t2.25\t9\t2\nfar\t3\t9\t-1\n"
          "far\t3.5\t9\t4\n",
          "x1,y1,x2,y2,x3,y3\n0,0.5,1.5,2,2,2.25\n-1,3,+4.0E+00,3.5,,\n", dxf, "0,0.5,1.5,2,2,2.25\n-1,3,4,3.5\n"})
        EXPECT_EQ(parse_traces("a.txt", text, ""), two) << text;
    // A name may begin with #, and be quoted.
    EXPECT_EQ(parse_traces("a.csv", "trace,x,y\n#1,-1,3\n\"#1\",4,3.5\n", ""), TracePoints{two[1]});
    EXPECT_NE(
        refused("a.csv", "trace;x;y\n1;0;0\n1;0,5;1\n").find("a.csv:3: found '0,5', a number with a decimal comma"),
        std::string::npos);
    EXPECT_NE(refused("a.txt", "0,5 1,5 2,5 3,5\n").find("a.txt:1: found '0,5', a number with a decimal comma"),
              std::string::npos);
}

TEST(TraceFiles, HeightsAreNamed) {
    const auto named = [](const std::string& text) { return refused("a.txt", text).find("found x y z of each point"); };
    EXPECT_EQ(
        refused("a.txt", "0.2 0.3 101.1 1.8 1.5 101.4\n"),
        "a.txt:1: found x y z of each point, expected x y; remove every third number. If the numbers are x y, state "
        "this in a first line '# x1 y1 x2 y2'");
    EXPECT_NE(named("0.2 0.3 0 1.8 1.5 0\n0.1 1.7 0 0.9 0.2 0\n"), std::string::npos) << "one height";
    EXPECT_NE(named("# x y z\n0 0 0 1 1 1 2 2 2\n"), std::string::npos);
    EXPECT_NE(named("512000.2 4170000.3 801 512001.8 4170001.5 802.4\n"), std::string::npos);
    EXPECT_NE(refused("a.txt", "0 0 1 1 1 1 2 2 2\n")
                  .find("found 9 numbers, expected x and y of two points or more; if "
                        "these are x y z, remove every third number"),
              std::string::npos);
    // Lines with three points x y: straight, bent, along the diagonal, and across the middle.
    for (const char* text : {"0 0.5 1.5 2 2 2.25\n", "0 0 1 1 2 2\n", "-1 1 0 0.1 1 -1.2\n", "3 7 3.2 7.4 3.1 7.9\n",
                             "# x1 y1 x2 y2\n0.2 0.3 101.1 1.8 1.5 101.4\n"})
        EXPECT_EQ(parse_traces("a.txt", text, "").front().size(), 3U) << text;
    EXPECT_EQ(parse_traces("a.txt", "# x1 y1 x2 y2 in m, section at z = 12\n0.1 0.2 0.9 0.8\n", "").front().size(), 2U)
        << "a comment with a section height";
}

TEST(TraceFiles, OtherKindsOfFileAreNamed) {
    for (const auto& [text, kind] : {std::pair{R"({ "type": "FeatureCollection", "features": [] })", "GeoJSON"},
                                     {"<svg><path d='M0 0'/></svg>", "an SVG drawing"}})
        EXPECT_EQ(refused("a.csv", text), std::string("a.csv: found ") + kind +
                                              ", expected CSV (trace,x,y or x1,y1,x2,y2), DXF, or x1 y1 x2 y2 ... with "
                                              "one trace per line; export the file in one of these formats");
}

TEST(TraceFiles, ALayerIsReadAlone) {
    EXPECT_EQ(parse_traces("a.dxf", dxf, "joints"), TracePoints{two[1]});
    EXPECT_EQ(parse_traces("a.dxf", dxf, "faults"), TracePoints{two[0]});
    EXPECT_NE(refused("a.dxf", dxf, "bedding").find("found no trace on layer bedding"), std::string::npos);
    EXPECT_NE(refused("a.txt", "0 0 1 1\n", "bedding").find("only a DXF file has layers"), std::string::npos);
}

TEST(TraceFiles, OtherEntitiesAreRefusedUnlessTheyLieOnOtherLayers) {
    std::string text = dxf;
    text.insert(text.find("  0\nLINE"), "  0\nCIRCLE\n  8\nholes\n 10\n1\n 20\n1\n 40\n2\n");
    EXPECT_NE(refused("a.dxf", text).find("found CIRCLE on layer holes"), std::string::npos);
    EXPECT_EQ(parse_traces("a.dxf", text, "joints"), TracePoints{two[1]});
    std::string arcs = dxf;
    arcs.insert(arcs.find("  0\nVERTEX\n 10\n1.5"), " 42\n0.5\n");
    EXPECT_NE(refused("a.dxf", arcs).find("found a POLYLINE with arcs"), std::string::npos);
}

TEST(TraceFiles, ClosedPolylinesEndWhereTheyBegin) {
    const std::string text =
        "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n3\n70\n1\n10\n0\n20\n0\n10\n1\n20\n0\n10\n0\n20\n1\n0\nENDSE"
        "C\n0\nEOF\n";
    EXPECT_EQ(parse_traces("a.dxf", text, ""), (TracePoints{{{0, 0}, {1, 0}, {0, 1}, {0, 0}}}));
}

TEST(TraceFiles, WhatIsWrittenIsReadAgain) {
    const TracePoints traces{{{0.1, 1.0 / 3.0}, {1e-17, 2e20}}, {{0.7, 0.7}, {0.30000000000000004, 5.0}, {6.0, -7.0}}};
    EXPECT_EQ(parse_traces("a.txt", traces_text(traces), ""), traces);
}

TEST(TraceFiles, WhatIsWrongIsNamedWithItsLine) {
    EXPECT_NE(refused("a.txt", "0 0 1 1\n0 0 1\n").find("a.txt:2: found 3 numbers"), std::string::npos);
    EXPECT_NE(refused("a.txt", "0 0 1 x\n").find("a.txt:1: found 'x'"), std::string::npos);
    EXPECT_NE(refused("a.txt", "0 0 1 inf\n").find("a.txt:1: found 'inf'"), std::string::npos);
    EXPECT_NE(refused("a.txt", "0 0 1 1e200\n")
                  .find("found '1e200', expected a number for y that is 0 or has a magnitude from 1e-30"),
              std::string::npos);
    EXPECT_NE(refused("a.txt", "1 2 1 2\n").find("a.txt:1: found only traces whose points coincide"),
              std::string::npos);
    EXPECT_NE(refused("a.txt", "# nothing\n").find("found no trace"), std::string::npos);
    EXPECT_NE(refused("a.csv", "x,y\n").find("a.csv:1: found 'x,y', expected a heading"), std::string::npos);
    EXPECT_NE(refused("a.csv", "").find("no heading"), std::string::npos);
    EXPECT_NE(refused("a.csv", "trace,x,y\n1,0,0\n1,1\n").find("a.csv:3: found 2 values between commas"),
              std::string::npos);
    EXPECT_NE(refused("a.csv", "trace,x,y\n1,0,0\n1,1,1\n2,0,0\n2,1,1\n1,5,5\n")
                  .find("a.csv:6: found points of trace 1 after those of another"),
              std::string::npos);
    EXPECT_NE(refused("a.csv", "trace,x,y\n1,0,0\n2,1,1\n").find("a.csv:2: found only traces whose points coincide"),
              std::string::npos);
    EXPECT_NE(refused("a.dxf", "hello\n").find("a.dxf:1: found 'hello', expected a group code"), std::string::npos);
    EXPECT_NE(refused("a.dxf", "0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nEOF\n").find("no ENTITIES section"),
              std::string::npos);
    EXPECT_NE(refused("a.dxf", std::string(dxf).substr(0, 300)).find("expected"), std::string::npos);
    EXPECT_NE(refused("a.dxf", "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nabc\n").find("a.dxf:8: found 'abc'"),
              std::string::npos);
}

TEST(TraceFiles, RowsWithoutLengthArePassedOverAndSaidSo) {
    for (const auto& [name, text] : {std::pair{"a.txt", "0 0 1 1\n2 2 2 2\n# remark\n3 3 3 3 3 3\n4 4 5 5\n"},
                                     {"a.csv", "x1,y1,x2,y2\n0,0,1,1\n2,2,2,2\n\n3,3,3,3\n4,4,5,5\n"}}) {
        TraceRows rows;
        EXPECT_EQ(parse_traces(name, text, "", &rows), (TracePoints{{{0, 0}, {1, 1}}, {{4, 4}, {5, 5}}})) << name;
        const int heading = std::string(name) == "a.csv" ? 1 : 0;
        EXPECT_EQ(rows.lines, (std::vector<int>{1 + heading, 5 + heading})) << name;
        EXPECT_EQ(rows.without_length, (std::vector<int>{2 + heading, 4 + heading})) << name;
    }
}

TEST(TraceFiles, EveryBeginningOfADrawingIsReadOrRefused) {
    const std::string whole = dxf;
    std::size_t read = 0;
    for (std::size_t length = 0; length < whole.size(); ++length) {
        try {
            parse_traces("a.dxf", whole.substr(0, length), "");
            ++read;
        } catch (const InputError&) {
        }
    }
    EXPECT_LT(read, 12U);  // only those complete up to ENDSEC
}

}  // namespace
}  // namespace crackle::trace_files_test
