// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/scene/convex_pieces.hpp"

#include <algorithm>
#include <numeric>

#include "solver/base/errors.hpp"

namespace crackle {
namespace {

using Ring = std::vector<std::uint32_t>;

double turn(std::span<const Vec2> p, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return cross(p[b] - p[a], p[c] - p[b]);
}

bool convex(std::span<const Vec2> p, const Ring& ring) {
    const std::size_t n = ring.size();
    for (std::size_t k = 0; k < n; ++k) {
        if (turn(p, ring[k], ring[(k + 1) % n], ring[(k + 2) % n]) < 0.0) return false;
    }
    return true;
}

bool inside(std::span<const Vec2> p, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t q) {
    return turn(p, a, b, q) >= 0.0 && turn(p, b, c, q) >= 0.0 && turn(p, c, a, q) >= 0.0;
}

std::vector<Ring> cut_ears(std::span<const Vec2> p, Ring ring) {
    std::vector<Ring> triangles;
    while (ring.size() > 3) {
        const std::size_t n = ring.size();
        std::size_t ear = n;
        for (std::size_t k = 0; k < n && ear == n; ++k) {
            const std::uint32_t a = ring[(k + n - 1) % n], b = ring[k], c = ring[(k + 1) % n];
            if (turn(p, a, b, c) <= 0.0) continue;
            const bool empty = std::none_of(ring.begin(), ring.end(), [&](std::uint32_t q) {
                return q != a && q != b && q != c && inside(p, a, b, c, q);
            });
            if (empty) ear = k;
        }
        if (ear == n)
            throw InputError("outline: found a polygon that touches or crosses itself, expected a simple outline");
        triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(ring);
    return triangles;
}

/// Union of two counter-clockwise rings along a shared edge; empty if they share no edge.
Ring joined(const Ring& a, const Ring& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
            Ring ring;
            for (std::size_t k = 0; k < a.size(); ++k) ring.push_back(a[(i + 1 + k) % a.size()]);
            for (std::size_t k = 0; k + 2 < b.size(); ++k) ring.push_back(b[(j + 2 + k) % b.size()]);
            return ring;
        }
    }
    return {};
}

bool merge_one_pair(std::span<const Vec2> p, std::vector<Ring>& pieces) {
    for (std::size_t a = 0; a < pieces.size(); ++a) {
        for (std::size_t b = a + 1; b < pieces.size(); ++b) {
            Ring ring = joined(pieces[a], pieces[b]);
            if (ring.empty() || !convex(p, ring)) continue;
            pieces[a] = std::move(ring);
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(b));
            return true;
        }
    }
    return false;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> convex_pieces(std::span<const Vec2> corners) {
    Ring whole(corners.size());
    std::iota(whole.begin(), whole.end(), 0u);
    if (convex(corners, whole)) return {whole};
    std::vector<Ring> pieces = cut_ears(corners, whole);
    while (merge_one_pair(corners, pieces)) {
    }
    return pieces;
}

}  // namespace crackle
