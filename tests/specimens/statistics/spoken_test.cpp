// SPDX-License-Identifier: GPL-3.0-or-later
// Tests numbers in sentences.

#include "specimens/statistics/spoken.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace crackle {
namespace {

TEST(Spoken, OneIsNotSeveral) {
    EXPECT_EQ(counted(std::int64_t{1}, "packing"), "1 packing");
    EXPECT_EQ(counted(std::size_t{0}, "packing"), "0 packings");
    EXPECT_EQ(counted(std::size_t{12}, "test"), "12 tests");
}

TEST(Spoken, WhatLiesBelowABoundIsSeenToDoSo) {
    for (const auto& [value, text] : {std::pair(6.3246, "6.32"), {19.97, "19.97"}, {19.99996, "19.99996"}})
        EXPECT_EQ(spoken_below(value, 20.0), text);
}

TEST(Spoken, PascalsHaveTheirPrefix) {
    for (const auto& [value, text] : {std::pair(1.79e10, "17.9 GPa"),
                                      {1.2e7, "12 MPa"},
                                      {999.0, "999 Pa"},
                                      {999.96, "1 kPa"},
                                      {9.99996e5, "1 MPa"},
                                      {-2.5e6, "-2.5 MPa"},
                                      {0.0, "0 Pa"},
                                      {std::numeric_limits<double>::infinity(), "inf Pa"}})
        EXPECT_EQ(spoken_stress(value, "Pa"), text);
    EXPECT_EQ(spoken_stress(1.23456789e9, "Pa", 6), "1.23457 GPa");
    EXPECT_EQ(spoken_stress(5.1234e6, "N/m"), "5.123e+06 N/m") << "of two dimensions: no prefix";
}

}  // namespace
}  // namespace crackle
