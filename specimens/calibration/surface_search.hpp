// SPDX-License-Identifier: GPL-3.0-or-later
// Designs around a point, surfaces through what was measured there, and the best point by them.
// Tested by tests/specimens/calibration/calibrate_test.cpp.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "specimens/calibration/search_space.hpp"
#include "specimens/calibration/surface.hpp"
#include "specimens/calibration/surface_quality.hpp"

namespace crackle {

/// Half-widths of a design, in logarithms: 0.3 is from 0.74 to 1.35 of its middle.
inline constexpr double wide_design = 0.3, narrow_design = 0.18;
/// A solution may lie this many half-widths from the middle of the design.
inline constexpr double reach_of_surface = 1.6;

class SurfaceSearch {
  public:
    /// Figures of all targets at a point, a row a packing, always the same packings; not a number: none.
    using Figures = std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)>;

    SurfaceSearch(const SearchSpace& space, Figures figures);

    /// Points around a middle that fill the box of its half-width evenly, other ones at each call.
    std::vector<Eigen::VectorXd> design(const Eigen::VectorXd& middle, double width);
    /// A point that was measured.
    void remember(const Eigen::VectorXd& x);
    const std::vector<Eigen::VectorXd>& measured() const { return measured_; }
    /// Surfaces through the measured points that are near. @return how many these are; with too few there are no
    /// surfaces
    std::size_t fit(const Eigen::VectorXd& middle, double width);

    bool empty() const { return surfaces_.empty(); }
    /// Logarithms of all targets' figures; those of linear targets are taken to be met.
    Eigen::VectorXd predict(const Eigen::VectorXd& x) const;
    /// Best point near a middle. @param weights of the targets
    Eigen::VectorXd solve(const Eigen::VectorXd& middle, double width, const Eigen::VectorXd& weights) const;
    /// Moves the surfaces to means that were measured at x.
    void shift(const Eigen::VectorXd& x, const Eigen::VectorXd& means);
    /// Of the other targets' figures in tolerances, over all variables; rows of linear targets are zero.
    Eigen::MatrixXd slopes(const Eigen::VectorXd& x) const;

    /// Of each surface.
    std::vector<SurfaceQuality> quality() const;

    /// In half-widths, over the keys that are searched here.
    double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double width) const;

  private:
    const SearchSpace& space_;
    Figures figures_;
    std::vector<Eigen::VectorXd> measured_;
    std::size_t designed_ = 0;       // points of the sequence that designs have used
    std::vector<Surface> surfaces_;  // of the space's other_targets
};

/// Rows without a gap, of figures that are all above 0.
Eigen::MatrixXd complete_rows(const Eigen::MatrixXd& figures);
/// Whether so many packings are enough of those that were asked for.
bool are_enough(Eigen::Index done, Eigen::Index asked);

}  // namespace crackle
