// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/faces/face_kernels.hpp"

#include <type_traits>

#include "solver/base/lanes.hpp"
#include "solver/geometry/face_motion.hpp"

namespace crackle {
namespace {

template <class Number>
constexpr FaceIndex width = std::is_same_v<Number, double> ? 1 : lane_count;

/// One number per lane. @param of of(l) returns the number for lane l
template <class Number, class Of>
CRACKLE_INLINE Number lanes_by(Of of) {
    if constexpr (std::is_same_v<Number, double>) {
        return of(0);
    } else {
        double numbers[lane_count];
        for (FaceIndex l = 0; l < width<Number>; ++l) numbers[l] = of(l);
        return load_as<Number>(numbers);
    }
}

/// Loads two adjacent numbers for each lane. @param of of(l) returns the address of the two numbers for lane l
template <class Number, class Of>
CRACKLE_INLINE void load_pairs(Of of, Number& first, Number& second) {
    if constexpr (std::is_same_v<Number, double>) {
        const double* const at = of(0);
        first = at[0], second = at[1];
    } else {
        const double* at[lane_count];
        for (FaceIndex l = 0; l < width<Number>; ++l) at[l] = of(l);
        gather_pairs(at, first, second);
    }
}

/// Values of one member in consecutive records, starting at record k. @param c index of the member within a record
template <class Number, class Record>
CRACKLE_INLINE Number column(const FaceColumns<Record>& records, std::size_t c, FaceIndex k) {
    return load_as<Number>(records.column(c) + k);
}

template <class Number>
CRACKLE_INLINE PlaceOf<Number> load_place(const FaceColumns<FacePlace>& places, FaceIndex k) {
    static_assert(FaceColumns<FacePlace>::width == 9);
    const auto of = [&](std::size_t c) { return column<Number>(places, c, k); };
    return {{of(0), of(1)}, {of(2), of(3)}, {of(4), of(5)}, {of(6), of(7)}, of(8)};
}

/// Position and rotation of one body per lane. @param of of(l) returns the index of the body in lane l
template <class Number, class Of>
CRACKLE_INLINE FaceBody<Number> load_body(const BodyState* bodies, Of of) {
    FaceBody<Number> body;
    Number again;
    load_pairs([&](FaceIndex l) { return &bodies[of(l)].x; }, body.place.x, body.place.y);
    load_pairs([&](FaceIndex l) { return &bodies[of(l)].shape[0]; }, body.cosine, body.sine);
    load_pairs([&](FaceIndex l) { return &bodies[of(l)].shape[1]; }, again, body.angle);
    return body;
}

template <class Number, class Of>
CRACKLE_INLINE FaceBodyRates<Number> load_rates(const BodyState* bodies, Of of) {
    FaceBodyRates<Number> body;
    Number unused;
    load_pairs([&](FaceIndex l) { return &bodies[of(l)].vx; }, body.velocity.x, body.velocity.y);
    load_pairs([&](FaceIndex l) { return &bodies[of(l)].omega; }, body.spin, unused);
    return body;
}

/// Indices of the members within FaceSprings.
enum SpringColumn : std::size_t { k_normal, k_shear, k_length, k_share_i, k_share_j, k_skew_i, k_skew_j };
static_assert(FaceColumns<FaceSprings>::width == 7);

template <class Number>
CRACKLE_INLINE void move_some(Faces& faces, const BodyState* bodies, FaceIndex k) {
    const BodyPair* const pairs = faces.bodies.data() + k;
    const FaceBody<Number> i = load_body<Number>(bodies, [&](FaceIndex l) { return pairs[l].body_i; }),
                           j = load_body<Number>(bodies, [&](FaceIndex l) { return pairs[l].body_j; });
    const MotionOf<Number> m = motion_of(load_place<Number>(faces.place, k), i, j);
    const Number members[] = {m.normal.x, m.normal.y, m.opening, m.sliding, m.turn};
    static_assert(FaceColumns<BondFaceMotion>::width == 5);
    for (std::size_t c = 0; c < 5; ++c) store_as(faces.motion.column(c) + k, members[c]);
    if (!faces.has_pressure) return;
    const auto spring = [&](SpringColumn c) { return column<Number>(faces.springs, c, k); };
    const Number length = spring(k_length);
    store_as(faces.dilation_i.data() + k, length * (spring(k_share_i) * m.opening + spring(k_skew_i) * m.sliding));
    store_as(faces.dilation_j.data() + k, length * (spring(k_share_j) * m.opening - spring(k_skew_j) * m.sliding));
}

/// Strengths of consecutive faces, starting at face k. In most cases all of these faces have the same law.
template <class Number>
CRACKLE_INLINE FaceStrength<Number> strengths(const Faces& faces, FaceIndex k) {
    const Number share = load_as<Number>(faces.strength_share.data() + k);
    bool alike = true;
    for (FaceIndex l = 1; l < width<Number>; ++l) alike = alike && faces.law[k + l] == faces.law[k];
    if (alike) return {faces.law_of(k), share};
    const auto of = [&](double FaceLaw::*member) {
        return lanes_by<Number>([&](FaceIndex l) { return faces.law_of(k + l).*member; });
    };
    FaceStrength<Number> strength;
    strength.tensile = share * of(&FaceLaw::tensile_strength);
    strength.cohesion = share * of(&FaceLaw::cohesion);
    strength.friction = of(&FaceLaw::friction);
    strength.knee = of(&FaceLaw::knee);
    strength.friction_beyond = of(&FaceLaw::friction_beyond);
    strength.moment_share = of(&FaceLaw::moment_share);
    return strength;
}

/// Adds the dashpot forces of faces to their elastic forces. The stored dashpot forces of broken faces are not changed
/// here; damp() in face_pass.cpp updates them. @return energy dissipated by the dashpots of each face, J
template <class Number>
CRACKLE_INLINE Number damp_some(Faces& faces, double drift, FaceIndex k, const Condition<Number>& intact,
                                const FaceRates<Number>& rate, ForcesOf<Number>& force) {
    const Number rates[] = {rate.opening, rate.sliding, rate.turn};
    Number* const forces[] = {&force.normal, &force.shear, &force.moment};
    Number sum{};
    for (std::size_t c = 0; c < 3; ++c) {
        double* const memory = faces.dashpot_force.column(c) + k;
        const Number last = load_as<Number>(memory), now = column<Number>(faces.dashpots, c, k) * rates[c];
        store_as(memory, select(intact, now, last));
        *forces[c] += now;
        sum += (last + now) * rates[c];
    }
    return select(intact, 0.5 * drift * sum, Number{});
}

template <class Number>
CRACKLE_INLINE void force_some(Faces& faces, const BodyState* bodies, double drift, FaceIndex k, IntactForces& found) {
    const BodyPair* const pairs = faces.bodies.data() + k;
    const auto body_i = [&](FaceIndex l) { return pairs[l].body_i; };
    const auto body_j = [&](FaceIndex l) { return pairs[l].body_j; };
    const FaceBody<Number> i = load_body<Number>(bodies, body_i), j = load_body<Number>(bodies, body_j);
    const PlaceOf<Number> place = load_place<Number>(faces.place, k);
    const auto motion = [&](std::size_t c) { return column<Number>(faces.motion, c, k); };
    const MotionOf<Number> m{{motion(0), motion(1)}, motion(2), motion(3), motion(4)};
    const auto spring = [&](SpringColumn c) { return column<Number>(faces.springs, c, k); };
    Number pressure{}, skewing{};
    if (faces.has_pressure) {
        const Number p_i = lanes_by<Number>([&](FaceIndex l) { return faces.cells[body_i(l)].pressure; }),
                     p_j = lanes_by<Number>([&](FaceIndex l) { return faces.cells[body_j(l)].pressure; });
        pressure = spring(k_share_i) * p_i + spring(k_share_j) * p_j;
        skewing = spring(k_skew_i) * p_i - spring(k_skew_j) * p_j;
    }
    const Number length = spring(k_length);
    ForcesOf<Number> force = intact_forces(spring(k_normal), spring(k_shear), length, m, pressure, skewing);
    const Number unbroken =
        lanes_by<Number>([&](FaceIndex l) { return faces.broken_at[k + l] == no_face ? 1.0 : 0.0; });
    const Condition<Number> intact = unbroken > 0.0;
    const FaceStrength<Number> strength = strengths<Number>(faces, k);
    const FaceStress<Number> stress(strength, length, force.normal, force.shear, force.moment);
    if (any(intact & either(stress.tension > strength.tensile, stress.shear > stress.shear_strength)))
        found.some_fail = true;
    if (faces.damped()) {
        const FaceRates<Number> rate =
            rates_of(place, m, i, j, load_rates<Number>(bodies, body_i), load_rates<Number>(bodies, body_j));
        const Number loss = damp_some<Number>(faces, drift, k, intact, rate, force);
        if constexpr (std::is_same_v<Number, double>) {
            found.dashpot_loss += loss;
        } else {
            for (int l = 0; l < lane_count; ++l) found.dashpot_loss += loss[l];
        }
    }
    const FaceOnBodies<Number> on = forces_on_bodies(place, m, i, j, force);
    PointForce* const out = faces.force.data() + k;
    if constexpr (std::is_same_v<Number, double>)
        *out = {on.force.x, on.force.y, on.torque_i, on.torque_j};
    else
        store_quads(out, on.force.x, on.force.y, on.torque_i, on.torque_j);
}

/// Calls visit.operator()<Number>(k) for full batches, and then for single faces.
template <class Visit>
CRACKLE_INLINE void in_batches(FaceIndex begin, FaceIndex end, Visit visit) {
    clear_upper_halves();
    FaceIndex k = begin;
    for (; k + lane_count <= end; k += lane_count) visit.template operator()<Lanes>(k);
    for (; k < end; ++k) visit.template operator()<double>(k);
}

}  // namespace

template <>
void move_faces<InstructionSet::CRACKLE_SET>(Faces& faces, const BodyState* bodies, FaceIndex begin, FaceIndex end) {
    in_batches(begin, end, [&]<class Number>(FaceIndex k) { move_some<Number>(faces, bodies, k); });
}

template <>
IntactForces force_faces<InstructionSet::CRACKLE_SET>(Faces& faces, const BodyState* bodies, double drift,
                                                      FaceIndex begin, FaceIndex end) {
    IntactForces found;
    in_batches(begin, end, [&]<class Number>(FaceIndex k) { force_some<Number>(faces, bodies, drift, k, found); });
    return found;
}

}  // namespace crackle
