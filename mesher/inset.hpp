// SPDX-License-Identifier: GPL-3.0-or-later
// Inset of a convex polygon: every edge moves inwards by the same depth.
#pragma once

#include <span>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

/// Insets polygons one after another with the same working memory.
class Inset {
  public:
    /// @param depth  m, >= 0  @param coordinate_scale  largest coordinate, m: positions are rounded at some
    /// relative_rounding of it
    Inset(double depth, double coordinate_scale) : depth_(depth), scale_(coordinate_scale) {}

    /// @param outline  convex, counter-clockwise, m
    /// @return the points that are at least `depth` inside every edge, convex and counter-clockwise; empty if there are
    ///         none. Edges may vanish. Valid until the next call.
    std::span<const Point> of(std::span<const Point> outline) { return of(outline, {}); }
    /// @param kept  by corner: whether it stays one although the outline goes straight on there, as where a trace ends
    /// on an edge; it then stands out by 16 relative_rounding of the scale. Not where edges vanish.
    std::span<const Point> of(std::span<const Point> outline, std::span<const char> kept);

  private:
    bool straightforward();
    void by_half_planes();
    /// @param kept  by corner, or empty
    void drop_flat_corners(std::vector<Point>& polygon, std::vector<char>& kept) const;
    void measure_edges();

    double depth_, scale_;
    std::vector<Point> outline_, result_, scratch_;
    std::vector<Point> direction_;  // of edge k, from corner k to k + 1, unit
    std::vector<double> length_;
    std::vector<char> kept_, none_;  // by corner of the outline
};

/// Radius of the largest disc inside a convex polygon, m: the inset that destroys it.
double inscribed_radius(std::span<const Point> outline, double coordinate_scale);

/// Signed area by the shoelace formula about the first corner, m2; positive counter-clockwise.
double polygon_area(std::span<const Point> outline);

}  // namespace crackle
