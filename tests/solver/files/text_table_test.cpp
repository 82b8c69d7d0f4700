// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that columns are always separated.

#include "solver/files/text_table.hpp"

#include <gtest/gtest.h>

namespace crackle {
namespace {

TEST(TextTable, ColumnsAreAsWideAsTheirWidestWord) {
    TextTable table("<><");
    table.add({"key", "value", "interval"});
    table.add({"material.cohesion over material.tensile_strength", "0.00021336", "0.0001789 to 0.0002544"});
    table.add({"a", "1"});
    EXPECT_EQ(table.text(),
              "  key                                                    value  interval\n"
              "  material.cohesion over material.tensile_strength  0.00021336  0.0001789 to 0.0002544\n"
              "  a                                                          1\n");
}

TEST(TextTable, CountsLettersNotBytes) {
    TextTable table("><");
    table.add({"± error", "x"});
    table.add({"1234567", "y"});
    EXPECT_EQ(table.text(), "  ± error  x\n  1234567  y\n");
}

}  // namespace
}  // namespace crackle
