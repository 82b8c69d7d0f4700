// SPDX-License-Identifier: GPL-3.0-or-later
// Inset of a convex polygon: every edge is moved inwards by the same depth. This header also clips polygons at a line,
// and computes areas, inscribed radii, and the sides of the domain on which a polygon lies. Tested by
// tests/mesher/voronoi_test.cpp.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

/// Relative spacing of floating-point numbers: an upper limit on the relative error of a single rounding.
inline constexpr double relative_rounding = std::numeric_limits<double>::epsilon();

/// Insets polygons one after another and reuses its working memory.
class Inset {
  public:
    /// @param depth m, >= 0 @param coordinate_scale largest coordinate, m; position errors are a few times
    /// relative_rounding times this value
    Inset(double depth, double coordinate_scale) : depth_(depth), scale_(coordinate_scale) {}

    /// @param outline  convex, counter-clockwise, m
    /// @return outline of the points at least `depth` inside every edge, convex and counter-clockwise; empty if there
    ///         are no such points. Edges may vanish. Valid until the next call.
    std::span<const Point> of(std::span<const Point> outline) { return of(outline, {}); }
    /// Insets an outline and keeps selected flat corners. @param kept whether each corner remains even if the outline
    /// is straight there, for example because a trace ends on an edge. Such a corner is moved outwards by
    /// 16 times relative_rounding times coordinate_scale, unless edges vanish.
    std::span<const Point> of(std::span<const Point> outline, std::span<const char> kept);
    /// Whether all edges of the last outline remain, so that edges of the inset have the same indices.
    bool edges_kept() const { return edges_kept_; }

  private:
    bool straightforward();
    void by_half_planes();
    /// Removes flat corners. @param kept the same list as in of(), or empty
    void drop_flat_corners(std::vector<Point>& polygon, std::vector<char>& kept) const;
    void measure_edges();

    double depth_, scale_;
    std::vector<Point> outline_, result_, scratch_;
    std::vector<Point> direction_;  // unit vector of edge k, from corner k to k + 1
    std::vector<double> length_;
    std::vector<char> kept_, none_;  // one entry for each corner of the outline
    bool edges_kept_ = false;
};

/// Radius of the largest disc that fits into a convex polygon, m. This is the smallest depth at which the inset is
/// empty.
double inscribed_radius(std::span<const Point> outline, double coordinate_scale);

/// Signed area by the shoelace formula, relative to the first corner, m2; positive if counter-clockwise.
double polygon_area(std::span<const Point> outline);

/// Keeps the part of a convex polygon for which nx·x + ny·y >= offset. @param scratch working memory
void clip(std::vector<Point>& polygon, double nx, double ny, double offset, std::vector<Point>& scratch);

/// The bit of a side if `set` is true, otherwise 0.
inline unsigned side_if(bool set, SideBit side) { return set ? unsigned{side} : 0U; }

/// SideBits of the sides of the domain on which the point lies exactly, combined by bitwise or.
inline unsigned sides_at(Point p, const Rectangle& domain) {
    return side_if(p.x == domain.x1, side_left) | side_if(p.x == domain.x2, side_right) |
           side_if(p.y == domain.y1, side_bottom) | side_if(p.y == domain.y2, side_top);
}

/// SideBits of the sides of the domain on which the polygon has an edge, combined by bitwise or.
std::uint8_t sides_of(std::span<const Point> polygon, const Rectangle& domain);

}  // namespace crackle
