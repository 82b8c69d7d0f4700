// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a table is read the same in the formats of many programs, and that anything else is refused with its line,
// never skipped.
#include "solver/files/table_reader.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/refusal.hpp"

namespace crackle::table_reader_test {
namespace {

using Pairs = std::vector<std::pair<double, double>>;

Pairs strain_and_stress(const std::string& text) {
    TableReader reader("t.csv", text, TableReader::Form::table);
    reader.read_heading("strain and stress");
    const auto strain = reader.column("strain"), stress = reader.column("stress");
    if (!strain || !stress) reader.refuse("another heading", "strain and stress");
    Pairs rows;
    while (reader.next()) rows.emplace_back(reader.number(*strain, "strain"), reader.number(*stress, "stress"));
    return rows;
}

std::string refused(const std::string& text) {
    return testing::refusal([&] { strain_and_stress(text); });
}

std::vector<std::vector<std::string>> lists(const std::string& text, TableReader::Form form = TableReader::Form::list) {
    TableReader reader("t.txt", text, form);
    std::vector<std::vector<std::string>> lines;
    while (reader.next()) lines.emplace_back(reader.values().begin(), reader.values().end());
    return lines;
}

TEST(TableReader, ReadsOneTableAsManyProgramsWriteIt) {
    const Pairs rows{{0.0, 0.0}, {0.001, 2000.0}, {0.002, -2800.0}};
    for (const char* text : {
             "strain,stress\n0,0\n0.001,2000\n0.002,-2800\n",
             "strain, stress\n0, 0\n0.001 , 2000\n 0.002,\t-2800",
             "strain,stress\r\n0,0\r\n0.001,2000\r\n0.002,-2800\r\n\r\n",
             "strain,stress\r0,0\r0.001,2000\r0.002,-2800\r",
             "strain,stress\n+0,+0\n+1.0E-03,+2.0E+03\n2.0d-3,-2.8D3\n",
             "\"strain\",\"stress\"\n0,0\n\"0.001\",2000\n0.002 , \"-2800\" \n",
             "strain;stress\n0;0\n0.001;2000\n0.002;-2800\n",
             "sep=;\nstrain;stress\n0;0\n0.001;2000\n0.002;-2800\n",
             "strain\tstress\n0\t0\n0.001\t2000\n0.002\t-2800\n",
             "strain stress\n0 0\n0.001    2000\n  0.002 -2800\n",
             "# laboratory 7\n\nstrain,stress\n# dry\n0,0\n\n0.001,2000\n,\n0.002,-2800\n,,,\n",
             "strain,stress,,\n0,0,,\n0.001,2000,,\n0.002,-2800,,\n",
             "stress,note,strain\n0,\"a, b\",0\n2000,\"said \"\"no\"\"\",0.001\n-2800,,0.002\n",
             "stress\tnote\tstrain\n0\t\t0\n2000\ta b\t0.001\n-2800\t\"c\td\"\t0.002\n",
         })
        EXPECT_EQ(strain_and_stress(text), rows) << text;
}

TEST(TableReader, TakesAnEmptyFirstValueForOne) {
    for (const char* text :
         {"note\tstrain\tstress\n\t1\t2\n", "note,strain,stress\n,1,2\n", "note;strain;stress\n ;1;2"})
        EXPECT_EQ(strain_and_stress(text), (Pairs{{1.0, 2.0}})) << text;
}

TEST(TableReader, NamesADecimalComma) {
    for (const char* text : {"strain;stress\n0;0\n0,001;2000\n", "strain\tstress\n0\t0\n0,001\t2000\n",
                             "strain stress\n0 0\n0,001 2000\n", "strain,stress\n0,0\n\"0,001\",2000\n"}) {
        EXPECT_EQ(refused(text),
                  "t.csv:3: found '0,001', a number with a decimal comma, expected a number for strain; save the file "
                  "with decimal points")
            << text;
    }
    EXPECT_EQ(refused("strain,stress\n0,001,2000\n"),
              "t.csv:2: found 3 values between commas, expected 2 as in the heading; a number with a decimal comma "
              "counts as two values: save the file with decimal points");
    EXPECT_EQ(lists("0,5 1,5\n"), (std::vector<std::vector<std::string>>{{"0,5", "1,5"}}));
    EXPECT_TRUE(has_decimal_comma("-0,5e-3"));
    for (const char* word : {"1", "1.5", "1,", ",5", "1,2,3", "1.000,5", "a,b"}) EXPECT_FALSE(has_decimal_comma(word));
}

TEST(TableReader, RefusesWhatCannotBeMeant) {
    EXPECT_EQ(refused("strain,stress\n0,0\n1\n"),
              "t.csv:3: found 1 value between commas, expected 2 as in the heading");
    EXPECT_EQ(refused("strain;stress\n0;0;5\n"),
              "t.csv:2: found 3 values between semicolons, expected 2 as in the heading");
    EXPECT_EQ(refused("strain,stress\n0,\n"), "t.csv:2: found '', expected a number for stress");
    EXPECT_EQ(refused("strain,stress\n0,nan\n"), "t.csv:2: found 'nan', expected a number for stress");
    EXPECT_EQ(refused("strain,stress\n0,++1\n"), "t.csv:2: found '++1', expected a number for stress");
    EXPECT_EQ(refused("strain,stress\n\"0,0\n"),
              "t.csv:2: found a quote that is not closed: \"0,0, expected a closing quote on the same line");
    EXPECT_EQ(refused("strain,stress\n\"0\"1,0\n"),
              "t.csv:2: found '1' after a value in quotes, expected nothing before the next separator; "
              "values are separated by commas");
    EXPECT_EQ(refused("strain,stress,strain\n0,0,0\n"),
              "t.csv:1: found two columns named strain, expected only one; rename or remove the other");
    EXPECT_EQ(refused(""), "t.csv:1: found no heading, expected strain and stress");
    // A row whose first value begins with # is not a comment.
    EXPECT_EQ(refused("strain,stress\n#0,0\n"), "t.csv:2: found '#0', expected a number for strain");
}

TEST(TableReader, ReadsListsOfAnyNumberOfValues) {
    const std::vector<std::vector<std::string>> lines{{"1", "2"}, {"3.5", "-4", "5"}};
    for (const char* text : {"1 2\n3.5 -4 5\n", "1,2\n3.5,-4,5\n", "1, 2\n3.5,\t-4, 5,\n", "1;2\n3.5;-4;5\n",
                             "1\t2\n\t3.5\t\t-4 5\t\n", "# a, b\n1 2 # c\n\n3.5 -4 5", "1 , 2\r\n3.5,-4 5\r\n"})
        EXPECT_EQ(lists(text), lines) << text;
}

TEST(TableReader, ReadsWordsALine) {
    EXPECT_EQ(lists("# labels\nquartz\n\n\"potassium feldspar\"\r\n mica, dark \n", TableReader::Form::words),
              (std::vector<std::vector<std::string>>{{"quartz"}, {"potassium feldspar"}, {"mica, dark"}}));
}

TEST(TextLines, ALineHasAnEnd) {
    std::string text = "a\n" + std::string(most_bytes_of_line, 'b');
    TextLines whole("t.csv", text);
    while (whole.next()) continue;
    EXPECT_EQ(whole.line(), 2);
    text += 'b';
    TextLines longer("t.csv", text);
    longer.next();
    EXPECT_EQ(
        testing::refusal([&] { longer.next(); }),
        "t.csv:2: found a line of 1000001 bytes, expected at most 1000000; save the file as text with line breaks");
}

}  // namespace
}  // namespace crackle::table_reader_test
