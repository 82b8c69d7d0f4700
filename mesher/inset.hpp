// SPDX-License-Identifier: GPL-3.0-or-later
// Inset of a convex polygon: every edge moves inwards by the same depth. And what else is done to polygons: cut by a
// line, measured, held against the sides of a domain. Tested by tests/mesher/voronoi_test.cpp.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mesher/mesher.hpp"

namespace crackle {

/// Of one rounding, relative.
inline constexpr double relative_rounding = std::numeric_limits<double>::epsilon();

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
    /// Whether no edge of the last outline vanished: those of its inset have their numbers.
    bool edges_kept() const { return edges_kept_; }

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
    bool edges_kept_ = false;
};

/// Radius of the largest disc inside a convex polygon, m: the inset that destroys it.
double inscribed_radius(std::span<const Point> outline, double coordinate_scale);

/// Signed area by the shoelace formula about the first corner, m2; positive counter-clockwise.
double polygon_area(std::span<const Point> outline);

/// Keeps the part of a convex polygon for which nx·x + ny·y >= offset. @param scratch working memory
void clip(std::vector<Point>& polygon, double nx, double ny, double offset, std::vector<Point>& scratch);

/// A side's bit, or none.
inline unsigned side_if(bool set, SideBit side) { return set ? unsigned{side} : 0U; }

/// Bits of the sides on which a point lies.
inline unsigned sides_at(Point p, const Rectangle& domain) {
    return side_if(p.x == domain.x1, side_left) | side_if(p.x == domain.x2, side_right) |
           side_if(p.y == domain.y1, side_bottom) | side_if(p.y == domain.y2, side_top);
}

/// Bits of the sides on which the polygon has an edge.
std::uint8_t sides_of(std::span<const Point> polygon, const Rectangle& domain);

}  // namespace crackle
