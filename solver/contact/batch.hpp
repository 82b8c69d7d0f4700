// SPDX-License-Identifier: GPL-3.0-or-later
// Processes several contact points (a batch) at once in the common cases: a point carries load through a contact or
// bond, or its bodies do not touch. If any contact opens or any bond breaks, the points of the batch are computed one
// by one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/base/lanes.hpp"
#include "solver/contact/batch_geometry.hpp"
#include "solver/contact/batch_law.hpp"
#include "solver/contact/force.hpp"
#include "solver/contact/opening_points.hpp"
#include "solver/contact/point_law.hpp"

namespace crackle {

/// How to compute the points of a batch.
enum class BatchCase : std::uint8_t {
    all_hold,    // every point was in contact without sliding and still carries load (with bonds: is bonded)
    some_hold,   // some points carry load; the others were not in contact before
    none_holds,  // no point carries load, and none was in contact before
    one_by_one   // a contact opens or a bond breaks: the points are computed one by one
};

/// Which points of a batch carry load, and their states before this force pass.
struct BatchState : HeldPoints<Lanes> {
    BatchCase what;
};

/// Loads the laws of a batch if they differ from the law of the previous batch. @return false if the batch mixes laws
/// with and without a shear spring
template <class Features>
CRACKLE_INLINE bool take_laws(const Features& has, const PassView& view, const PointState* states,
                              const LaneBits& law_and_flags, BatchLaw& law) {
    if (!none_of((law_and_flags ^ law_and_flags[0]) & bits_of_law))
        return load_laws(has, view, states, law_and_flags & bits_of_law, law);
    law.take(view, states[0].law);
    return true;
}

/// Determines which points of a batch carry load, without changing any point. @param k the index of the first point
/// @param batch_law on entry the law of the previous batch, on return the law of this batch
template <PointKind K, class Features>
CRACKLE_INLINE BatchState look_at_batch(const Features& has, const PassView& view, PointIndex k, const BatchOf<K>& g,
                                        BatchLaw& batch_law) {
    using Bond = typename Features::Bond;
    const int at_rest = point_touching | (has.bonds ? point_bonded | point_counted : 0);
    const LaneBit looked_at =
        bits_of_law | bits_of_flags(at_rest | point_sliding | (has.consistent ? point_unsettled : 0));
    PointState* const states = view.state + k;
    const LaneBits law_and_flags = state_bits<Lanes>(states);
    LaneBits unlike = law_and_flags ^ (batch_law.number | bits_of_flags(at_rest));
    if (!none_of(unlike & bits_of_law)) {
        if (!take_laws(has, view, states, law_and_flags, batch_law))
            return {{states, law_and_flags, LaneBits{}, LaneBits{}, Lanes{}}, BatchCase::one_by_one};
        unlike = (law_and_flags ^ bits_of_flags(at_rest)) & ~bits_of_law;
    }
    Law<Lanes> room;
    const Law<Lanes>& law = own_law<K>(has, view, k, batch_law.law, room);
    const Lanes overlap = beyond_rest<K>(has, view, k, g.contact.overlap);
    LaneBits over = overlap > 0.0;
    if (has.bonds) over = ~Bond::fails(law, bonded_point<Bond>(view, k, overlap, g.motion));
    if (none_of((unlike & looked_at) | ~over)) {
        BatchCase what = BatchCase::all_hold;
        const LaneBits all_bonded = has.bonds ? over : LaneBits{};
        if (has.consistent && !has.bonds) {
            if (!none_opens<K>(has, view, k, law, overlap, g.motion.closing, over)) what = BatchCase::one_by_one;
        }
        return {{states, law_and_flags, all_bonded, over, overlap}, what};
    }
    LaneBits bonded{}, holds = overlap > 0.0;
    if (has.bonds) {
        bonded = (law_and_flags & bits_of_flags(point_bonded)) != 0;
        holds = bonded ? over : holds;
    }
    const LaneBits touched = (law_and_flags & bits_of_flags(point_touching)) != 0;
    BatchCase what = any(holds) ? BatchCase::some_hold : BatchCase::none_holds;
    if (any(~holds & (bonded | touched))) what = BatchCase::one_by_one;
    if (has.consistent) {
        const LaneBits free = holds & ~bonded;
        const LaneBits unsettled = (law_and_flags & bits_of_flags(point_unsettled)) != 0;
        if (any(unsettled | (free & ~touched)) ||
            (any(free) && !none_opens<K>(has, view, k, law, overlap, g.motion.closing, free)))
            what = BatchCase::one_by_one;
    }
    return {{states, law_and_flags, bonded, holds, overlap}, what};
}

}  // namespace crackle
