// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/surface.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace crackle {
namespace {

struct Fit {
    Eigen::VectorXd coefficients;
    double left_out_error = std::numeric_limits<double>::infinity();
};

/// Least-squares fit. @param rows  values of the polynomial's terms, one row per point
Fit fit(const Eigen::MatrixXd& rows, const Eigen::VectorXd& values) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
    Fit fit;
    if (qr.rank() < rows.cols()) return fit;
    fit.coefficients = qr.solve(values);
    const Eigen::VectorXd residuals = values - rows * fit.coefficients;
    const Eigen::MatrixXd inverse = (rows.transpose() * rows).inverse();
    // If a point is left out of the fit, its residual becomes 1/(1 − leverage) times as large.
    const Eigen::VectorXd leverage = (rows * inverse).cwiseProduct(rows).rowwise().sum();
    fit.left_out_error = std::sqrt((residuals.array() / (1.0 - leverage.array()).max(1e-12)).square().mean());
    return fit;
}

}  // namespace

Surface::Surface(Eigen::VectorXd centre, const Eigen::MatrixXd& points, const Eigen::VectorXd& values,
                 const Eigen::VectorXd& slopes)
    : centre_(std::move(centre)), slopes_(slopes) {
    for (Eigen::Index k = 0; k < slopes.size(); ++k)
        if (std::isnan(slopes[k])) found_.push_back(k);
    const auto p = static_cast<Eigen::Index>(found_.size()), n = points.cols();
    if (n < p + 1) throw std::invalid_argument("Surface: fewer points than terms");
    Eigen::VectorXd rest = values;
    for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index d = 0; d < slopes.size(); ++d)
            if (!std::isnan(slopes[d])) rest[k] -= slopes[d] * (points(d, k) - centre_[d]);
    const auto rows = [&] {
        Eigen::MatrixXd all;
        for (Eigen::Index k = 0; k < n; ++k) {
            const Eigen::VectorXd row = terms(points.col(k));
            if (k == 0) all.resize(n, row.size());
            all.row(k) = row.transpose();
        }
        return all;
    };
    Fit best = fit(rows(), rest);
    if (best.coefficients.size() == 0) throw std::invalid_argument("Surface: the points do not span the variables");
    const Eigen::Index terms_of_square = (p + 1) * (p + 2) / 2;
    if (p > 0 && n >= terms_of_square + 2) {
        quadratic_ = true;
        Fit square = fit(rows(), rest);
        if (square.left_out_error < best.left_out_error)
            best = std::move(square);
        else
            quadratic_ = false;
    }
    coefficients_ = std::move(best.coefficients);
    left_out_error_ = best.left_out_error;
}

Eigen::VectorXd Surface::terms(const Eigen::VectorXd& x) const {
    std::vector<double> all{1.0};
    for (const Eigen::Index d : found_) all.push_back(x[d] - centre_[d]);
    const std::size_t linear = all.size();
    for (std::size_t i = 1; quadratic_ && i < linear; ++i)
        for (std::size_t j = i; j < linear; ++j) all.push_back(all[i] * all[j]);
    return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

double Surface::value(const Eigen::VectorXd& x) const {
    double y = coefficients_.dot(terms(x));
    for (Eigen::Index d = 0; d < slopes_.size(); ++d)
        if (!std::isnan(slopes_[d])) y += slopes_[d] * (x[d] - centre_[d]);
    return y;
}

Eigen::VectorXd Surface::gradient(const Eigen::VectorXd& x) const {
    Eigen::VectorXd slope = slopes_.array().isNaN().select(0.0, slopes_);
    const auto p = static_cast<Eigen::Index>(found_.size());
    const auto variable = [&](Eigen::Index k) { return found_[static_cast<std::size_t>(k)]; };
    for (Eigen::Index k = 0; k < p; ++k) slope[variable(k)] += coefficients_[1 + k];
    Eigen::Index at = 1 + p;
    for (Eigen::Index i = 0; quadratic_ && i < p; ++i) {
        for (Eigen::Index j = i; j < p; ++j, ++at) {
            slope[variable(i)] += coefficients_[at] * (x[variable(j)] - centre_[variable(j)]);
            slope[variable(j)] += coefficients_[at] * (x[variable(i)] - centre_[variable(i)]);
        }
    }
    return slope;
}

}  // namespace crackle
