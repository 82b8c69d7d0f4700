// SPDX-License-Identifier: GPL-3.0-or-later
// Search by response surfaces: designs around a point, surfaces fitted to the measurements there, and the best point
// that they predict.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "specimens/calibration/search_space.hpp"
#include "specimens/calibration/surface.hpp"
#include "specimens/calibration/surface_quality.hpp"

namespace crackle {

/// Half-widths of a design, in logarithms: 0.3 spans factors from 0.74 to 1.35 relative to its centre.
inline constexpr double wide_design = 0.3, narrow_design = 0.18;
/// Largest distance of a solution from the centre of the design, in half-widths.
inline constexpr double reach_of_surface = 1.6;

class SurfaceSearch {
  public:
    /// Returns the results for all targets at x: one row per packing, in the same order for every x; NaN for a missing
    /// result.
    using Figures = std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)>;

    SurfaceSearch(const SearchSpace& space, Figures figures);

    /// Points that fill a box of half-width `width` around `middle` evenly; each call continues the same sequence.
    std::vector<Eigen::VectorXd> design(const Eigen::VectorXd& middle, double width);
    /// Adds a measured point.
    void remember(const Eigen::VectorXd& x);
    const std::vector<Eigen::VectorXd>& measured() const { return measured_; }
    /// Fits surfaces to the measured points near `middle`.
    /// @return number of points used; if there are too few, no surface is fitted
    std::size_t fit(const Eigen::VectorXd& middle, double width);

    bool empty() const { return surfaces_.empty(); }
    /// Predicted logarithms of the results for all targets; linear targets are assumed to be met exactly.
    Eigen::VectorXd predict(const Eigen::VectorXd& x) const;
    /// Best predicted point near `middle`. @param weights  weight of each target
    Eigen::VectorXd solve(const Eigen::VectorXd& middle, double width, const Eigen::VectorXd& weights) const;
    /// Shifts the surfaces so that they agree with the means measured at x.
    void shift(const Eigen::VectorXd& x, const Eigen::VectorXd& means);
    /// Derivatives of the predicted results with respect to all variables, in tolerances; rows of linear targets are
    /// zero.
    Eigen::MatrixXd slopes(const Eigen::VectorXd& x) const;

    /// Quality of each surface's fit.
    std::vector<SurfaceQuality> quality() const;

    /// Distance in half-widths, considering only the keys that this search adjusts.
    double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double width) const;

  private:
    const SearchSpace& space_;
    Figures figures_;
    std::vector<Eigen::VectorXd> measured_;
    std::size_t designed_ = 0;       // number of points of the low-discrepancy sequence that are used
    std::vector<Surface> surfaces_;  // one for each of SearchSpace::other_targets
};

/// Rows of `figures` in which all results are positive.
Eigen::MatrixXd complete_rows(const Eigen::MatrixXd& figures);
/// Whether results from `done` out of `asked` packings suffice.
bool are_enough(Eigen::Index done, Eigen::Index asked);

}  // namespace crackle
