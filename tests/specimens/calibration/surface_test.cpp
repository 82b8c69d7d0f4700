// SPDX-License-Identifier: GPL-3.0-or-later
// Tests surfaces fitted to points of known functions, and least squares within bounds.

#include "specimens/calibration/surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "specimens/calibration/box_minimum.hpp"
#include "specimens/calibration/surface_search.hpp"
#include "tests/support/claim.hpp"

namespace crackle {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::agrees;

const double unknown = std::numeric_limits<double>::quiet_NaN();

MatrixXd points_of(Eigen::Index count, double width = 0.3) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> draw(-width, width);
    MatrixXd points(2, count);
    for (Eigen::Index k = 0; k < count; ++k) points.col(k) = Vector2d(1.0 + draw(random), -2.0 + draw(random));
    return points;
}

template <class Function>
VectorXd values_of(const MatrixXd& points, const Function& function) {
    VectorXd values(points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k) values[k] = function(points(0, k), points(1, k));
    return values;
}

TEST(Surface, GivesBackALinearFunction) {
    const MatrixXd points = points_of(5);
    const Surface surface(Vector2d(1.0, -2.0), points,
                          values_of(points, [](double x, double y) { return 3.0 + 0.5 * x - 2.0 * y; }),
                          VectorXd::Constant(2, unknown));
    EXPECT_FALSE(surface.quadratic()) << "five points cannot determine six terms";
    const Vector2d far(1.7, -1.0);
    EXPECT_TRUE(agrees("value", surface.value(far), 3.0 + 0.85 + 2.0, 1e-12));
    EXPECT_TRUE(agrees("slope", surface.gradient(far)[1], -2.0, 1e-12));
    EXPECT_LT(surface.left_out_error(), 1e-12) << "no scatter";
}

TEST(Surface, TakesSquaresWhereThePointsPayForThem) {
    const auto square = [](double x, double y) { return 1.0 + x * x - 0.7 * x * y + y; };
    const MatrixXd points = points_of(12);
    const Surface surface(Vector2d(1.0, -2.0), points, values_of(points, square), VectorXd::Constant(2, unknown));
    EXPECT_TRUE(surface.quadratic());
    const Vector2d at(1.2, -2.2);
    EXPECT_TRUE(agrees("value", surface.value(at), square(1.2, -2.2), 1e-11));
    EXPECT_TRUE(agrees("slope in x", surface.gradient(at)[0], 2.0 * 1.2 - 0.7 * -2.2, 1e-10));
    EXPECT_TRUE(agrees("slope in y", surface.gradient(at)[1], -0.7 * 1.2 + 1.0, 1e-10));
}

TEST(Surface, StaysLinearWhereSquaresWouldFitNoise) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> noise(0.0, 0.1);
    const MatrixXd points = points_of(9);
    const VectorXd values = values_of(points, [&](double x, double y) { return x + y + noise(random); });
    const Surface surface(Vector2d(1.0, -2.0), points, values, VectorXd::Constant(2, unknown));
    EXPECT_FALSE(surface.quadratic()) << "left-out error " << surface.left_out_error();
}

TEST(Surface, KnownSlopesAreTakenAsTheyAre) {
    const MatrixXd points = points_of(4);
    VectorXd slopes(2);
    slopes << 1.0, unknown;
    const Surface surface(Vector2d(1.0, -2.0), points,
                          values_of(points, [](double x, double y) { return x + 4.0 * y; }), slopes);
    EXPECT_EQ(surface.gradient(Vector2d(0.0, 0.0))[0], 1.0);
    EXPECT_TRUE(agrees("other slope", surface.gradient(Vector2d(0.0, 0.0))[1], 4.0, 1e-12));
    EXPECT_TRUE(agrees("far along the known one", surface.value(Vector2d(9.0, -2.0)), 9.0 - 8.0, 1e-11));
}

TEST(Surface, TooFewPointsAreRefused) {
    const MatrixXd points = points_of(2);
    EXPECT_THROW(Surface(Vector2d::Zero(), points, VectorXd::Zero(2), VectorXd::Constant(2, unknown)),
                 std::invalid_argument);
    MatrixXd line(2, 4);
    line << 0, 1, 2, 3, 0, 1, 2, 3;
    EXPECT_THROW(Surface(Vector2d::Zero(), line, VectorXd::Zero(4), VectorXd::Constant(2, unknown)),
                 std::invalid_argument)
        << "the points lie on a line";
}

TEST(CompleteRows, AreThoseOfPackingsThatHaveAllFigures) {
    MatrixXd figures(5, 2);
    figures << 1.0, 2.0, 3.0, unknown, unknown, 4.0, -5.0, 6.0, 7.0, 8.0;
    const MatrixXd kept = complete_rows(figures);
    ASSERT_EQ(kept.rows(), 2);
    EXPECT_EQ(kept(0, 1), 2.0);
    EXPECT_EQ(kept(1, 0), 7.0);
}

TEST(CompleteRows, AreEnoughWhereHalfOfThePackingsAndThreeHaveAll) {
    EXPECT_TRUE(are_enough(5, 10));
    EXPECT_FALSE(are_enough(4, 10));
    EXPECT_TRUE(are_enough(3, 4));
    EXPECT_FALSE(are_enough(2, 4)) << "two values give no usable scatter";
}

/// r = (x + 2y − 4, x − y) has its minimum at (4/3, 4/3).
const Residuals two_lines = [](const VectorXd& x, VectorXd& r, MatrixXd& jacobian) {
    r = Vector2d(x[0] + 2.0 * x[1] - 4.0, x[0] - x[1]);
    jacobian.resize(2, 2);
    jacobian << 1.0, 2.0, 1.0, -1.0;
};

TEST(BoxMinimum, IsWhereTheResidualsVanishOrOnTheBound) {
    const VectorXd inside = box_minimum(two_lines, Vector2d(0.1, 0.2), Vector2d(-9, -9), Vector2d(9, 9));
    EXPECT_TRUE(agrees("x inside", inside[0], 4.0 / 3.0, 1e-7));
    EXPECT_TRUE(agrees("y inside", inside[1], 4.0 / 3.0, 1e-7));
    // For y ≤ 1, the least squares in x are at (2 + 1)/2.
    const VectorXd bound = box_minimum(two_lines, Vector2d(0.1, 0.2), Vector2d(-9, -9), Vector2d(9, 1));
    EXPECT_TRUE(agrees("x on the bound", bound[0], 1.5, 1e-7));
    EXPECT_TRUE(agrees("y on the bound", bound[1], 1.0, 1e-7));
}

TEST(BoxMinimum, OfOneVariableIsFoundAtAnyScale) {
    for (const double weight : {1e-3, 1.0, 40.0, 1e3, 1e5}) {
        const Residuals line = [&](const VectorXd& x, VectorXd& r, MatrixXd& jacobian) {
            r.resize(2);
            r << weight * (x[0] - 2.0), 0.1 * x[0];
            jacobian.resize(2, 1);
            jacobian << weight, 0.1;
        };
        const VectorXd one = VectorXd::Ones(1);
        const double exact = 2.0 * weight * weight / (weight * weight + 0.01);
        EXPECT_TRUE(agrees("inside", box_minimum(line, -3.0 * one, -9.0 * one, 9.0 * one)[0], exact, 1e-6)) << weight;
        EXPECT_TRUE(agrees("at the bound", box_minimum(line, -3.0 * one, -9.0 * one, -1.0 * one)[0],
                           -1.0 + std::min(0.0, exact + 1.0), 1e-9))
            << weight;
    }
}

/// Targets with any tolerance, far from being reached: residuals are up to 1e5.
TEST(BoxMinimum, DoesNotDependOnTheScaleOfTheResiduals) {
    for (const double weight : {1e-3, 0.03, 1.0, 25.0, 30.0, 100.0, 1e3, 1e5}) {
        const Residuals scaled = [&](const VectorXd& x, VectorXd& r, MatrixXd& jacobian) {
            r.resize(4);
            r << weight * (x[0] + 0.3 * x[1] - 2.0), 5.0 * (x[0] - 0.5 * x[1] + 1.0), 0.1 * x[0], 0.1 * x[1];
            jacobian.resize(4, 2);
            jacobian << weight, 0.3 * weight, 5.0, -2.5, 0.1, 0.0, 0.0, 0.1;
        };
        VectorXd r;
        MatrixXd jacobian;
        scaled(VectorXd::Zero(2), r, jacobian);
        const VectorXd exact = -(jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * r);
        const VectorXd found = box_minimum(scaled, Vector2d(-3.0, -3.0), Vector2d(-9, -9), Vector2d(9, 9));
        EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-4) << "weight " << weight << ": " << found.transpose();
    }
}

}  // namespace
}  // namespace crackle
