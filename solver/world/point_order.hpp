// SPDX-License-Identifier: GPL-3.0-or-later
// Identity and sort order of contact points, independent of their current indices.
// Tested by tests/specimens/observers/contact_history_test.cpp.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "solver/world/world.hpp"

namespace crackle {

/// Whether feature_j belongs to the identity of a point. For outlines it does not, since feature_j is only the edge
/// that the point faced last.
constexpr bool names_feature(PointKind kind) {
    return kind == PointKind::element_element || kind == PointKind::face_face || by_guide(kind);
}

/// Sort key of the points of one kind: the two bodies, which of them owns the element, the element, and the partner's
/// circle or segment.
struct PointKey {
    std::uint32_t low, high, owner_is_high, element, partner;
    auto operator<=>(const PointKey&) const = default;
};

inline PointKey key_of(PointKind kind, const ContactPoint& p) {
    if (kind == PointKind::element_wall) return {p.body_i, p.body_j, 0, p.element_i, 0};
    const auto [low, high] = std::minmax(p.body_i, p.body_j);
    return {low, high, p.body_i > p.body_j ? 1u : 0u, p.element_i, names_feature(kind) ? p.feature_j : 0u};
}

/// Whether two contact points of one kind are the same.
inline bool same_point(PointKind kind, const ContactPoint& p, const ContactPoint& q) {
    return p.body_i == q.body_i && p.body_j == q.body_j && p.element_i == q.element_i &&
           (!names_feature(kind) || p.feature_j == q.feature_j);
}

}  // namespace crackle
