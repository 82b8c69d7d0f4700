// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of physical claims that print the expected value, the result and the error.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace crackle::testing {

/// |got - expected| <= tolerance·|expected|; prints both values and the relative error.
inline ::testing::AssertionResult agrees(const std::string& claim, double got, double expected, double tolerance) {
    const double error = std::abs(got - expected) / std::abs(expected);
    const std::string text = fmt::format("{}: expected {:.10g}, got {:.10g}, relative error {:.3g} (tolerance {:.3g})",
                                         claim, expected, got, error, tolerance);
    fmt::print("  {}\n", text);
    if (error <= tolerance) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << text;
}

/// |got - expected| <= tolerance; prints both values and the error.
inline ::testing::AssertionResult within(const std::string& claim, double got, double expected, double tolerance) {
    const double error = std::abs(got - expected);
    const std::string text = fmt::format("{}: expected {:.10g}, got {:.10g}, error {:.3g} (tolerance {:.3g})", claim,
                                         expected, got, error, tolerance);
    fmt::print("  {}\n", text);
    if (error <= tolerance) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << text;
}

}  // namespace crackle::testing
