// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/determination.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace crackle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool fills(double low, double high, double least, double most) {
    constexpr double filled_share = 0.9;
    return std::min(high, most) - std::max(low, least) >= filled_share * (most - least);
}

Determination determine(const MatrixXd& slopes, const MatrixXd& covariance, double step) {
    constexpr double least_change = 0.5;  // smallest change of a target that determines a direction, in tolerances
    // A key is determined if its component in each open (undetermined) direction is at most this fraction of the
    // largest component.
    constexpr double small_part = 0.1;
    const Index variables = slopes.cols();
    const Eigen::JacobiSVD<MatrixXd> svd(slopes * step, Eigen::ComputeThinU | Eigen::ComputeFullV);
    Determination found;
    found.determined.assign(static_cast<std::size_t>(variables), true);
    // Pseudo-inverse of the slopes, restricted to the directions that the targets determine.
    MatrixXd inverse = MatrixXd::Zero(variables, slopes.rows());
    for (Index k = 0; k < variables; ++k) {
        const VectorXd direction = svd.matrixV().col(k);
        const VectorXd way = step / direction.cwiseAbs().maxCoeff() * direction;
        const double change = slopes.rows() == 0 ? 0.0 : (slopes * way).cwiseAbs().maxCoeff();
        if (change >= least_change) {
            inverse += direction * svd.matrixU().col(k).transpose() * (step / svd.singularValues()[k]);
            continue;
        }
        found.open.push_back({way, change});
        for (Index d = 0; d < variables; ++d)
            if (std::abs(way[d]) > small_part * step) found.determined[static_cast<std::size_t>(d)] = false;
    }
    found.standard_errors = (inverse * covariance * inverse.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
    return found;
}

}  // namespace crackle
