// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the search for combinations of keys that the targets leave undetermined, and the uncertainties of the other
// combinations.

#include "specimens/calibration/determination.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using testing::agrees;

TEST(Determination, OfAsManyTargetsAsKeysHasTheCovarianceOfTheInverse) {
    Matrix2d slopes, covariance;
    slopes << 20.0, 5.0, -3.0, 12.0;
    covariance << 0.3, 0.1, 0.1, 0.2;
    const Determination found = determine(slopes, covariance, 0.3);
    EXPECT_TRUE(found.open.empty());
    const Matrix2d of_keys = slopes.inverse() * covariance * slopes.inverse().transpose();
    for (int k = 0; k < 2; ++k)
        EXPECT_TRUE(agrees("standard error", found.standard_errors[k], std::sqrt(of_keys(k, k)), 1e-12));
}

/// Solutions for 4,000 noisy targets have the stated scatter.
TEST(Determination, StandardErrorsAreTheScatterOfSolutions) {
    MatrixXd slopes(3, 2);
    slopes << 20.0, 5.0, -3.0, 12.0, 6.0, 6.0;
    const MatrixXd covariance = Eigen::Vector3d(0.4, 0.1, 0.2).asDiagonal();
    const Determination found = determine(slopes, covariance, 0.3);
    std::mt19937_64 random(9);
    std::normal_distribution<double> draw;
    Vector2d squares = Vector2d::Zero();
    constexpr int repeats = 4000;
    const Matrix2d normal = (slopes.transpose() * slopes).inverse();
    for (int k = 0; k < repeats; ++k) {
        Eigen::Vector3d noise;
        for (int t = 0; t < 3; ++t) noise[t] = std::sqrt(covariance(t, t)) * draw(random);
        squares += (normal * slopes.transpose() * noise).cwiseAbs2();
    }
    // The relative error of a mean of 4,000 squares is 1/sqrt(2000); four standard deviations are allowed.
    for (int k = 0; k < 2; ++k)
        EXPECT_TRUE(agrees("variance", squares[k] / repeats, std::pow(found.standard_errors[k], 2.0), 0.09));
}

TEST(Determination, NamesTheCombinationThatNoTargetFeels) {
    // Both targets depend on the sum of the first two keys; the third key is determined separately.
    MatrixXd slopes(2, 3);
    slopes << 10.0, 10.0, 0.0, 0.0, 0.0, 8.0;
    const Determination found = determine(slopes, Matrix2d::Identity(), 0.3);
    ASSERT_EQ(found.open.size(), 1U);
    EXPECT_TRUE(agrees("one against the other", found.open[0].way[0], -found.open[0].way[1], 1e-12));
    EXPECT_TRUE(agrees("its length", std::abs(found.open[0].way[0]), 0.3, 1e-12));
    EXPECT_LT(found.open[0].change, 1e-12);
    EXPECT_FALSE(found.determined[0]);
    EXPECT_FALSE(found.determined[1]);
    EXPECT_TRUE(found.determined[2]);
}

TEST(Determination, NamesKeysThatMoveByATenthOfTheStep) {
    for (const auto& [part, determined] : {std::pair{0.3, false}, {0.05, true}}) {
        // The target depends only on the direction perpendicular to (1, part). Along (1, part) the first key moves by
        // the whole step, the second by `part` of it.
        MatrixXd slopes(1, 2);
        slopes << -10.0 * part, 10.0;
        const Determination found = determine(slopes, MatrixXd::Identity(1, 1), 0.3);
        ASSERT_EQ(found.open.size(), 1U);
        EXPECT_TRUE(agrees("part of the second", found.open[0].way[1] / found.open[0].way[0], part, 1e-12));
        EXPECT_FALSE(found.determined[0]);
        EXPECT_EQ(found.determined[1], determined) << part;
    }
}

TEST(Determination, StatesTheLargestChangeOfATargetAlongTheStep) {
    // Along (1, 1) the step of both keys is 0.3, so the target changes by 0.3 times the sum of both slopes.
    MatrixXd slopes(1, 2);
    slopes << 0.8, 0.8;
    const Determination found = determine(slopes, MatrixXd::Identity(1, 1), 0.3);
    ASSERT_EQ(found.open.size(), 2U);
    EXPECT_TRUE(agrees("change along the sum", std::max(found.open[0].change, found.open[1].change), 0.48, 1e-12));
    // With slightly larger slopes it is determined.
    EXPECT_EQ(determine(1.1 * slopes, MatrixXd::Identity(1, 1), 0.3).open.size(), 1U);
}

TEST(Determination, AnIntervalThatIsItsBoundsSaysNothing) {
    EXPECT_TRUE(fills(-1.0, 9.0, 0.0, 8.0)) << "beyond both";
    EXPECT_TRUE(fills(0.3, 9.0, 0.0, 8.0)) << "all except a hundredth";
    EXPECT_FALSE(fills(2.0, 9.0, 0.0, 8.0)) << "a quarter is ruled out";
    EXPECT_FALSE(fills(3.0, 5.0, 0.0, 8.0));
}

TEST(Determination, ASlopeThatIsTooFlatLeavesItsKeyOpen) {
    Matrix2d slopes = Matrix2d::Identity() * 10.0;
    slopes(1, 1) = 1.0;  // a step changes it by 0.3 of a tolerance
    const Determination found = determine(slopes, Matrix2d::Identity(), 0.3);
    ASSERT_EQ(found.open.size(), 1U);
    EXPECT_TRUE(agrees("change", found.open[0].change, 0.3, 1e-12));
    EXPECT_TRUE(found.determined[0]);
    EXPECT_FALSE(found.determined[1]);
}

}  // namespace
}  // namespace crackle
