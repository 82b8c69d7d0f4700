// SPDX-License-Identifier: GPL-3.0-or-later
// Which contact points are the same and in which order they are listed, whatever the numbers they have at the moment.
// Tested by tests/specimens/observers/contact_history_test.cpp.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>

#include "solver/world/world.hpp"

namespace crackle {

/// Whether feature_j names a part of j; of outlines it is the edge faced last, of others nothing.
constexpr bool names_feature(PointKind kind) {
    return kind == PointKind::element_element || kind == PointKind::face_face || by_guide(kind);
}

/// Order of the points of a kind: pair, which of the two owns the element, element, partner's circle or segment.
struct PointKey {
    std::uint32_t low, high, owner_is_high, element, partner;
    auto operator<=>(const PointKey&) const = default;
};

inline PointKey key_of(PointKind kind, const ContactPoint& p) {
    if (kind == PointKind::element_wall) return {p.body_i, p.body_j, 0, p.element_i, 0};
    const auto [low, high] = std::minmax(p.body_i, p.body_j);
    return {low, high, p.body_i > p.body_j ? 1u : 0u, p.element_i, names_feature(kind) ? p.feature_j : 0u};
}

/// Whether two points of one kind are the same.
inline bool same_point(PointKind kind, const ContactPoint& p, const ContactPoint& q) {
    return p.body_i == q.body_i && p.body_j == q.body_j && p.element_i == q.element_i &&
           (!names_feature(kind) || p.feature_j == q.feature_j);
}

}  // namespace crackle
