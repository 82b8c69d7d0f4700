// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the guide's repose example with the script for users: 582 circles are generated, settle and, once released,
// form a stable slope.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "tests/support/claim.hpp"
#include "tests/support/deck_files.hpp"

namespace crackle {
namespace {

using namespace testing;

/// Heights of the surface of the heap, in strips of width 8 between the left wall and the toe.
std::map<int, double> surface(const DeckFrame& frame) {
    std::map<int, double> heights;
    for (const auto& row : frame.rows) {
        if (row[0] == 583.0 || row[2] > 80.0 || row[3] < 0.0) continue;
        double& height = heights[static_cast<int>(row[2] / 8.0)];
        height = std::max(height, row[3] + row[1]);
    }
    return heights;
}

TEST(GuideRepose, AStableSlopeForms) {
    const ScratchFolder scratch;
    const std::string script = (shipped_deck("repose") / "run_stages").string();
    const std::string out = (scratch / "out").string();
    ASSERT_EQ(std::system(fmt::format("'{}' '{}' '{}'", script, CRACKLE_PROGRAM, out).c_str()), 0);
    // After the guide's five seconds, single circles still roll down in two of three packings; in which ones depends on
    // the last bits. After five more seconds the slope is at rest.
    const std::string at_rest = (scratch / "at_rest").string();
    ASSERT_EQ(std::system(
                  fmt::format("'{}' run -q '{}/slope' --continue --steps 100000 -o '{}'", CRACKLE_PROGRAM, out, at_rest)
                      .c_str()),
              0);
    const auto flow = read_frames(scratch / "out/slope/output.dat"), rest = read_frames(scratch / "at_rest/output.dat");
    EXPECT_EQ(flow.front().step, 12000.0);
    EXPECT_EQ(flow.back().step, 112000.0);
    EXPECT_EQ(rest.back().step, 212000.0);
    EXPECT_EQ(rest.back().rows.size(), 584u) << "582 circles and the two segments of body 583";
    const auto start = surface(flow.front()), late = surface(rest[rest.size() - 11]), end = surface(rest.back());
    ASSERT_EQ(end.size(), 10u);
    const double angle = std::atan2(end.at(0) - end.at(9), 72.0) * 180.0 / std::numbers::pi;
    fmt::print("  slope after 10 s: {:.1f} degrees, from {:.1f} at the wall to {:.1f} at the toe\n", angle, end.at(0),
               end.at(9));
    EXPECT_LT(std::abs(start.at(0) - start.at(8)), 10.0) << "flat at first";
    // Circles roll, so the slope is flatter than the friction angle of 27 degrees, but it is clearly not flat.
    EXPECT_GT(angle, 10.0);
    EXPECT_LT(angle, 27.0);
    double change = 0.0;
    for (const auto& [strip, height] : end) change += std::abs(height - late.at(strip)) / 10.0;
    EXPECT_TRUE(within("mean change of the surface in the last half second", change, 0.0, 0.1));
}

}  // namespace
}  // namespace crackle
