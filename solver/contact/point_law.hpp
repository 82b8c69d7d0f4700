// SPDX-License-Identifier: GPL-3.0-or-later
// Law of one contact point, or of a batch of points, including the points' own stiffness factors.
// Tested by tests/solver/contact/batch_test.cpp.
#pragma once

#include "solver/base/lanes.hpp"
#include "solver/contact/pass_view.hpp"
#include "solver/laws/law.hpp"

namespace crackle {

/// Factor on a point's stiffness; for two flat faces it includes their current lap (shared length).
template <PointKind K, class Number>
CRACKLE_INLINE Number stiffness_share(const PassView& view, PointIndex k) {
    const Number share = load_floats<Number>(view.stiffness_share + k);
    if constexpr (K == PointKind::face_face)
        return share * load_as<Number>(view.lap + k);
    else
        return share;
}

/// Returns a law with the points' own stiffness factors, if there are any. @param law the law of the points' materials
/// @param room the storage for the result if it differs from `law` @param share a function that returns the stiffness
/// factor
template <class Features, class Number, class Share>
CRACKLE_INLINE const Law<Number>& with_shares_of(const Features& has, const PassView& view, PointIndex k,
                                                 const Law<Number>& law, Law<Number>& room, const Share& share) {
    if (has.own_shear)
        room = law.with_shares(share(), load_floats<Number>(view.shear_root + k));
    else if (has.own_shares)
        room = law.with_share(share());
    else
        return law;  // returned by reference, so that the law is not copied for each batch
    return room;
}

/// Law of one point, or of a batch, including stiffness factors. The parameters are those of with_shares_of().
template <PointKind K, class Features, class Number>
CRACKLE_INLINE const Law<Number>& own_law(const Features& has, const PassView& view, PointIndex k,
                                          const Law<Number>& law, Law<Number>& room) {
    return with_shares_of(has, view, k, law, room, [&] { return stiffness_share<K, Number>(view, k); });
}

/// Square root of the effective mass, sqrt(kg). For flat faces, Points::root_mass refers to a lap of one metre.
template <PointKind K, class Number>
CRACKLE_INLINE Number root_masses(const PassView& view, PointIndex k) {
    const Number whole = load_as<Number>(view.root_mass + k);
    if constexpr (K == PointKind::face_face)
        return whole * root(load_as<Number>(view.lap + k));
    else
        return whole;
}

}  // namespace crackle
