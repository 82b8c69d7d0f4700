// SPDX-License-Identifier: GPL-3.0-or-later
#include "specimens/calibration/box_minimum.hpp"

#include <nlopt.hpp>
#include <vector>

namespace crackle {
namespace {

double objective(const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& residuals = *static_cast<const Residuals*>(data);
    Eigen::VectorXd r;
    Eigen::MatrixXd jacobian;
    residuals(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())), r, jacobian);
    if (!gradient.empty())
        Eigen::Map<Eigen::VectorXd>(gradient.data(), static_cast<Eigen::Index>(gradient.size())) =
            2.0 * jacobian.transpose() * r;
    return r.squaredNorm();
}

}  // namespace

Eigen::VectorXd box_minimum(const Residuals& residuals, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                            const Eigen::VectorXd& high) {
    if (start.size() == 0) return start;
    nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(start.size()));
    search.set_min_objective(objective, const_cast<Residuals*>(&residuals));
    search.set_lower_bounds({low.data(), low.data() + low.size()});
    search.set_upper_bounds({high.data(), high.data() + high.size()});
    search.set_xtol_rel(1e-10);
    search.set_ftol_abs(1e-16);
    search.set_maxeval(500);
    std::vector<double> x(start.data(), start.data() + start.size());
    double least = 0.0;
    try {
        search.optimize(x, least);
    } catch (const nlopt::roundoff_limited&) {  // x is the best so far
    }
    return Eigen::Map<const Eigen::VectorXd>(x.data(), start.size());
}

}  // namespace crackle
