// SPDX-License-Identifier: GPL-3.0-or-later
// The guide's contact of segments («demseg» law): a disc of radius r against a bare segment, decided element by
// element.
//
// With α the normal distance of the disc's centre x1 from the segment's line, p its foot, x2 the segment's midpoint,
// l = sqrt(r² - α²), k the nearer end, h_p = |p - x2| and h_s = |s_k - x2|:
//     (i)   h_p >= h_s + l                no contact
//     (ii)  h_s + l > h_p > h_s           at s_k   δ = r - |s_k - x1|         normal along s_k - x1
//     (iii) h_s > h_p > h_s - l           at p     δ = (r - |α|)·|s_k - p|/l  normal to the segment
//     (iv)  h_s - l >= h_p                at p     δ = r - |α|                normal to the segment
// Segment against segment: r = thick, the discs sit at the ends of each against the bare other (up to four cases);
// circle against segment: its radius + thick. The cases of one pair of elements have one resultant
//     δ n = Σ δ_c n_c (or its mean over the cases in contact),   acting at   Σ δ_c x_c / Σ δ_c,
// n_c from i to j. Opposite cases may cancel: then δ = 0, and the contact ends.
// Kept as the guide has it: δ jumps from (iii) to (ii) at a free end (the sum over a straight joint is continuous); α
// is unsigned, so a disc that got through is pushed out behind; a corner is the end of two segments and twice as stiff.
// Ours where the guide is silent: the normal of (ii), and half its overlap at h_p = h_s, so that ends exactly opposite
// each other sum up as ends nearly so do (rounding decides there: meshes on a grid are this law's worst case). Source:
// DEMseg guide II.2 (printed (6) and (7) lack -r); solver/MODEL.md 3.3.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "solver/base/vec2.hpp"

namespace crackle {

/// A bare segment: start, unit direction, length (m).
struct Bar {
    Vec2 start, along;
    double length;

    /// Of a counter-clockwise polygon.
    Vec2 outward() const { return {along.y, -along.x}; }
};

enum class DiscRule : std::uint8_t { none, end, ramp, face };  // (i) to (iv)

/// Where a disc's centre lies before a bar, and what the rules give for it.
struct DiscCase {
    double inside;            // m, of the foot from the nearer end, h_s - h_p
    double height;            // m, |α|
    double side;              // +1: the centre is on the outward side (or on the line), -1: behind
    double squared_distance;  // m2, of the centre from the bar
    Vec2 end;                 // s_k, m
    DiscRule rule = DiscRule::none;
    double overlap = 0.0;  // m
    Vec2 normal;           // unit, from the disc to the bar; set by place() where the rule is none
    Vec2 at;               // m, contact position
};

/// Normal and position, by the feature of the bar that is nearest.
inline void place(DiscCase& c, const Bar& bar, Vec2 centre) {
    const double distance = std::sqrt(c.squared_distance);
    if (c.inside <= 0.0 && distance > 0.0) {
        c.normal = (1.0 / distance) * (c.end - centre);
        c.at = c.end;
    } else {
        // On the end itself no direction is better than the segment's normal.
        c.normal = -c.side * bar.outward();
        c.at = centre + c.height * c.normal;
    }
}

/// Rules (i) to (iv). @param radius r, m
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

/// Adds up the disc cases of one pair of elements.
class DiscResultant {
  public:
    /// @param sense +1 where the disc is i's, -1 where it is j's: normals point from i to j
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

    struct Contact {
        double overlap;   // m; out of contact minus the distance of the nearest disc from the bar
        Vec2 normal, at;  // unit, from i to j; m
    };

    /// @param visit calls what it is given once more with the arguments of every add(), for a pair out of contact
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
