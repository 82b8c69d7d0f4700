// SPDX-License-Identifier: GPL-3.0-or-later
// Forces of several contact points at once, for what nearly all points do in nearly all steps: a contact or bond that
// holds, or a listed pair that does not touch. Where one of them begins to part the batch is left to the scalar code;
// both give the same bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/contact/batch_geometry.hpp"
#include "solver/contact/batch_law.hpp"
#include "solver/contact/coulomb_bond.hpp"
#include "solver/contact/dashpot.hpp"
#include "solver/contact/features.hpp"
#include "solver/contact/friction.hpp"
#include "solver/contact/law.hpp"
#include "solver/contact/opening.hpp"
#include "solver/world/world.hpp"

namespace crackle {

/// Losses of a block of points, added up apart by the place of the point, so that lanes need not wait for each other.
/// Always eight, so that a sum does not depend on the number of lanes.
struct BlockLosses {
    static constexpr PointIndex places = 8;
    alignas(64) double dashpot[places] = {};
    double friction = 0.0, law = 0.0;
    std::uint32_t broken = 0, gained = 0;

    /// @param place of the first
    CRACKLE_INLINE void add_dashpots(PointIndex place, const Lanes& lost) {
        const PointIndex first = place % places;
        if (first + lane_count <= places) {
            store_as(dashpot + first, load_as<Lanes>(dashpot + first) + lost);
        } else {
            for (PointIndex l = 0; l < lane_count; ++l) dashpot[(first + l) % places] += lost[l];
        }
    }

    LossBlock total() const {
        double sum = 0.0;
        for (const double one : dashpot) sum += one;
        return {sum, friction, law, broken, gained};
    }
};

/// What happens to the points of a batch.
enum class BatchCase : std::uint8_t {
    all_hold,    // every point was in contact, holds, and stuck before (and is bonded, where there are bonds)
    some_hold,   // no other was in contact
    none_holds,  // nor was in contact
    one_by_one   // something breaks or parts: for the scalar code
};

/// Which points of a batch carry load, and what they were before.
struct BatchState {
    BatchCase what;
    PointState* states;
    LaneBits law_and_flags, bonded, holds;
    Lanes beyond_rest;  // m, overlap of a point without a bond beyond the one without force
};

/// Of the shear force of a bond that sticks, N.
inline constexpr double infinite_limit = std::numeric_limits<double>::infinity();

constexpr LaneBit bits_of_flags(int flags) { return static_cast<LaneBit>(flags) << 16; }

/// Whether bonds fail under their elastic forces. @param law with the points' shares
CRACKLE_INLINE LaneBits fail(const World& world, PointIndex k, const Law<Lanes>& law, const Lanes& opening,
                             const Lanes& slip) {
    const Lanes strength = load_floats(&world.points.strength_share[k]);
    const BondStrength<Lanes> bond{law.tensile_strength * strength, law.cohesion * strength, law.bond_friction};
    const Lanes normal = spring_force(law, opening);
    const Lanes shear = load_as<Lanes>(&world.points.shear_force[k]) - law.shear_stiffness * slip;
    return fails_in_tension(bond, normal) | fails_in_shear(bond, normal, shear);
}

/// @param share of stiffness, where points have one
template <class Features, class Share>
CRACKLE_INLINE Law<Lanes> with_shares_of(const Features& has, const World& world, PointIndex k, const BatchLaw& law,
                                         const Share& share) {
    if (has.own_shear) return law.law.with_shares(share(), load_floats(&world.points.shear_root[k]));
    if (has.own_shares) return law.law.with_share(share());
    return law.law;
}

template <class Contact>
inline constexpr bool of_faces = std::is_same_v<Contact, FlatFaceGeometry<Lanes>>;

/// The law of the points of a batch with their shares, of flat faces over a metre.
template <class Features>
CRACKLE_INLINE Law<Lanes> law_of_metre(const Features& has, const World& world, PointIndex k, const BatchLaw& law) {
    return with_shares_of(has, world, k, law, [&] { return load_floats(&world.points.stiffness_share[k]); });
}

/// The same over their lap.
template <class Features, class Contact>
CRACKLE_INLINE Law<Lanes> law_of_batch(const Features& has, const World& world, PointIndex k,
                                       const BatchGeometry<Contact>&, const BatchLaw& law) {
    if constexpr (!of_faces<Contact>)
        return law_of_metre(has, world, k, law);
    else
        return with_shares_of(has, world, k, law, [&] {
            return load_floats(&world.points.stiffness_share[k]) * load_as<Lanes>(&world.points.lap[k]);
        });
}

/// root_mass_of() each.
template <class Contact>
CRACKLE_INLINE Lanes root_masses(const World& world, PointIndex k, const BatchGeometry<Contact>&) {
    const Lanes whole = load_as<Lanes>(&world.points.root_mass[k]);
    if constexpr (of_faces<Contact>)
        return whole * root(load_as<Lanes>(&world.points.lap[k]));
    else
        return whole;
}

/// Whether every unbonded point of a batch that closes has been closed and surely stays so for a step more.
template <class Features, class Contact>
CRACKLE_INLINE bool none_opens(const Features& has, const World& world, PointIndex k, const BatchGeometry<Contact>& g,
                               const BatchLaw& laws, const Lanes& overlap, const LaneBits& free) {
    const Law<Lanes> law = law_of_batch(has, world, k, g, laws);
    const BodyPair* const points = world.points.contact.pairs.data() + k;
    const double *i[lane_count], *j[lane_count];
    for (int l = 0; l < lane_count; ++l) {
        i[l] = &world.bodies.push_bound[points[l].body_i].acceleration;
        j[l] = &world.bodies.push_bound[points[l].body_j].acceleration;
    }
    Lanes acceleration_i, acceleration_j, inverse_mass_i, inverse_mass_j, dashpot{};
    gather_pairs(i, acceleration_i, inverse_mass_i);
    gather_pairs(j, acceleration_j, inverse_mass_j);
    if (has.damping) dashpot = normal_damping(law, root_masses(world, k, g)) * g.motion.closing;
    const double step = world.stepping.time_step, kick = kick_before(world.stepping) + 0.5 * step;
    return none_of(free &
                   ~stays_closed(law.normal_stiffness, overlap, g.motion.closing,
                                 load_as<Lanes>(&world.points.last_normal[k]), dashpot,
                                 PushBounds<Lanes>{acceleration_i + acceleration_j, inverse_mass_i + inverse_mass_j},
                                 kick, step));
}

inline constexpr LaneBit bits_of_law = 0xffff;

/// Laws of a batch that are not those of the batch before. @return whether lanes can have them
template <class Features>
CRACKLE_INLINE bool take_laws(const Features& has, const World& world, const PointState* states,
                              const LaneBits& law_and_flags, BatchLaw& law) {
    if (!none_of((law_and_flags ^ law_and_flags[0]) & bits_of_law))
        return load_laws(has, world, states, law_and_flags & bits_of_law, law);
    law.take(world, states[0].law);
    return true;
}

/// Changes nothing. @param k first point of the batch @param law of the batch before; left as this one's
template <class Features, class Contact>
CRACKLE_INLINE BatchState look_at_batch(const Features& has, World& world, PointIndex k,
                                        const BatchGeometry<Contact>& g, BatchLaw& law) {
    const int at_rest = point_touching | (has.bonds ? point_bonded | point_counted : 0);
    const LaneBit looked_at =
        bits_of_law | bits_of_flags(at_rest | point_sliding | (has.consistent ? point_unsettled : 0));
    const Lanes& overlap = g.contact.overlap;
    PointState* const states = world.points.state.data() + k;
    const LaneBits law_and_flags = widened(states);
    LaneBits unlike = law_and_flags ^ (law.number | bits_of_flags(at_rest));
    if (!none_of(unlike & bits_of_law)) {
        if (!take_laws(has, world, states, law_and_flags, law))
            return {BatchCase::one_by_one, states, law_and_flags, LaneBits{}, LaneBits{}, Lanes{}};
        unlike = (law_and_flags ^ bits_of_flags(at_rest)) & ~bits_of_law;
    }
    Lanes beyond_rest = overlap;  // m, of the overlap without force
    if (has.coulomb) beyond_rest -= load_as<Lanes>(&world.points.bond_overlap[k]);
    if constexpr (of_faces<Contact>)
        beyond_rest = select((load_as<Lanes>(&world.points.lap[k]) == 0.0) & (beyond_rest > 0.0), Lanes{}, beyond_rest);
    LaneBits over = beyond_rest > 0.0;
    if (has.coulomb)
        over =
            ~fail(world, k, law_of_batch(has, world, k, g, law), beyond_rest, g.motion.slipping * world.stepping.drift);
    else if (has.bonds)
        over = bond_holds(law.law, overlap);
    if (none_of((unlike & looked_at) | ~over)) {
        BatchCase what = BatchCase::all_hold;
        const LaneBits all_bonded = has.bonds ? over : LaneBits{};
        if (has.consistent && !has.bonds) {
            if (!none_opens(has, world, k, g, law, overlap, over)) what = BatchCase::one_by_one;
        }
        return {what, states, law_and_flags, all_bonded, over, beyond_rest};
    }
    LaneBits bonded{}, holds = beyond_rest > 0.0;
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
        if (any(unsettled | (free & ~touched)) || (any(free) && !none_opens(has, world, k, g, law, beyond_rest, free)))
            what = BatchCase::one_by_one;
    }
    return {what, states, law_and_flags, bonded, holds, beyond_rest};
}

/// What points without a bond remember of a force pass, whether they close or not.
CRACKLE_INLINE void remember_overlaps(World& world, PointIndex k, const BatchState& batch) {
    LastOverlap* const last = &world.points.last_overlap[k];
    store_as(last, select(batch.bonded, load_as<Lanes>(last), batch.beyond_rest));
}

/// Forces of the points of a batch that hold, into `out`; of the others 0.
/// @tparam All BatchCase::all_hold, else some_hold @param place of the first point in its block
/// @param law with the points' shares
template <bool All, class Features, class Contact>
CRACKLE_INLINE void force_lanes(const Features& has, World& world, PointIndex k, PointIndex place,
                                const BatchGeometry<Contact>& g, const Law<Lanes>& law, const BatchState& batch,
                                PointForce* out, BlockLosses& loss) {
    const Lanes zero{};
    const auto where_held = [&](const Lanes& held, const Lanes& otherwise) -> Lanes {
        if constexpr (All)
            return held;
        else
            return select(batch.holds, held, otherwise);
    };
    const double dt = world.stepping.drift;
    const Lanes& compression = has.coulomb ? batch.beyond_rest : g.contact.overlap;  // m, what Coulomb's limit goes by
    Lanes normal = spring_force(law, compression);
    [[maybe_unused]] Lanes bond_overlap{};
    if (has.bonds && !has.coulomb) {
        bond_overlap = load_as<Lanes>(&world.points.bond_overlap[k]);
        normal -= spring_force(law, bond_overlap);
    }
    Lanes shear = zero;
    LaneBits sliding = batch.holds;
    if (has.friction) {
        double* const spring = &world.points.shear_force[k];
        const Lanes before = load_as<Lanes>(spring);
        Lanes limit;
        if (has.coulomb) {
            limit = law.friction * normal;
            if constexpr (All)
                limit = all_of<Lanes>(infinite_limit);
            else
                limit = select(batch.bonded, all_of<Lanes>(infinite_limit), limit);
        } else {
            limit = coulomb_limit(law, compression);
        }
        const ShearTrial<Lanes> trial = try_shear_within<Lanes>(law, before, g.motion.slipping * dt, limit);
        sliding = trial.slides;
        shear = trial.force;
        const LaneBits slides = sliding & batch.holds;
        if (any(slides)) shear = shear_force(trial);
        store_as(spring, where_held(shear, before));
        if (any(slides)) {
            const Lanes lost = slider_loss(law, trial, shear);
            for (int l = 0; l < lane_count; ++l) loss.friction += slides[l] != 0 ? lost[l] : 0.0;
            if constexpr (All) {
                for (int l = 0; l < lane_count; ++l)
                    if (slides[l] != 0) batch.states[l].flags |= point_sliding | point_slid;
            }
        }
    }
    if constexpr (!All) {
        LaneBits now = (batch.law_and_flags | bits_of_flags(point_touching)) & ~bits_of_flags(point_sliding);
        if (has.friction) now |= sliding & (bits_of_flags(point_sliding) | bits_of_flags(point_slid));
        if (const unsigned changed = mask_of(batch.holds & ((now ^ batch.law_and_flags) != 0)); changed != 0) {
            for (int l = 0; l < lane_count; ++l)
                if ((changed >> l & 1) != 0) batch.states[l].flags = static_cast<std::uint16_t>(now[l] >> 16);
        }
    }
    if (has.bonds && !All) {
        const unsigned uncounted = mask_of(batch.holds & ((batch.law_and_flags & bits_of_flags(point_counted)) == 0));
        loss.gained += static_cast<std::uint32_t>(__builtin_popcount(uncounted));
    }
    if (has.bonds && !has.coulomb) {
        LaneBits strong = carries_half_strength(law, normal, shear, bond_overlap);
        if constexpr (!All) strong &= batch.bonded;
        if (any(strong)) {  // rare: spares the memory of the others
            float *const strong_normal = &world.points.strong_normal[k], *const strong_shear =
                                                                             &world.points.strong_shear[k];
            store_floats(strong_normal, select(strong, normal, load_floats(strong_normal)));
            store_floats(strong_shear, select(strong, shear, load_floats(strong_shear)));
        }
    }
    if (has.damping) {
        const Lanes root_mass = root_masses(world, k, g);
        const Lanes normal_damper = normal_damping(law, root_mass) * g.motion.closing;
        const Lanes shear_damper = shear_dashpot(law, root_mass, g.motion.slipping, compression, sliding);
        float *const normal_memory = &world.points.normal_dashpot[k], *const shear_memory =
                                                                          &world.points.shear_dashpot[k];
        const Lanes last_normal = load_floats(normal_memory), last_shear = load_floats(shear_memory);
        const Lanes lost = dashpot_loss<Lanes>(dt, last_normal + normal_damper, g.motion.closing,
                                               last_shear + shear_damper, g.motion.slipping);
        loss.add_dashpots(place, where_held(lost, zero));
        store_floats(normal_memory, where_held(normal_damper, last_normal));
        store_floats(shear_memory, where_held(shear_damper, last_shear));
        normal += normal_damper;
        shear -= shear_damper;
    }
    if (has.consistent && !(has.bonds && All)) {
        double* const last = &world.points.last_normal[k];
        store_as(last, select(batch.bonded, load_as<Lanes>(last), where_held(normal, load_as<Lanes>(last))));
        remember_overlaps(world, k, batch);
    }
    const ForceOnBodies<Lanes> force = force_on_bodies(g.contact, normal, shear);
    store_quads(out, where_held(force.fx, zero), where_held(force.fy, zero), where_held(force.torque_i, zero),
                where_held(force.torque_j, zero));
}

}  // namespace crackle
