// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the shipped rock with the guide's contact law, bonded but not loaded, against the values stated in the guide.
// There is only one packing; ratios vary between packings.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "specimens/case/case_file.hpp"
#include "specimens/loading/prepare.hpp"
#include "specimens/loading/virtual_test.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using testing::agrees;

VirtualTest bonded(const std::string& specimen, SegmentLaw law) {
    ResolvedCase test =
        read_case(std::filesystem::path(CRACKLE_SOURCE_DIR) / "specimens/guide_rock" / (specimen + "_tension.toml"));
    test.numerics.contact_law = law;
    return prepare_test(test);
}

TEST(GuideRock, UnderItsOwnLawHasTheGuidesContactsAndItsBackTensionBetweenSumAndMean) {
    const VirtualTest circles = bonded("circles", SegmentLaw::demseg), sum = bonded("delaunay", SegmentLaw::demseg),
                      mean = bonded("delaunay", SegmentLaw::demseg_mean);
    const auto contacts = [](const VirtualTest& test) {
        return static_cast<double>(test.setup.bonds.contacts_initial);
    };
    const double back_tension = 753.0;  // N, value in the guide
    fmt::print(
        "  mean back-tension a pair of elements: sum {:.4g} N, mean {:.4g} N, the guide {:.4g} N\n"
        "  stiffness over the circles': sum {:.3g}, mean {:.3g}, the guide sqrt(10)\n",
        sum.setup.bonds.mean_back_tension, mean.setup.bonds.mean_back_tension, back_tension,
        sum.state.youngs_modulus / circles.state.youngs_modulus,
        mean.state.youngs_modulus / circles.state.youngs_modulus);
    EXPECT_TRUE(
        agrees("contacts over the circles', the guide's about 10", contacts(sum) / contacts(circles), 10.0, 0.15));
    EXPECT_EQ(contacts(mean), contacts(sum));
    // An independent estimate for such a specimen gave 1.2 kN and 0.58 kN.
    EXPECT_TRUE(agrees("back-tension, sum, N", sum.setup.bonds.mean_back_tension, 1200.0, 0.05));
    EXPECT_TRUE(agrees("back-tension, mean, N", mean.setup.bonds.mean_back_tension, 580.0, 0.05));
    EXPECT_GT(sum.setup.bonds.mean_back_tension, back_tension);
    EXPECT_LT(mean.setup.bonds.mean_back_tension, back_tension);
    EXPECT_GT(sum.state.youngs_modulus, std::sqrt(10.0) * circles.state.youngs_modulus);
    EXPECT_LT(mean.state.youngs_modulus, std::sqrt(10.0) * circles.state.youngs_modulus);
}

}  // namespace
}  // namespace crackle
