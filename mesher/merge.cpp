// SPDX-License-Identifier: GPL-3.0-or-later
// A destroyed triangle is usually a sliver whose longest edge is nearly as long as the other two together. Combined
// with the triangle across that edge, it usually forms a convex quadrilateral.

#include "mesher/merge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "mesher/inset.hpp"

namespace crackle {
namespace {

// An edge of a polygon, from one corner to the next, and the triangle that contains it. The neighbour across the edge
// is found through this triangle.
struct Side {
    int corner;
    int triangle;
};
using Polygon = std::vector<Side>;

// A corner whose turning angle has a smaller sine counts as straight; points added on a wall lie exactly on one line.
constexpr double straight = 1e-12;

class Joiner {
  public:
    Joiner(const Triangles& mesh, double depth, double scale) : mesh_(mesh), inset_(depth, scale) {}

    void join(const std::vector<int>& destroyed);
    JoinedTriangles result() const;

  private:
    int owner(int triangle);
    Polygon polygon_of(int triangle) const;
    std::size_t opposite(const Side& side) const;
    int beyond(const Polygon& polygon, std::size_t side) const;
    Point corner(const Side& side) const { return mesh_.points[static_cast<std::size_t>(side.corner)]; }
    bool convex(const Polygon& polygon) const;
    bool survives(const Polygon& polygon);

    const Triangles& mesh_;
    Inset inset_;
    std::map<int, Polygon> polygons_;  // the polygons made so far, by their lowest triangle index (key)
    // For each merged triangle, another triangle of the same polygon that is closer to the polygon's key (its lowest
    // triangle index). The key is its own parent.
    std::map<int, int> parent_;
};

// Key of the triangle's polygon, or the triangle itself if it has not been merged. Paths are halved during the search,
// so that merging n triangles takes O(n log n) steps.
int Joiner::owner(int triangle) {
    for (auto found = parent_.find(triangle); found != parent_.end() && found->second != triangle;
         found = parent_.find(triangle)) {
        found->second = parent_.at(found->second);
        triangle = found->second;
    }
    return triangle;
}

Polygon Joiner::polygon_of(int key) const {
    const auto found = polygons_.find(key);
    if (found != polygons_.end()) return found->second;
    const auto& c = mesh_.corners[static_cast<std::size_t>(key)];
    return {{c[0], key}, {c[1], key}, {c[2], key}};
}

// Index (0 to 2) of the triangle's corner opposite the side.
std::size_t Joiner::opposite(const Side& side) const {
    const auto& corners = mesh_.corners[static_cast<std::size_t>(side.triangle)];
    return corners[1] == side.corner ? 0 : corners[2] == side.corner ? 1 : 2;
}

// Triangle on the other side of an edge; -1 at the boundary of the mesh, and at a trace, which must remain an edge.
int Joiner::beyond(const Polygon& polygon, std::size_t side) const {
    const auto triangle = static_cast<std::size_t>(polygon[side].triangle);
    const std::size_t k = opposite(polygon[side]);
    const bool trace = !mesh_.traces.empty() && mesh_.traces[triangle][k] >= 0;
    return trace ? -1 : mesh_.neighbours[triangle][k];
}

bool Joiner::convex(const Polygon& polygon) const {
    const std::size_t count = polygon.size();
    if (count < 3) return false;
    for (std::size_t k = 0; k < count; ++k) {
        const Point a = corner(polygon[k]), b = corner(polygon[(k + 1) % count]), c = corner(polygon[(k + 2) % count]);
        const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
        const double turn = ux * vy - uy * vx, ahead = ux * vx + uy * vy;
        const double flat = straight * distance(a, b) * distance(b, c);
        if (turn < -flat || (turn <= flat && ahead <= 0.0)) return false;
    }
    return true;
}

bool Joiner::survives(const Polygon& polygon) {
    std::vector<Point> outline;
    for (const Side& side : polygon) outline.push_back(corner(side));
    return !inset_.of(outline).empty();
}

void Joiner::join(const std::vector<int>& destroyed) {
    std::deque<int> waiting(destroyed.begin(), destroyed.end());
    while (!waiting.empty()) {
        const int key = owner(waiting.front());
        waiting.pop_front();
        const Polygon polygon = polygon_of(key);
        if (survives(polygon)) continue;  // the triangle has been merged with another in the meantime
        std::vector<std::size_t> sides(polygon.size());
        for (std::size_t k = 0; k < sides.size(); ++k) sides[k] = k;
        const auto length = [&](std::size_t k) {
            return distance(corner(polygon[k]), corner(polygon[(k + 1) % polygon.size()]));
        };
        std::stable_sort(sides.begin(), sides.end(),
                         [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
        Polygon best;
        int best_other = -1;
        for (const std::size_t side : sides) {
            const int across = beyond(polygon, side);
            if (across < 0) continue;
            const int other = owner(across);
            const Polygon theirs = polygon_of(other);
            const int end = polygon[(side + 1) % polygon.size()].corner;
            const auto shared = std::find_if(theirs.begin(), theirs.end(),
                                             [&](const Side& s) { return s.corner == end && s.triangle == across; });
            if (shared == theirs.end()) continue;
            const auto j = static_cast<std::size_t>(shared - theirs.begin());
            Polygon both;
            for (std::size_t k = 1; k < polygon.size(); ++k) both.push_back(polygon[(side + k) % polygon.size()]);
            for (std::size_t k = 1; k < theirs.size(); ++k) both.push_back(theirs[(j + k) % theirs.size()]);
            if (!convex(both)) continue;
            const bool lives = survives(both);
            if (lives || best.empty()) best = both, best_other = other;
            if (lives) break;
        }
        if (best.empty()) {
            const auto& c = mesh_.corners[static_cast<std::size_t>(key)];
            const Point at = mesh_.points[static_cast<std::size_t>(c[0])];
            std::vector<int> traces = traces_about(mesh_, static_cast<std::size_t>(key));
            const std::string text = fmt::format(
                "mesh: found triangle {} at ({:.9g}, {:.9g}){} destroyed by the inset, expected a neighbour with which "
                "it forms a convex polygon",
                key, at.x, at.y, in_words(traces));
            throw MeshError(text, {}, std::move(traces));
        }
        const int lowest = std::min(key, best_other);
        polygons_.erase(key);
        polygons_.erase(best_other);
        parent_[key] = parent_[best_other] = lowest;
        polygons_[lowest] = std::move(best);
        waiting.push_back(lowest);
    }
}

JoinedTriangles Joiner::result() const {
    JoinedTriangles out;
    out.joined.assign(mesh_.corners.size(), false);
    for (const auto& [triangle, parent] : parent_) out.joined[static_cast<std::size_t>(triangle)] = true;
    for (const auto& [key, polygon] : polygons_) {
        JoinedTriangles::Outline& outline = out.outlines.emplace_back();
        outline.triangle = key;
        for (const Side& side : polygon) {
            outline.corners.push_back(side.corner);
            if (!mesh_.traces.empty())
                outline.traces.push_back(mesh_.traces[static_cast<std::size_t>(side.triangle)][opposite(side)]);
        }
    }
    return out;
}

}  // namespace

JoinedTriangles join_destroyed(const Triangles& mesh, const std::vector<int>& destroyed, double depth,
                               double coordinate_scale) {
    Joiner joiner(mesh, depth, coordinate_scale);
    joiner.join(destroyed);
    return joiner.result();
}

std::vector<int> traces_about(const Triangles& mesh, std::size_t triangle) {
    if (mesh.traces.empty()) return {};
    std::set<int> named;
    const auto take = [&](std::size_t t) {
        for (const int trace : mesh.traces[t])
            if (trace >= 0) named.insert(trace);
    };
    take(triangle);
    for (const int beside : mesh.neighbours[triangle])
        if (beside >= 0) take(static_cast<std::size_t>(beside));
    return {named.begin(), named.end()};
}

std::string in_words(const std::vector<int>& traces) {
    if (traces.empty()) return "";
    return fmt::format(" next to trace{} {}", traces.size() == 1 ? "" : "s", fmt::join(traces, ", "));
}

}  // namespace crackle
