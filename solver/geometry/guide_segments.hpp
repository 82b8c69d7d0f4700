// SPDX-License-Identifier: GPL-3.0-or-later
// The DEMseg guide's segment law («demseg»): a disc of radius r against a bare segment, evaluated for each pair of
// elements.
//
// Let α be the distance of the disc's centre x1 from the segment's line, p the projection of x1 on the line, x2 the
// segment's midpoint, s_k its nearer end, l = sqrt(r² - α²), h_p = |p - x2| and h_s = |s_k - x2|. The cases are:
//     (i)   h_p >= h_s + l                no contact
//     (ii)  h_s + l > h_p > h_s           at s_k   δ = r - |s_k - x1|         normal along s_k - x1
//     (iii) h_s > h_p > h_s - l           at p     δ = (r - |α|)·|s_k - p|/l  normal to the segment
//     (iv)  h_s - l >= h_p                at p     δ = r - |α|                normal to the segment
// For two segments, r = thick, and each end of either segment carries a disc against the other bare segment (up to four
// cases). For a circle and a segment, r is the circle's radius plus thick. The cases of one pair of elements are
// combined into a resultant
//     δ n = Σ δ_c n_c (or its mean over the cases in contact),   acting at   Σ δ_c x_c / Σ δ_c,
// with n_c from i to j. If opposite cases cancel, δ = 0 and the contact ends. Three properties of the guide's law are
// kept. First, δ jumps between (iii) and (ii) at a free end, although the sum over two collinear adjoining segments is
// continuous. Second, α is unsigned, so a disc that has passed through is pushed out at the back. Third, a corner is
// the end of two segments and therefore twice as stiff. The guide does not state the normal of (ii), nor the overlap at
// h_p = h_s. That overlap is taken as half the overlap of (ii), so that ends exactly opposite each other give the same
// sum as ends nearly opposite. Round-off decides the case there, so meshes on a grid are the worst case for this law.
// Source: DEMseg guide II.2 (equations (6) and (7) are printed without -r); solver/MODEL.md 3.3.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/base/vec2.hpp"

namespace crackle {

/// A bare segment: start (m), unit direction and length (m).
struct Bar {
    Vec2 start, along;
    double length;

    /// Outward normal if the bar is an edge of a counter-clockwise polygon.
    Vec2 outward() const { return {along.y, -along.x}; }
};

/// Rule of the DEMseg guide that applies to a disc.
enum class DiscRule : std::uint8_t { none, end, ramp, face };  // (i) to (iv)

/// Position of a disc's centre relative to a bar, and the resulting contact.
struct DiscCase {
    double inside;  // m, distance of the projected centre from the nearer end, h_s - h_p; negative beyond the end
    double height;  // m, |α|
    double side;    // +1 if the centre is on the outward side of the line or on it, otherwise -1
    double squared_distance;  // m2, squared distance of the centre from the nearest point of the bar
    Vec2 end;                 // s_k, m
    DiscRule rule = DiscRule::none;
    double overlap = 0.0;  // m
    Vec2 normal;           // unit vector from the disc to the bar; without contact, set only by place()
    Vec2 at;               // m, contact position
};

/// Sets normal and contact position from the point of the bar nearest to the disc's centre.
inline void place(DiscCase& c, const Bar& bar, Vec2 centre) {
    const double distance = std::sqrt(c.squared_distance);
    if (c.inside <= 0.0 && distance > 0.0) {
        c.normal = (1.0 / distance) * (c.end - centre);
        c.at = c.end;
    } else {
        // If the centre is at the end point itself, the direction is undefined; the segment's normal is used.
        c.normal = -c.side * bar.outward();
        c.at = centre + c.height * c.normal;
    }
}

/// Determines the case of a disc by rules (i) to (iv). @param radius r, m
inline DiscCase disc_case(const Bar& bar, Vec2 centre, double radius) {
    DiscCase c;
    const Vec2 w = centre - bar.start;
    const double foot = dot(w, bar.along);
    const double across = w.x * bar.along.y - w.y * bar.along.x;
    const bool first = foot < 0.5 * bar.length;
    c.inside = first ? foot : bar.length - foot;
    c.end = first ? bar.start : bar.start + bar.length * bar.along;
    c.height = std::abs(across);
    c.side = across >= 0.0 ? 1.0 : -1.0;
    const double beyond = std::min(c.inside, 0.0);
    c.squared_distance = across * across + beyond * beyond;
    if (c.squared_distance >= radius * radius) return c;
    place(c, bar, centre);
    const double squared_half_width = radius * radius - across * across;  // l²
    if (c.inside <= 0.0) {
        c.rule = DiscRule::end;
        c.overlap = radius - std::sqrt(c.squared_distance);
        if (c.inside == 0.0) c.overlap *= 0.5;
    } else if (c.inside * c.inside < squared_half_width) {
        c.rule = DiscRule::ramp;
        c.overlap = (radius - c.height) * c.inside / std::sqrt(squared_half_width);
    } else {
        c.rule = DiscRule::face;
        c.overlap = radius - c.height;
    }
    return c;
}

/// Combines the overlaps and normals of the discs of one pair of elements into a resultant contact.
class DiscResultant {
  public:
    /// Adds the contribution of one disc. @param sense +1 for a disc of i, -1 for a disc of j, so that normals point
    /// from i to j
    void add(const Bar& bar, Vec2 centre, double radius, double sense) {
        const DiscCase c = disc_case(bar, centre, radius);
        if (c.squared_distance < least_squared_distance_) {
            least_squared_distance_ = c.squared_distance;
            nearest_ = added_;
        }
        ++added_;
        if (c.rule == DiscRule::none) return;
        sum_ = sum_ + (sense * c.overlap) * c.normal;
        position_ = position_ + c.overlap * c.at;
        weight_ += c.overlap;
        ++cases_;
    }

    /// Resultant contact of all discs of a pair of elements.
    struct Contact {
        double overlap;   // m; without contact, minus the gap between the nearest disc and the bar
        Vec2 normal, at;  // unit vector from i to j; contact position, m
    };

    /// Returns the resultant. @param mean whether to use the mean instead of the sum @param visit function that repeats
    /// all calls of add() on its argument; used only for a pair without contact
    template <typename Visit>
    Contact contact(bool mean, Visit&& visit) const {
        const double size = norm(sum_);
        if (size > 0.0) {
            const double overlap = mean ? size / static_cast<double>(cases_) : size;
            return {overlap, (1.0 / size) * sum_, (1.0 / weight_) * position_};
        }
        Contact apart{};
        int number = 0;
        visit([&](const Bar& bar, Vec2 centre, double radius, double sense) {
            if (number++ != nearest_) return;
            DiscCase c = disc_case(bar, centre, radius);
            place(c, bar, centre);
            apart = {std::min(0.0, radius - std::sqrt(c.squared_distance)), sense * c.normal, c.at};
        });
        if (weight_ > 0.0) apart.at = (1.0 / weight_) * position_;
        return apart;
    }

  private:
    Vec2 sum_, position_;
    double weight_ = 0.0, least_squared_distance_ = std::numeric_limits<double>::infinity();
    int cases_ = 0, added_ = 0, nearest_ = 0;
};

}  // namespace crackle
