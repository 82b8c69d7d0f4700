// SPDX-License-Identifier: GPL-3.0-or-later
// The band of several curves, by hand.

#include "tools/plot/campaign_panels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace crackle::plot {
namespace {

TEST(Band, IsTheMedianAndTheMiddleOfStraightLines) {
    CurveBundle bundle;
    for (int slope = 1; slope <= 11; ++slope) bundle.curves.push_back({{0.0, 0.0}, {1.0, slope}});
    const Band band = band_of(bundle, 0.1, 11);
    ASSERT_EQ(band.strain.size(), 11U);
    for (std::size_t k = 0; k < band.strain.size(); ++k) {
        EXPECT_NEAR(band.median[k], 6.0 * band.strain[k], 1e-12);
        EXPECT_NEAR(band.low[k], 2.0 * band.strain[k], 1e-12) << "a tenth of eleven lies below";
        EXPECT_NEAR(band.high[k], 10.0 * band.strain[k], 1e-12);
    }
}

TEST(Band, EndsWhereFewerThanHalfOfTheCurvesGoOn) {
    CurveBundle bundle;
    for (const double end : {1.0, 2.0, 3.0, 4.0, 5.0}) bundle.curves.push_back({{0.0, 1.0}, {end, 1.0}});
    bundle.curves.emplace_back();  // a test without rows
    EXPECT_EQ(band_of(bundle).strain.back(), 3.0);
    EXPECT_EQ(band_of(bundle).median.back(), 1.0);
    EXPECT_TRUE(band_of(CurveBundle{}).strain.empty());
}

TEST(Band, InterpolatesBetweenRows) {
    CurveBundle bundle;
    bundle.curves = {{{0.0, 0.0}, {0.1, 1.0}, {1.0, 10.0}}};
    const Band band = band_of(bundle, 0.1, 5);
    EXPECT_NEAR(band.median[1], 2.5, 1e-12);
    EXPECT_EQ(band.low[1], band.high[1]);
}

}  // namespace
}  // namespace crackle::plot
