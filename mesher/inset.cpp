// SPDX-License-Identifier: GPL-3.0-or-later
// Inset of a convex polygon: the intersection of its half-planes, each moved inwards by a depth d. A corner between
// edges with unit directions t1, t2 moves by d·(t2 - t1)/(t1 × t2). If all edges keep a positive length, this is the
// result. Otherwise the outline is clipped by one half-plane after another, and edges may vanish.

#include "mesher/inset.hpp"

#include <algorithm>
#include <cmath>

namespace crackle {
namespace {

// Edges shorter than this fraction of the perimeter are removed from an inset. The limit is negligible for the shape
// but far above round-off.
constexpr double shortest_share = 1e-12;
// Corners whose turning angle has a smaller sine are dropped, since the offset lines of their edges have no
// well-defined intersection.
constexpr double flattest_turn = 1e-12;
// An inset whose area is a smaller fraction of the outline's area counts as empty, since it consists only of round-off.
constexpr double smallest_area_share = 1e-12;

}  // namespace

double polygon_area(std::span<const Point> outline) {
    double twice = 0.0;
    for (std::size_t k = 1; k + 1 < outline.size(); ++k) {
        const Point a{outline[k].x - outline[0].x, outline[k].y - outline[0].y};
        const Point b{outline[k + 1].x - outline[0].x, outline[k + 1].y - outline[0].y};
        twice += cross(a, b);
    }
    return 0.5 * twice;
}

void Inset::measure_edges() {
    const std::size_t count = outline_.size();
    direction_.resize(count);
    length_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
        const Point a = outline_[k], b = outline_[k + 1 == count ? 0 : k + 1];
        const Point d{b.x - a.x, b.y - a.y};
        length_[k] = std::sqrt(dot(d, d));
        direction_[k] = {d.x / length_[k], d.y / length_[k]};
    }
}

// Removes corners that lie, up to round-off, on the line between their neighbours, or that turn the wrong way because
// of round-off.
void Inset::drop_flat_corners(std::vector<Point>& polygon, std::vector<char>& kept) const {
    bool changed = true;
    while (changed && polygon.size() >= 3) {
        changed = false;
        for (std::size_t k = 0; k < polygon.size() && polygon.size() >= 3; ++k) {
            const std::size_t count = polygon.size();
            const Point a = polygon[(k + count - 1) % count], b = polygon[k], c = polygon[(k + 1) % count];
            const Point in{b.x - a.x, b.y - a.y}, out{c.x - b.x, c.y - b.y};
            const double lengths = std::sqrt(dot(in, in) * dot(out, out));
            const double turn = cross(in, out);
            const double chord = distance(a, c);
            const bool straight_on = dot(in, out) > 0.0;
            if (straight_on && lengths > 0.0 && !kept.empty() && kept[k] != 0) continue;
            if (lengths == 0.0 || (straight_on && (turn <= flattest_turn * lengths ||
                                                   turn <= 4.0 * relative_rounding * scale_ * chord))) {
                polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(k));
                if (!kept.empty()) kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(k));
                changed = true;
                --k;
            }
        }
    }
}

// Moves all edges without clipping. @return false if an edge vanishes or the outline has flat corners
bool Inset::straightforward() {
    const std::size_t count = outline_.size();
    result_.resize(count);
    double perimeter = 0.0;
    for (const double length : length_) perimeter += length;
    const double shortest = std::max(shortest_share * perimeter, 16.0 * relative_rounding * scale_);
    // An edge loses d·tan(turn/2) at each end, where tan(turn/2) = (1 - cos)/sin = sin/(1 + cos).
    double lost_before = 0.0, lost_at_first = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t before = k == 0 ? count - 1 : k - 1;
        const Point t1 = direction_[before], t2 = direction_[k];
        const double sine = cross(t1, t2), cosine = dot(t1, t2);
        const double straight_within = 16.0 * relative_rounding * scale_;
        const bool flat =
            (sine <= flattest_turn && cosine > 0.0) || sine * std::min(length_[before], length_[k]) <= straight_within;
        const bool stays = flat && !kept_.empty() && kept_[k] != 0 && cosine > 0.0;
        if (flat && !stays) return false;
        Point move;
        double lost;
        if (cosine > 0.0) {  // (t2 - t1)/sine = (n1 + n2)/(1 + cosine), n inward normals; this form avoids cancellation
            const double share = depth_ / (1.0 + cosine);
            move = {-share * (t1.y + t2.y), share * (t1.x + t2.x)};
            lost = share * sine;
        } else {
            const double share = depth_ / sine;
            move = {share * (t2.x - t1.x), share * (t2.y - t1.y)};
            lost = share * (1.0 - cosine);
        }
        if (stays) move = {move.x + straight_within * t2.y, move.y - straight_within * t2.x};
        result_[k] = {outline_[k].x + move.x, outline_[k].y + move.y};
        if (k == 0) {
            lost_at_first = lost;
        } else if (length_[before] - lost_before - lost <= shortest) {
            return false;
        }
        lost_before = lost;
    }
    return length_[count - 1] - lost_before - lost_at_first > shortest;
}

void Inset::by_half_planes() {
    drop_flat_corners(outline_, kept_);
    result_.clear();
    if (outline_.size() < 3) return;
    measure_edges();
    if (straightforward()) return;
    const double area = polygon_area(outline_);
    result_ = outline_;
    double perimeter = 0.0;
    for (std::size_t k = 0; k < outline_.size() && !result_.empty(); ++k) {
        const double nx = -direction_[k].y, ny = direction_[k].x;
        clip(result_, nx, ny, nx * outline_[k].x + ny * outline_[k].y + depth_, scratch_);
        perimeter += length_[k];
    }
    const double shortest = std::max(shortest_share * perimeter, 16.0 * relative_rounding * scale_);
    const auto near = [shortest](Point a, Point b) { return distance(a, b) <= shortest; };
    result_.erase(std::unique(result_.begin(), result_.end(), near), result_.end());
    while (result_.size() > 1 && near(result_.front(), result_.back())) result_.pop_back();
    none_.clear();
    drop_flat_corners(result_, none_);
    if (result_.size() < 3 || polygon_area(result_) <= smallest_area_share * area) result_.clear();
}

std::span<const Point> Inset::of(std::span<const Point> outline, std::span<const char> kept) {
    outline_.assign(outline.begin(), outline.end());
    kept_.assign(kept.begin(), kept.end());
    result_.clear();
    edges_kept_ = false;
    if (outline_.size() < 3) return result_;
    measure_edges();
    edges_kept_ = straightforward();
    if (!edges_kept_) by_half_planes();
    return result_;
}

double inscribed_radius(std::span<const Point> outline, double coordinate_scale) {
    double perimeter = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Point a = outline[k], b = outline[k + 1 == outline.size() ? 0 : k + 1];
        perimeter += distance(a, b);
    }
    // If a disc of radius r fits inside, the triangles from its centre to the edges have heights >= r, so A >= rP/2.
    double low = 0.0, high = 2.0 * polygon_area(outline) / perimeter;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (Inset(middle, coordinate_scale).of(outline).empty() ? high : low) = middle;
    }
    return low;
}

void clip(std::vector<Point>& polygon, double nx, double ny, double offset, std::vector<Point>& scratch) {
    scratch.clear();
    const std::size_t count = polygon.size();
    for (std::size_t k = 0; k < count; ++k) {
        const Point a = polygon[k];
        const Point b = polygon[k + 1 == count ? 0 : k + 1];
        const double height_a = nx * a.x + ny * a.y - offset;
        const double height_b = nx * b.x + ny * b.y - offset;
        if (height_a >= 0.0) scratch.push_back(a);
        if ((height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0)) {
            // The intersection is interpolated from the outer end, whatever the direction of the edge, so that both
            // polygons that share the edge get the same point.
            const Point& outer = height_a < 0.0 ? a : b;
            const Point& inner = height_a < 0.0 ? b : a;
            const double low = std::min(height_a, height_b);
            const double share = low / (low - std::max(height_a, height_b));
            scratch.push_back({outer.x + share * (inner.x - outer.x), outer.y + share * (inner.y - outer.y)});
        }
    }
    polygon.swap(scratch);
}

std::uint8_t sides_of(std::span<const Point> polygon, const Rectangle& domain) {
    unsigned sides = 0;
    unsigned before = sides_at(polygon.back(), domain);
    for (const Point& corner : polygon) {
        const unsigned here = sides_at(corner, domain);
        sides |= before & here;
        before = here;
    }
    return static_cast<std::uint8_t>(sides);
}

}  // namespace crackle
