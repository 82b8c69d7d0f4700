// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that a grid finds the same as a search of all items.

#include "mesher/place_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/mesher/centres.hpp"

namespace crackle {
namespace {

TEST(PlaceGrids, FindWhatIsNear) {
    const Rectangle box{-3.0, 2.0, 1.0, 4.0};
    const auto places = testing::random_seeds(500, box, 3), asked = testing::random_seeds(200, box, 4);
    PlaceGrid grid(0.2);
    for (const Point p : places) grid.add(p);
    for (const Point p : asked) {
        const auto nearest = std::min_element(places.begin(), places.end(),
                                              [&](Point a, Point b) { return distance(a, p) < distance(b, p); });
        EXPECT_EQ(grid.nearest(p), nearest - places.begin());
        EXPECT_EQ(grid.any_within(p, 0.1), distance(*nearest, p) < 0.1);
    }
    PlaceGrid one(0.01);
    one.add({0.0, 0.0});
    EXPECT_EQ(one.nearest({0.9, -0.7}), 0);
}

TEST(PlaceGrids, FindSegmentsWithinTheirReach) {
    const Rectangle box{-3.0, 2.0, 1.0, 4.0};
    const auto ends = testing::random_seeds(200, box, 5), asked = testing::random_seeds(300, box, 6);
    std::vector<Segment> segments{{{-1.0, 1.0}, {-1.0, 3.0}}, {{-2.0, 2.0}, {1.0, 2.0}}};
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2) segments.push_back({ends[k], ends[k + 1]});
    const SegmentGrid grid(segments, 0.15);
    for (const Point p : asked) {
        std::set<std::size_t> found;
        grid.each_near(p, [&](std::size_t k) { found.insert(k); });
        for (std::size_t k = 0; k < segments.size(); ++k)
            EXPECT_TRUE(distance_to(segments[k], p) > 0.15 || found.contains(k)) << k;
        EXPECT_LT(found.size(), segments.size());
    }
}

}  // namespace
}  // namespace crackle
